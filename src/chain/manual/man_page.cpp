// SPDX-License-Identifier: BSD-3-Clause
// The man page, in troff.
#include <algorithm>

#include "chain/manual/help.h"
#include "chain/manual/topics.h"
#include "tonetool/export.h"

namespace tonetool::chain {

namespace {

std::string escaped(std::string text) {
    for (size_t at = 0; (at = text.find_first_of("\\-", at)) != std::string::npos; at += 2)
        text.insert(at, "\\");
    return text;
}

// A line may end behind the "|" and "," of long lists.
std::string troff(const std::string& text) {
    std::string safe = escaped(text);
    for (size_t at = 0; (at = safe.find_first_of("|,", at)) != std::string::npos; at += 3)
        safe.insert(at + 1, "\\:");
    return !safe.empty() && (safe[0] == '.' || safe[0] == '\'') ? "\\&" + safe : safe;
}

std::string section(const std::string& title) {
    return ".SH " + troff(title) + "\n";
}

// As it stands, line by line.
std::string verbatim(const std::string& lines) {
    std::string text = ".nf\n";
    for (const std::string& line : split(lines.substr(0, lines.size() - 1), '\n'))
        text += troff(line) + "\n";
    return text + ".fi\n";
}

struct Entry {
    const char *name, *text;
};

const Entry kEnvironment[] = {
    {"OCIO", "The OpenColorIO configuration, where --colorconfig names none."},
    {"OIIO_LIBRARY_PATH",
     "Folders in which OpenImageIO looks for plugins; a program that is to read "
     "recipes finds tone.imageio.so there. --doctor says whether it does."},
    {"OPENIMAGEIO_THREADS", "Number of threads, where --threads says none."},
    {"OPENIMAGEIO_FONTS", "Folders of fonts for --text and --contactsheet."}};

const Entry kFiles[] = {
    {"*.tone", "Recipes: command lines that are read as images. See --help recipes."},
    {"share/tonetool/ocio/tonetool.ocio",
     "An OpenColorIO configuration with ACES views and each tone "
     "curve as a view."},
    {"share/tonetool/check.schema.json", "The schema of what --json writes."}};

const Entry kExamples[] = {
    {"tonetool ref.exr test.exr --hdrflip:fail=p99.9=0.7 -o error.exr",
     "Compare two renders, write the error map, and fail with status 3 where a thousandth of the "
     "pixels has an error above 0.7."},
    {"tonetool --frames 1-100 ref.#.exr test.#.exr --hdrflip:exposures=shot:fail=p99.9=0.7 "
     "--report "
     "check.html --junit check.xml",
     "The same for a sequence, with a page to look at and a file for a CI system."},
    {"tonetool shot.#.exr --qc --json check.json", "Look for faults that need no reference."},
    {"tonetool picture.exr --tonemap:curve=agx:method=mean -o picture.png",
     "Show an HDR picture."}};

template <size_t N>
std::string entries(const Entry (&list)[N]) {
    std::string text;
    for (const Entry& entry : list)
        text += ".TP\n.B " + troff(entry.name) + "\n" + troff(entry.text) + "\n";
    return text;
}

std::string modifiers_text(const Modifiers& modifiers) {
    std::string text;
    for (const Modifier& modifier : modifiers) {
        text += ".br\n\\fI:" + troff(modifier.key + "=" + modifier.hint) + "\\fR  " +
                troff(modifier.help) + "\n";
    }
    return text;
}

std::string command_text(const Command& row) {
    Strings names;
    for (const std::string& name : row.names)
        names.push_back("\\fB" + troff(dashed(name)) + "\\fR");
    const SortedModifiers modifiers = sorted_modifiers(row);
    return ".TP\n" + join(names, ", ") + " " + troff(join(row.args, " ")) + "\n" + troff(row.help) +
           "\n" + modifiers_text(modifiers.frequent) + modifiers_text(modifiers.others) +
           modifiers_text(modifiers.of_curves);
}

std::string command_sections() {
    std::string text;
    for_each_group(command_text, [&](const std::string& title, const std::string& rows) {
        text += ".SS " + troff(title) + "\n" + rows;
    });
    return text;
}

// The title of a topic is its first line.
std::string topic_sections() {
    std::string text;
    for (const Topic& topic : topics()) {
        const std::string all = topic.text;
        if (std::string(topic.name) != "exit") // it has a section of its own
            text += ".SS " + troff(all.substr(0, all.find('\n'))) + "\n" +
                    verbatim(all.substr(all.find('\n') + 2));
    }
    return text;
}

// Flush left: groff 1.23 takes the string AD in each paragraph, older ones keep the request.
constexpr const char* kFlushLeft = ".ds AD l\n.ad l\n";

} // namespace

std::string man_page() {
    return ".TH TONETOOL 1 \"\" \"tonetool " TONETOOL_VERSION "\" \"User Commands\"\n" +
           std::string(kFlushLeft) + section("NAME") +
           "tonetool \\- compare and tone map HDR images\n" + section("SYNOPSIS") +
           ".B tonetool\n[\\fIfilename\\fR|\\fIcommand\\fR]...\n" + section("DESCRIPTION") +
           verbatim(usage_text().substr(usage_text().find('\n') + 1)) + section("EXAMPLES") +
           entries(kExamples) + section("SUBJECTS") + topic_sections() + section("COMMANDS") +
           command_sections() + section("EXIT STATUS") + verbatim(kExitStatusText) +
           section("ENVIRONMENT") + entries(kEnvironment) + section("FILES") + entries(kFiles) +
           section("SEE ALSO") + ".BR oiiotool (1),\n.BR idiff (1),\n.BR iinfo (1)\n";
}

} // namespace tonetool::chain
