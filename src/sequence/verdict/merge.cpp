// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/merge.h"

#include <OpenImageIO/strutil.h>
#include <map>
#include <set>
#include <stdexcept>

#include "sequence/frames/file_stamp.h"
#include "sequence/frames/pairing.h"
#include "sequence/results/results_json.h"
#include "sequence/results/shot_exposures.h"

namespace tonetool::sequence {

namespace {

const std::string kNoResult = "no part has a result of this ";

template <class Read>
auto read_part(const std::string& file, const Read& read) {
    try {
        return read(read_text(file));
    } catch (const std::runtime_error& problem) {
        throw std::runtime_error("\"" + file + "\": " + problem.what());
    }
}

void check_same(const ShotResult& whole, const ShotResult& part, const std::string& first,
                const std::string& file) {
    const auto quoted = [](const std::string& name) { return "\"" + name + "\""; };
    if (part.program != whole.program) {
        const auto made_by = [](const ShotResult& shot) {
            return shot.program.empty() ? "a version that does not say which" : shot.program;
        };
        throw std::runtime_error(quoted(file) + " was made by " + made_by(part) + ", " +
                                 quoted(first) + " by " + made_by(whole) +
                                 " (valid: parts of one version)");
    }
    if (part.check != whole.check) {
        throw std::runtime_error(quoted(file) + " is not of the same check as " + quoted(first) +
                                 ": " + OIIO::Strutil::join(part.check, " ") + " instead of " +
                                 OIIO::Strutil::join(whole.check, " "));
    }
    if (!(part.exposures == whole.exposures)) {
        throw std::runtime_error(quoted(file) + " was made with other exposures of the shot than " +
                                 quoted(first));
    }
}

// In every view, and of every case, that some part has.
void add_frames_without_result(ShotResult& shot, const std::vector<Item>& expected,
                               const std::string& advice) {
    std::set<Item> there;
    std::set<Series> series;
    for (const FrameResult& frame : shot.frames) {
        there.insert(frame.item());
        series.insert(series_of(frame.item()));
    }
    if (series.empty())
        series.insert({});
    const auto expect = [&](const Item& item) {
        if (!there.insert(item).second)
            return;
        FrameResult frame;
        frame.frame = item.frame;
        frame.view = item.view;
        frame.name = item.name;
        frame.method = item.method;
        frame.message = kNoResult + (item.named() ? "case" : "frame") + advice;
        shot.frames.push_back(frame);
    };
    for (const Item& item : expected) {
        if (item.named()) {
            expect(item);
            continue;
        }
        for (const Series& of : series)
            expect({item.frame, of.view, of.name, of.method});
    }
}

// A part that an earlier task has left says nothing of what was rendered since.
void mark_outdated(ShotResult& part, const std::string& file) {
    const int64_t made = stamp_of(file).written;
    for (FrameResult& frame : part.frames) {
        for (const std::string& image : {frame.reference, frame.test}) {
            if (frame.status > Status::Failed || image.empty() || stamp_of(image).written <= made)
                continue;
            frame.status = Status::Error;
            frame.message = "\"" + image + "\" was written after the part \"" + file +
                            "\" (valid: a part that is made again)";
        }
    }
}

// The frames of the parts and, of each case and view, those in between: that all parts lack one
// says nothing of it.
std::vector<Item> filled(const std::vector<FrameResult>& frames) {
    std::map<std::pair<std::string, std::string>, std::set<Item>> numbers;
    for (const FrameResult& frame : frames)
        numbers[{frame.name, frame.method}].insert(frame.item());
    std::vector<Item> all;
    for (auto& of : numbers) {
        fill_holes(of.second);
        all.insert(all.end(), of.second.begin(), of.second.end());
    }
    return all;
}

} // namespace

ShotResult merged(const std::vector<std::string>& parts, const std::vector<Item>& expected,
                  std::vector<std::string>& complaints) {
    if (parts.empty())
        throw std::runtime_error("there is no part to merge (valid: --merge PART.json ...)");
    ShotResult whole;
    std::string first;
    for (const std::string& file : parts) {
        ShotResult part;
        try {
            part = read_part(file, shot_from_json);
        } catch (const std::runtime_error& problem) {
            if (expected.empty())
                throw;
            complaints.push_back(problem.what());
            continue;
        }
        if (first.empty()) {
            first = file;
            whole.program = part.program;
            whole.check = part.check;
            whole.exposures = part.exposures;
            whole.suite = part.suite;
        }
        check_same(whole, part, first, file);
        // One alone, of which nobody says what it is to have, may be an old result that is
        // printed again.
        if (parts.size() > 1 || !expected.empty())
            mark_outdated(part, file);
        whole.cases = std::max(whole.cases, part.cases);
        std::move(part.frames.begin(), part.frames.end(), std::back_inserter(whole.frames));
        std::move(part.accepted.begin(), part.accepted.end(), std::back_inserter(whole.accepted));
    }
    add_frames_without_result(whole, expected.empty() ? filled(whole.frames) : expected,
                              expected.empty() ? " (valid: --frames, if it is not to be there)"
                                               : "");
    if (whole.cases <= whole.frames.size()) // nothing is left out any more
        whole.cases = 0;
    else
        complaints.push_back("the parts have " + std::to_string(whole.frames.size()) + " of " +
                             std::to_string(whole.cases) +
                             " cases (--suite FILE with --merge tells which are missing)");
    conclude(whole);
    return whole;
}

bool is_of_no_part(const FrameResult& frame) {
    return frame.status == Status::Error &&
           frame.message.compare(0, kNoResult.size(), kNoResult) == 0;
}

std::string merged_exposures(const std::vector<std::string>& parts) {
    ExposureSamples all;
    for (const std::string& file : parts) {
        const ExposureSamples samples = read_part(file, samples_from_json);
        all.insert(all.end(), samples.begin(), samples.end());
    }
    shot_exposures(all); // says if there are none
    return to_json(all);
}

} // namespace tonetool::sequence
