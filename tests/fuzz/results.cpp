// SPDX-License-Identifier: BSD-3-Clause
// JSON of checks: results, frames, exposures, what --qc measured; and their merge.
#include "sequence/qc/qc_json.h"
#include "sequence/results/results_json.h"
#include "sequence/results/shot_exposures.h"
#include "sequence/verdict/merge.h"

#include <algorithm>
#include <exception>

#include "fuzz.h"

namespace {

using namespace tonetool;
using namespace tonetool::sequence;

bool holds(const Measurement& measured) {
    return !measured.thresholds.empty() && measured.status == Status::Passed;
}

// A check that passes when it should not is the worst that there is.
void look_at(const ShotResult& shot) {
    fuzz::require(!shot.frames.empty() || shot.verdict == Status::Error, "nothing is no pass");
    for (const FrameResult& frame : shot.frames) {
        const bool sound = !frame.qc.empty() || !frame.faults.empty() ||
                           std::any_of(frame.measurements.begin(), frame.measurements.end(), holds);
        fuzz::require(frame.status != Status::Passed || sound, "a pass has a limit that held");
        fuzz::require(shot.verdict >= frame.status, "no frame is worse than the verdict");
    }
    const std::string text = to_json(shot);
    fuzz::require(to_json(shot_from_json(text)) == text, "a result comes back");
}

template <class Read>
void attempt(const Read& read) {
    try {
        read();
    } catch (const std::exception& problem) {
        fuzz::require(*problem.what() != '\0', "an error has a text");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string text = fuzz::text_of(data, size);
    std::optional<ShotResult> shot;
    attempt([&] { shot = shot_from_json(text); });
    if (shot)
        look_at(*shot);
    attempt([&] { (void)frame_from_json(text); });
    attempt([&] { (void)to_json(samples_from_json(text)); });
    attempt([&] { (void)qc_from_json(text); });
    const std::string file = fuzz::file_of(text, "part.json");
    attempt([&] { (void)read_exposures(file); });
    attempt([&] { (void)merged_exposures({file}); });
    std::optional<ShotResult> whole;
    std::vector<std::string> complaints;
    attempt([&] { whole = merged({file}, {{1, ""}, {2, ""}}, complaints); });
    if (whole)
        look_at(*whole);
    return 0;
}
