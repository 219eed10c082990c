// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/session.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <ostream>

#include "text/error.h"

namespace tonetool::chain {

std::string Session::message(const char* kind, const std::string& where,
                             const std::string& what) const {
    const bool compat = settings.compat;
    const std::string begin = std::string("tonetool ") + kind +
                              (!where.empty() ? ": " + where + " : "
                               : compat       ? " : "
                                              : ": ");
    if (compat)
        return begin + what;
    const std::string view = frame.view.empty() ? "" : ", view " + frame.view;
    const sequence::Item item = frame.item();
    const std::string where_it_was =
        item.named() ? sequence::item_title(item) : "frame " + std::to_string(frame.number) + view;
    // A line break in a name must not begin a line that looks like one of this program.
    return begin + OIIO::Strutil::replace(what, "\n", "\n  ", true) +
           (frame.loops ? " (" + OIIO::Strutil::replace(where_it_was, "\n", "\n  ", true) + ")"
                        : "");
}

void Session::error(const std::string& where, const std::string& what, bool ends) {
    outcome.note_error((where.empty() ? "" : where + " : ") + what, ends);
    out.flush();
    complaints() << (what.empty() ? "tonetool ERROR: " + where + " (unknown error)"
                                  : message("ERROR", where, what))
                 << "\nFull command line was:\n> " << command_line << std::endl;
}

void Session::warning(const std::string& where, const std::string& what) {
    ++outcome.warnings;
    outcome.warning_texts.push_back((where.empty() ? "" : where + " : ") + what);
    out.flush();
    complaints() << message("WARNING", where, what) << std::endl;
}

void Session::warn_of_other_parts(const std::string& where, const Image& image) {
    if (image.part_count() > 1) {
        warning(where, "only the first of " + std::to_string(image.part_count()) +
                           " subimages of " + image.name() + " is looked at (--subimage chooses)");
    }
}

void Session::report(const std::string& line) {
    if (!settings.quiet)
        print(line);
}

void Session::print(const std::string& line) {
    out << line << '\n';
}

void Session::note_format(Image& image) {
    if (image.noted || !image.part().from_file())
        return;
    image.noted = true;
    stack.types.note(image);
    const OIIO::ImageSpec& spec = image.part().header();
    OutputSettings& output = settings.output;
    if (settings.compat && output.tile_width == 0 &&
        !output.scanline) { // oiiotool goes on in its tiles
        output.tile_width = spec.tile_width;
        output.tile_height = spec.tile_height;
    }
}

Writer Session::writer(const std::string& where) {
    return {command_line, settings.compat, &stack.types,
            [this, where](const std::string& text) { warning(where, text); },
            &outcome.matched_channels};
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

void Stack::keep_pixels_of(const std::string& filename) const {
    const auto keep = [&](const Image& image) {
        for (const PartPtr& part : image.parts())
            part->read_before_replacing(filename);
    };
    for (const ImagePtr& image : images)
        keep(*image);
    for (const auto& [name, image] : labels)
        keep(*image);
}

void WrittenFiles::claim(const std::string& filename, const sequence::Item& frame) {
    std::lock_guard<std::mutex> lock(m_mutex);
    const auto [first, is_new] =
        m_frame_of.emplace(std::filesystem::path(filename).lexically_normal().string(), frame);
    if (!is_new && first->second != frame) {
        throw CommandError(
            "\"" + filename + "\" was written by " +
            (frame.named() ? sequence::item_title(first->second) + " (valid: a name with %N or %M"
                           : "frame " + std::to_string(first->second.frame) +
                                 " (valid: a name with # or {FRAME_NUMBER}") +
            ", another for each " + (frame.named() ? "case)" : "frame)"));
    }
}

void Session::claim(const std::string& filename) {
    if (settings.dry_run)
        return;
    if (written && !settings.compat)
        written->claim(filename, frame.item());
    outcome.claimed.push_back(filename);
}

OIIO::ColorConfig& color_config(Session& session) {
    Settings& settings = session.settings;
    if (!settings.ocio)
        settings.ocio = std::make_shared<OIIO::ColorConfig>(settings.color_config);
    return *settings.ocio;
}

} // namespace tonetool::chain
