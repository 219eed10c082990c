// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/automatic_limits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <tuple>

namespace tonetool::sequence {

namespace {

double median_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const size_t half = values.size() / 2;
    return values.size() % 2 == 1 ? values[half] : (values[half - 1] + values[half]) / 2;
}

// 1.4826 makes the standard deviation of a normal distribution of the median distance.
double limit_of(const std::vector<double>& values) {
    constexpr double deviations = 5, normal = 1.4826, least = 1.15;
    const double middle = median_of(values);
    std::vector<double> distances;
    for (const double value : values)
        distances.push_back(std::abs(value - middle));
    return std::max(middle + deviations * normal * median_of(distances), least * middle);
}

bool is_bounded(const std::string& command) {
    return command == "hdrflip" || command == "ldrflip";
}

// A series, the place of a measurement in its frame, a quantity, and the command.
using Key = std::tuple<Series, size_t, std::string, std::string>;

template <class Visit>
void each_automatic(std::vector<FrameResult>& frames, const Visit& visit) {
    for (FrameResult& frame : frames)
        for (size_t i = 0; i < frame.measurements.size(); ++i)
            for (Threshold& threshold : frame.measurements[i].thresholds)
                if (threshold.automatic)
                    visit(frame,
                          Key{series_of(frame.item()), i, threshold.quantity,
                              frame.measurements[i].command},
                          threshold);
}

} // namespace

void set_automatic_limits(std::vector<FrameResult>& frames) {
    std::map<Key, std::vector<double>> values;
    each_automatic(frames, [&](const FrameResult&, const Key& key, const Threshold& threshold) {
        if (!std::isnan(threshold.value))
            values[key].push_back(threshold.value);
    });
    if (values.empty())
        return;
    each_automatic(frames, [&](const FrameResult&, const Key& key, Threshold& threshold) {
        const std::vector<double>& all = values[key];
        const double limit = all.size() < kEnoughForLimit ? std::nan("") : limit_of(all);
        // A limit that no error exceeds is none.
        threshold.fail = is_bounded(std::get<3>(key)) && limit >= 1 ? std::nan("") : limit;
    });
    for (FrameResult& frame : frames)
        if (has_automatic_limit(frame))
            judge(frame);
}

bool has_automatic_limit(const FrameResult& frame) {
    return std::any_of(frame.measurements.begin(), frame.measurements.end(), [](const auto& one) {
        return std::any_of(one.thresholds.begin(), one.thresholds.end(),
                           [](const Threshold& threshold) { return threshold.automatic; });
    });
}

} // namespace tonetool::sequence
