// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/session.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <ostream>

#include "text/error.h"

namespace tonetool::chain {

namespace {

std::string prefix(const char* kind, const std::string& where, bool compat) {
    const char* none = compat ? " : " : ": ";
    return std::string("tonetool ") + kind + (where.empty() ? none : ": " + where + " : ");
}

// A line break in a name must not begin a line that looks like one of this program.
std::string indented(const std::string& text, bool compat) {
    return compat ? text : OIIO::Strutil::replace(text, "\n", "\n  ", true);
}

std::string of_frame(const Session& session) {
    return session.frame.loops && !session.compat
               ? " (frame " + std::to_string(session.frame.number) +
                     (session.frame.view.empty() ? "" : ", view " + session.frame.view) + ")"
               : "";
}

} // namespace

void Session::error(const std::string& where, const std::string& what, bool ends) {
    ++errors;
    aborted |= ends;
    if (first_error.empty())
        first_error = (where.empty() ? "" : where + " : ") + what;
    out.flush();
    complaints() << (what.empty() ? "tonetool ERROR: " + where + " (unknown error)"
                                  : prefix("ERROR", where, compat) + indented(what, compat) +
                                        of_frame(*this))
                 << "\nFull command line was:\n> " << command_line << std::endl;
}

void Session::warning(const std::string& where, const std::string& what) {
    ++warnings;
    warning_texts.push_back((where.empty() ? "" : where + " : ") + what);
    out.flush();
    complaints() << prefix("WARNING", where, compat) << indented(what, compat) << of_frame(*this)
                 << std::endl;
}

void Session::warn_of_other_parts(const std::string& where, const Image& image) {
    if (image.part_count() > 1) {
        warning(where, "only the first of " + std::to_string(image.part_count()) +
                           " subimages of " + image.name() + " is looked at (--subimage chooses)");
    }
}

void Session::report(const std::string& line) {
    if (!quiet)
        print(line);
}

void Session::print(const std::string& line) {
    out << line << '\n';
}

void Session::note_format(Image& image) {
    if (image.noted || !image.part().from_file())
        return;
    image.noted = true;
    types.note(image);
    const OIIO::ImageSpec& spec = image.part().header();
    if (compat && output.tile_width == 0 && !output.scanline) { // oiiotool goes on in its tiles
        output.tile_width = spec.tile_width;
        output.tile_height = spec.tile_height;
    }
}

Writer Session::writer(const std::string& where) {
    return {command_line, compat, &types,
            [this, where](const std::string& text) { warning(where, text); }, &matched_channels};
}

std::string Session::file(const std::string& name) {
    // "ocio://..." names no file.
    const bool as_it_is = name.empty() || name.find("://") != std::string::npos;
    std::string path = as_it_is || policy.directory.empty()
                           ? name
                           : (std::filesystem::path(policy.directory) / name).string();
    files.note(path);
    return path;
}

void Session::keep_pixels_of(const std::string& filename) {
    const auto keep = [&](const Image& image) {
        for (const PartPtr& part : image.parts())
            part->read_before_replacing(filename);
    };
    for (const ImagePtr& image : stack)
        keep(*image);
    for (const auto& [name, image] : labels)
        keep(*image);
}

void WrittenFiles::claim(const std::string& filename, int number, const std::string& view) {
    std::lock_guard<std::mutex> lock(m_mutex);
    const std::pair<int, std::string> frame(number, view);
    const auto [first, is_new] =
        m_frame_of.emplace(std::filesystem::path(filename).lexically_normal().string(), frame);
    if (!is_new && first->second != frame) {
        throw CommandError("\"" + filename + "\" was written by frame " +
                           std::to_string(first->second.first) +
                           " (valid: a name with # or {FRAME_NUMBER}, another for each frame)");
    }
}

void Session::claim(const std::string& filename) {
    if (dry_run)
        return;
    if (written && !compat)
        written->claim(filename, frame.number, frame.view);
    claimed.push_back(filename);
}

OIIO::ColorConfig& color_config(Session& session) {
    if (!session.ocio)
        session.ocio = std::make_shared<OIIO::ColorConfig>(session.color_config);
    return *session.ocio;
}

int Session::exit_status() const {
    if (errors > 0 || differs)
        return 1;
    if (failures > 0)
        return compat ? 1 : 3;
    return warnings > 0 && warnings_exit ? 2 : 0;
}

} // namespace tonetool::chain
