// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/contradiction.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "metrics/errors.h"
#include "metrics/tmqi.h"
#include "text/text.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

// Also of what a sum or a logarithm has rounded.
bool near(double a, double b) {
    return same(a, b) || std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

// Pixels differ where the largest difference is above what one may have.
std::string contradictory_diff(const Measurement& measured, const Asked& asked, bool perceived) {
    const Threshold& only = measured.thresholds.at(0);
    if (only.quantity == "differing-images")
        return "";
    const auto most = quantity_of(measured, "max");
    if (!most)
        return " has no max";
    const bool holds = only.value <= only.fail.value_or(HUGE_VAL); // it does not fail
    const bool passes = only.fail && holds;
    const bool told = !perceived && std::isfinite(*most); // which pixels differ, by the limits
    const auto beyond = [&](const DiffLimit& limit) {
        const bool one = told && limit.percent == 0 && *most > double(limit.each);
        return one || *most > double(limit.hardest);
    };
    if ((holds && beyond(asked.diff.fail)) || (passes && beyond(asked.diff.warn))) {
        return format(" has a max of {}, which is above a limit of the check, but {} {} is not",
                      *most, only.quantity, only.value);
    }
    if (!told)
        return "";
    const DiffLimit& limit = only.fail ? asked.diff.fail : asked.diff.warn;
    if (only.quantity == "differing-pixels" && (only.value > 0) != (*most > double(limit.each))) {
        return format(" has differing-pixels {}, which contradicts its max of {}", only.value,
                      *most);
    }
    for (const char* name : {"mean", "rms"}) {
        const auto value = quantity_of(measured, name);
        if (value && std::isfinite(*value) && (*value > 0) != (*most > 0))
            return format(" has a {} of {}, which contradicts its max of {}", name, *value, *most);
    }
    return "";
}

// A map's element of a rank, which two ways to round may give differently.
struct Ranked {
    double percent;
    std::string name;
    double value;
    double lowest, highest; ///< rank
};

std::vector<Ranked> ranked(const Measurement& measured) {
    const auto last = double(std::max(measured.pixels, 1LL)) - 1;
    std::vector<Ranked> all;
    for (const auto& [name, value] : measured.quantities) {
        // A NaN where it is no percentile.
        const double percent =
            name[0] == 'p' ? parse_number(name.substr(1)).value_or(std::nan("")) : std::nan("");
        if (name == "min" || name == "max") {
            const double rank = name == "min" ? 0 : last;
            all.push_back({name == "min" ? -1.0 : 101.0, name, value, rank, rank});
        } else if (!std::isnan(percent)) {
            const double at = percent * double(measured.pixels) / 100;
            const auto rank = [&](double moved) {
                return std::min(std::max(std::ceil(moved) - 1, 0.0), last);
            };
            all.push_back({percent, name, value, rank(at - 1e-6), rank(at + 1e-6)});
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Ranked& a, const Ranked& b) { return a.percent < b.percent; });
    return all;
}

std::string not_between(const std::string& name, double value, double low, double high,
                        const std::string& by) {
    const double rounding = 1e-9 * std::max(std::abs(low), std::abs(high));
    return value < low - rounding || value > high + rounding
               ? format(" has a {} of {}, but {} {} to {}", name, value, by, low, high)
               : "";
}

std::string unordered(const std::vector<Ranked>& all) {
    for (size_t i = 1; i < all.size(); ++i) {
        if (all[i - 1].value > all[i].value) {
            return format(" has {} {} above {} {}", all[i - 1].name, all[i - 1].value, all[i].name,
                          all[i].value);
        }
    }
    return "";
}

// Each element stands for those up to the next one's rank.
std::string mean_beside(const std::vector<Ranked>& all, double mean, double pixels) {
    double low = all.back().value, high = all.front().value;
    for (size_t i = 1; i < all.size(); ++i) {
        low += all[i - 1].value * std::max(0.0, all[i].highest - all[i - 1].highest);
        high += all[i].value * std::max(0.0, all[i].lowest - all[i - 1].lowest);
    }
    return not_between("mean", mean, low / pixels, high / pixels, "its percentiles give");
}

class Histogram {
public:
    explicit Histogram(const Measurement& measured) : m_counts(measured.histogram) {}

    std::string problem(const Measurement& measured, const std::vector<Ranked>& all) const {
        if (m_counts.size() != buckets)
            return format(" has a histogram of {} buckets (valid: {})", m_counts.size(), buckets);
        const double pixels = below(buckets);
        if (pixels != double(measured.pixels) ||
            *std::min_element(m_counts.begin(), m_counts.end()) < 0) {
            return format(" has a histogram of {} pixels, but compared {}", pixels,
                          measured.pixels);
        }
        for (const Ranked& one : all) {
            const size_t at = bucket(one.value);
            if (pixels > 0 && (below(at) > one.highest || below(at + 1) <= one.lowest))
                return format(" has {} {}, which its histogram contradicts", one.name, one.value);
        }
        return shares(measured, pixels);
    }

    // Where the extremes are known.
    std::string mean_problem(double mean, double least, double most) const {
        double low = 0, high = 0;
        for (size_t i = 0; i < buckets; ++i) {
            const double count = double(m_counts[i]), wide = double(buckets);
            low += count * (i == 0 ? least : std::max(least, double(i) / wide));
            high += count * (i + 1 == buckets ? most : std::min(most, double(i + 1) / wide));
        }
        const double pixels = below(buckets);
        return not_between("mean", mean, low / pixels, high / pixels, "its histogram gives");
    }

private:
    static constexpr size_t buckets = std::tuple_size_v<decltype(FlipPool::histogram)>;

    static size_t bucket(double value) {
        return value > 0 ? size_t(std::min(value * double(buckets), double(buckets) - 1)) : 0;
    }

    double below(size_t end) const {
        double sum = 0;
        for (size_t i = 0; i < end; ++i)
            sum += double(m_counts[i]);
        return sum;
    }

    std::string shares(const Measurement& measured, double pixels) const {
        for (const auto& [name, share] : measured.quantities) {
            const auto error = OIIO::Strutil::starts_with(name, "above")
                                   ? parse_number(name.substr(5))
                                   : std::nullopt;
            if (!error || pixels <= 0)
                continue;
            const size_t at = bucket(*error);
            const std::string why =
                not_between(name, share, (pixels - below(at + 1)) / pixels,
                            (pixels - below(at)) / pixels, "its histogram gives");
            if (!why.empty())
                return why;
        }
        return "";
    }

    const std::vector<long long>& m_counts;
};

std::string contradictory_map(const Measurement& measured) {
    const std::vector<Ranked> all = ranked(measured);
    const auto mean = quantity_of(measured, "mean"), least = quantity_of(measured, "min"),
               most = quantity_of(measured, "max");
    if (most && !std::isfinite(*most)) { // what is not finite has no rank, but it is in the mean
        return mean && std::isfinite(*mean)
                   ? format(" has a max of {}, but a mean of {}", *most, *mean)
                   : "";
    }
    std::string why = unordered(all);
    for (const char* name : {"weighted-q1", "weighted-median", "weighted-q3", "mean"}) {
        const auto value = quantity_of(measured, name);
        if (why.empty() && value && least && most)
            why = not_between(name, *value, *least, *most, "its extremes are");
    }
    if (why.empty() && !measured.histogram.empty()) {
        const Histogram histogram(measured);
        why = histogram.problem(measured, all);
        if (why.empty() && mean && least && most && measured.pixels > 0)
            why = histogram.mean_problem(*mean, *least, *most);
    }
    if (why.empty() && mean && least && most && measured.pixels > 0)
        why = mean_beside(all, *mean, double(measured.pixels));
    return why;
}

// The measure of --errormap is the map's mean, or that in decibels.
std::string contradictory_error(const Measurement& measured, const Asked& asked) {
    if (measured.quantities.empty())
        return " has no quantities";
    const auto& [name, value] = measured.quantities.front();
    if (!asked.open && name != asked.metric)
        return " is of " + name + ", but the check's metric is " + asked.metric;
    const auto mean = quantity_of(measured, "mean");
    if (!mean || asked.open)
        return "";
    const metrics::ErrorMetric* metric = metrics::find_error_metric(name);
    const double wanted = metric ? metric->measure(*mean, asked.peak) : *mean;
    return near(value, wanted)
               ? ""
               : format(" has {} {}, but its mean of {} gives {}", name, value, *mean, wanted);
}

std::string contradictory_tmqi(const Measurement& measured) {
    const auto q = quantity_of(measured, "Q"), s = quantity_of(measured, "S"),
               n = quantity_of(measured, "N");
    if (!q || !s || !n)
        return "";
    const double wanted = metrics::tmqi_index(*s, *n);
    return near(*q, wanted) ? ""
                            : format(" has Q {}, but S {} and N {} give {}", *q, *s, *n, wanted);
}

} // namespace

