// SPDX-License-Identifier: BSD-3-Clause
// Facts of frames that no file has, and what is found in a shot of them.
#pragma once

#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "sequence/qc/qc.h"

namespace tonetool::sequence {

/// Facts as of a picture that pans over a wall, without any pixel.
inline QcFacts facts_of(int number, double stops = 0) {
    QcFacts facts;
    facts.parts.push_back({"", {0, 0, 640, 360}, {0, 0, 640, 360}, "zip", {{"Software", "r 1"}}});
    facts.channels = {{"R", "half"},     {"G", "half"},     {"B", "half"},
                      {"key.R", "half"}, {"key.G", "half"}, {"key.B", "half"}};
    QcLayer picture{"", "picture", "", false, 200000, 0, 3, 0.4, {}, {}, {}};
    QcLayer key{"C_key", "light", "", false, 90000, 0, 2, 0.1, {}, {}, {}};
    facts.layers = {picture, key};
    facts.picture.hash = std::to_string(number) + std::to_string(stops);
    for (int y = 0; y < QcPicture::kHigh; ++y) {
        for (int x = 0; x < QcPicture::kWide; ++x) {
            const double wall = std::sin(0.9 * x + 0.05 * number) + std::sin(0.7 * y - 0.3 * x);
            facts.picture.thumbnail.push_back(int16_t(std::lround(1000 * (wall + stops))));
        }
    }
    facts.picture.red.assign(facts.picture.thumbnail.size(), 8);
    facts.picture.blue.assign(facts.picture.thumbnail.size(), -4);
    std::mt19937 noise(unsigned(number) + 1);
    for (int i = 0; i < QcPicture::kPeaksWide * QcPicture::kPeaksHigh; ++i) {
        facts.picture.peaks.push_back(20);
        facts.picture.fingerprints.push_back(uint16_t(noise() % 65535 + 1));
    }
    facts.picture.groups = 1;
    facts.picture.group_sum = 1;
    facts.picture.group_difference = 1e-4;
    return facts;
}

inline FrameResult result_of(int number, const QcFacts& facts,
                             const FaultLimits& limits = FaultLimits(qc_rules())) {
    FrameResult result;
    result.frame = number;
    result.status = Status::Passed;
    result.qc = to_json(QcRecord{facts, limits});
    return result;
}

/// The number and the code of each fault.
inline std::vector<std::string> codes_of(std::vector<FrameResult> frames) {
    judge_qc(frames);
    std::vector<std::string> codes;
    for (const FrameResult& frame : frames)
        for (const Fault& fault : frame.faults)
            codes.push_back(std::to_string(frame.frame) + " " + fault.code);
    return codes;
}

} // namespace tonetool::sequence
