// SPDX-License-Identifier: BSD-3-Clause
// evaluate(): a chain that is run for the images it leaves.
#include <algorithm>
#include <map>
#include <sstream>

#include "chain/session/runner.h"
#include "imagebuf/pixels/has_pixels.h"
#include "runs/check_run.h"
#include "runs/frames.h"
#include "runs/runs.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

using chain::DataFormat;
using chain::Image;
using chain::ImagePtr;
using chain::Part;
using chain::PartPtr;
using chain::Runner;
using chain::Session;

// Pixels that are still in a file, or that could not be read before, are read or are an error.
void read_given(OIIO::ImageBuf& pixels, const std::string& which) {
    std::string why;
    if (!pixels.initialized() || pixels.has_error() || !has_pixels(pixels)) {
        why = pixels.geterror();
        why = with_name(pixels, why.empty() ? "there is nothing to read" : why);
    } else if (is_file_to_read(pixels)) {
        try {
            pixels = read_whole(pixels, OIIO::TypeFloat);
        } catch (const Refusal& refusal) {
            why = refusal.what();
        }
    } else if (oiio::is_unread_file(pixels) &&
               !pixels.read(pixels.subimage(), pixels.miplevel(), true, OIIO::TypeFloat)) {
        why = pixels.geterror();
    }
    if (!why.empty())
        throw CommandError(which + " has no pixels: " + why);
}

// An image from outside is like one that was read.
void push_given(Session& session, OIIO::ImageBuf& pixels, size_t index) {
    const std::string which = "image " + std::to_string(index + 1);
    const bool unread = pixels.spec().undefined() || oiio::is_unread_file(pixels);
    const OIIO::ImageSpec native = unread ? pixels.nativespec() : pixels.spec();
    const std::string name = pixels.name().empty() ? which : std::string(pixels.name());
    const auto integers = chain::integers_of(native, std::string(pixels.file_format_name()));
    read_given(pixels, which);
    const DataFormat format{native.format, {}, native.get_int_attribute("oiio:BitsPerSample")};
    std::vector<OIIO::ImageBuf> levels(1);
    const bool is_float = pixels.spec().deep || pixels.spec().format == OIIO::TypeFloat;
    levels[0] = is_float ? std::move(pixels) : pixels.copy(OIIO::TypeFloat);
    auto part = std::make_shared<Part>(std::move(levels), format, integers);
    session.stack.types.widest = format;
    session.stack.first_header = session.stack.first_header.value_or(part->header());
    session.stack.push(std::make_shared<Image>(name, std::vector<PartPtr>{part}));
}

Left left(Session& session, const Image& image, const std::string& label) {
    Left out{image.name(), label, {}, {}};
    for (const PartPtr& part : image.parts()) {
        const OIIO::ImageBuf& pixels = part->pixels();
        out.subimages.push_back(pixels.copy(pixels.spec().format));
        out.formats.push_back(
            chain::output_type(*part, session.settings.output, session.writer("")));
    }
    return out;
}

void take_images(Session& session, Evaluation& result) {
    std::map<ImagePtr, std::string> labels;
    for (const auto& [label, image] : session.stack.labels)
        labels.emplace(image, label);
    for (const ImagePtr& image : session.stack.images) {
        auto label = labels.find(image);
        result.stack.push_back(left(session, *image, label == labels.end() ? "" : label->second));
    }
}

void evaluate_one(Session& session, std::vector<OIIO::ImageBuf>& images, const FramePlan& plan,
                  Evaluation& result) {
    if (plan.runs.size() != 1) {
        throw CommandError("wildcards fit " + std::to_string(plan.runs.size()) +
                           " frames, not one (--frames N chooses one)");
    }
    if (plan.check.only_validates)
        throw CommandError("--dry-run is for the program's command line");
    if (!plan.check.words.empty()) {
        throw CommandError("--" + plan.check.words.begin()->first +
                           " is for the frames of the program's command line");
    }
    for (size_t i = 0; i < images.size(); ++i)
        push_given(session, images[i], i);
    set_for_line(session, plan);
    session.frame = plan.runs[0].frame;
    session.in_all_frames = [&plan](size_t at) { return Strings{plan.runs[0].words.at(at)}; };
    Runner(session, plan.runs[0].words).run_all();
    if (session.outcome.errors == 0)
        take_images(session, result);
}

} // namespace

Evaluation evaluate(const Strings& given, std::vector<OIIO::ImageBuf> images,
                    const chain::Policy& policy) {
    know_all_commands();
    const chain::ParsedLine line = chain::parse_line(given);
    Evaluation result;
    std::ostringstream out, err;
    Session session(out, err, full_command_line(line, line.texts, false));
    session.settings.compat = line.compat;
    session.policy = policy;
    session.for_images = true;
    try {
        evaluate_one(session, images, plan_frames(line, policy.directory, true), result);
    } catch (const std::exception& problem) {
        session.error("", problem.what());
    }
    result.status = session.exit_status();
    result.error = session.outcome.first_error;
    if (result.error.empty() && result.status != 0 && result.status != 2)
        result.error = result.status == 3 ? "a threshold was exceeded" : "the images differ";
    result.out = out.str();
    result.err = err.str();
    result.warnings = session.outcome.warning_texts;
    result.files = session.files.names();
    if (session.outcome.errors > 0)
        result.stack.clear();
    return result;
}

} // namespace tonetool::runs
