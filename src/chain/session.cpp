#include "chain/session.h"

#include <ostream>

namespace tonetool::chain {

namespace {

std::string prefix(const char* kind, const std::string& where) {
    return std::string("tonetool ") + kind + ": " + (where.empty() ? "" : where + " : ");
}

} // namespace

void Session::error(const std::string& where, const std::string& what) {
    ++errors;
    out.flush();
    err << prefix("ERROR", where) << what << "\nFull command line was:\n> " << command_line
        << std::endl;
}

void Session::warning(const std::string& where, const std::string& what) {
    ++warnings;
    out.flush();
    err << prefix("WARNING", where) << what << std::endl;
}

void Session::report(const std::string& line) {
    if (!quiet) {
        print(line);
    }
}

void Session::print(const std::string& line) {
    out << line << '\n';
}

void Session::keep_pixels_of(const std::string& filename) {
    const auto keep = [&](const Image& image) {
        for (const PartPtr& part : image.parts()) {
            part->read_before_replacing(filename);
        }
    };
    for (const ImagePtr& image : stack) {
        keep(*image);
    }
    for (const auto& [name, image] : labels) {
        keep(*image);
    }
}

int Session::exit_status() const {
    if (errors > 0) {
        return 1;
    }
    if (failures > 0) {
        return 3;
    }
    return warnings > 0 && warnings_exit ? 2 : 0;
}

} // namespace tonetool::chain