std::string contradictory_thresholds(const Measurement& measured) {
    std::set<std::string> names;
    for (const Threshold& threshold : measured.thresholds) {
        const std::string& name = threshold.quantity;
        const auto value = quantity_of(measured, name);
        if (!names.insert(name).second)
            return " has two thresholds of " + name;
        if (value && !same(*value, threshold.value)) {
            return format(": the threshold is held against {} {}, but {} is {}", name,
                          threshold.value, name, *value);
        }
        const MeasuringCommand& command = *measuring_command(measured.command);
        const bool measures = !command.compares_values() && command.scoring != Scoring::Verdict;
        if (!value && measures)
            return " has a threshold of " + name + ", but no such quantity";
        if (threshold.higher_is_better != higher_is_better(measured.command, name)) {
            const char *said = threshold.higher_is_better ? "higher" : "lower",
                       *true_one = threshold.higher_is_better ? "lower" : "higher";
            return format(" has a threshold of {} for which {} is better, but {} is", name, said,
                          true_one);
        }
    }
    return "";
}

std::string contradictory_numbers(const Measurement& measured, const Asked& asked) {
    const Scoring scoring = measuring_command(measured.command)->scoring;
    std::string why;
    switch (scoring) {
    case Scoring::Values:
    case Scoring::Perceived:
        return asked.open ? "" : contradictory_diff(measured, asked, scoring == Scoring::Perceived);
    case Scoring::Index:
        return contradictory_tmqi(measured);
    case Scoring::Verdict:
        return contradictory_verdict(measured);
    case Scoring::Error:
        why = contradictory_error(measured, asked);
        break;
    case Scoring::Map:
        break;
    }
    return why.empty() ? contradictory_map(measured) : why;
}

} // namespace tonetool::sequence
