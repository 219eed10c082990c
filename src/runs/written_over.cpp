// SPDX-License-Identifier: BSD-3-Clause
#include "runs/written_over.h"

#include <OpenImageIO/imageio.h>
#include <algorithm>
#include <filesystem>
#include <set>

#include "runs/check_end.h"
#include "runs/frame_context.h"
#include "sequence/frames/file_stamp.h"
#include "sequence/results/limits_file.h"
#include "text/error.h"
#include "text/token.h"

namespace tonetool::runs {

namespace {

std::string normal(const std::string& file) {
    return std::filesystem::path(file).lexically_normal().string();
}

// A file that is written at the end, and what is in its place before.
struct EndFile {
    std::string command, file; // "json", and its argument
    std::string path;
    sequence::Stamp stamp;

    bool is(const std::string& other) const {
        if (path == normal(other))
            return true;
        const sequence::Stamp found = sequence::stamp_of(stamp.inode == 0 ? "" : other);
        return found.inode != 0 && found.inode == stamp.inode && found.device == stamp.device;
    }
    [[noreturn]] void refuse(const std::string& other, const std::string& why) const {
        throw CommandError("--" + command + ": \"" + file + "\" " +
                           (file == other ? "" : "is the file \"" + other + "\", which ") + why +
                           " (valid: a file of its own)");
    }
};

std::vector<EndFile> places_of(const CheckPlan& check) {
    std::vector<EndFile> places;
    for (const auto& [command, file] : check.written()) {
        const bool is_file = command != "merge" && command != "state" && command != "pictures" &&
                             command != "exit-zero" && command != "accept" && command != "github" &&
                             command != "images" && command != "ctest";
        if (is_file && file != "-")
            places.push_back({command, file, normal(file), sequence::stamp_of(file)});
    }
    return places;
}

// A text in the place of a frame is a slip, whether this line reads that frame or not; so is a
// picture in a file that cannot hold one.
void refuse_name_of_other_kind(const EndFile& place) {
    const bool picture = place.command == "figure" || place.command == "contactsheet";
    const bool image = bool(OIIO::ImageOutput::create(place.file));
    (void)OIIO::geterror();
    if (picture && !image)
        throw CommandError("--" + place.command + ": \"" + place.file +
                           "\" has no extension of an image that can be written (valid: .png, "
                           ".tif, .jpg, .exr and others)");
    if (picture)
        return;
    const std::string ending = place.command == "report" ? "html"
                               : place.command == "csv"  ? "csv"
                                                         : "json";
    if (image)
        throw CommandError("--" + place.command + ": \"" + place.file +
                           "\" has the name of an image (valid: a name of its own, such as check." +
                           ending + ")");
}

// The names of files that a run reads, images and others.
Strings files_read(const FramePlan& plan, const FrameRun& run) {
    const Strings& texts = run.words;
    Strings files = words_at(texts, plan.check_of(run).inputs);
    for (const chain::Word& word : plan.line_of(run).words) {
        if (!word.row)
            continue;
        const bool reads = !word.row->writes() || word.is("accept") || word.is("suite");
        for (size_t i = 0; i < word.arguments.size() && reads; ++i)
            if (chain::names_file(word.argument_name(i)))
                files.push_back(texts[word.arguments[i]]);
        for (const auto& [key, text] : parse_token(texts[word.at], true).modifiers) {
            if ((key == "fail" || key == "warn") && sequence::names_limits_file(text))
                files.push_back(text);
            for (const chain::Modifier& modifier : word.row->modifiers)
                if (modifier.key == key && chain::value_names_file(modifier, text))
                    files.push_back(text);
        }
    }
    return files;
}

void refuse_in_run(const FramePlan& plan, const std::vector<EndFile>& places, const Strings& texts,
                   const Strings& read) {
    const Strings outputs = words_at(texts, plan.check.outputs);
    for (const EndFile& place : places) {
        for (const std::string& file : read) {
            // The JSON of a check has the exposures that were read of it.
            const bool keeps = place.command == "json" && file == plan.check.exposures;
            if (!keeps && place.is(file))
                place.refuse(file, "is read, and would be written over");
        }
        for (const std::string& file : outputs)
            if (place.is(file))
                place.refuse(file, "is written as an image, too");
    }
}

// The place of the last comparison; behind all words: there is none.
size_t last_comparison(const chain::ParsedLine& line) {
    size_t last = line.texts.size();
    for (const chain::Word& word : line.words)
        last = word.row && word.row->group == chain::Group::Compare ? word.at : last;
    return last;
}

// Outputs of a line that judges in the place of what it compares: the frame that reads it next
// would compare the output of another, and nobody has the image any more. A line of one frame may
// write over an image before it compares.
void refuse_over_compared(const FramePlan& plan) {
    if (!plan.check.judges() || plan.check.outputs.empty())
        return;
    std::set<std::string> read;
    for (const FrameRun& run : plan.runs)
        for (const std::string& file : words_at(run.words, plan.check.inputs))
            read.insert(sequence::place_of(file));
    const size_t last = plan.runs.size() > 1 ? 0 : last_comparison(plan.line);
    for (const FrameRun& run : plan.runs) {
        for (const size_t at : plan.check.outputs) {
            const std::string& file = run.words.at(at);
            if (at >= last && file.find('{') == std::string::npos &&
                read.count(sequence::place_of(file)) > 0)
                throw CommandError("\"" + file +
                                   "\" is read by this check, and -o would write over it");
        }
    }
}

// An image that a case may get is one that is read.
void refuse_images(const FramePlan& plan) {
    const auto images = case_images(plan.check, plan.check.essence);
    if (!images)
        return;
    std::set<std::string> read;
    for (const FrameRun& run : plan.runs)
        for (const std::string& file : files_read(plan, run))
            read.insert(normal(file));
    for (size_t i = 0; i < plan.runs.size(); ++i) {
        const sequence::CaseFiles::Of files = images->files(unchecked_frame(plan, i));
        for (const auto& kind : sequence::CaseFiles::kAll) {
            const std::string& file = files.*kind.second;
            if (read.count(normal(file)) > 0)
                throw CommandError("--images: \"" + file +
                                   "\" is read, and would be written "
                                   "over (valid: a folder of its own)");
        }
    }
}

} // namespace

void refuse_to_write_over(const FramePlan& plan, const Strings& parts) {
    refuse_images(plan);
    refuse_over_compared(plan);
    const std::vector<EndFile> places = places_of(plan.check);
    if (plan.check.has("merge"))
        refuse_in_run(plan, places, plan.line.texts, parts);
    for (size_t i = 0; i < plan.runs.size() && !places.empty(); ++i)
        refuse_in_run(plan, places, plan.runs[i].words, files_read(plan, plan.runs[i]));
    std::for_each(places.begin(), places.end(), refuse_name_of_other_kind);
}

} // namespace tonetool::runs
