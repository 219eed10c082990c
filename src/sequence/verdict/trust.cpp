#include "sequence/verdict/trust.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <stdexcept>
#include <tuple>

#include "text/text.h"
#include "text/token.h"
#include "tonetool/tonetool.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

std::string name_of(const FrameResult& frame) {
    return "frame " + std::to_string(frame.frame) + (frame.view.empty() ? "" : " " + frame.view);
}

using Limits = std::map<std::string, double>; ///< by the name of the quantity

// What --diff lets pass, by the names of the options that say so.
Limits usual_diff_limits() {
    return {{"fail", 1e-6f}, {"failpercent", 0}, {"hardfail", 1e30f},
            {"warn", 1e-6f}, {"warnpercent", 0}, {"hardwarn", 1e30f}};
}

// A word of the check that measures.
struct Asked {
    bool limited = false; ///< it has a limit
    bool open = false;    ///< but its numbers are those of an expression, which is not known here
    Limits fail, warn;
    std::string metric; ///< of --errormap
    double peak = 1;
    Limits diff;
};

struct Check {
    std::map<std::string, std::vector<Asked>> asked; ///< by the name of the command
    bool open = false;                               ///< an expression stands for a command
    bool blocks = false;                             ///< not every word runs once
};

bool compares_values(const std::string& command) {
    return command == "diff" || command == "pdiff";
}

bool measures(const std::string& command) {
    static const std::set<std::string> all{"hdrflip",  "ldrflip", "flipdiff", "filmstrip",
                                           "errormap", "tmqi",    "diff",     "pdiff"};
    return all.count(command) > 0;
}

std::string modifier(const Token& token, const std::string& key) {
    const auto found = std::find_if(token.modifiers.begin(), token.modifiers.end(),
                                    [&](const auto& one) { return one.first == key; });
    return found == token.modifiers.end() ? "" : found->second;
}

// As results name it: "above0.1" of quantity=above:above=0.1.
std::string quantity_name(const Token& token, const std::string& name) {
    const auto error = name == "above" ? parse_number(modifier(token, "above")) : std::nullopt;
    const std::string whole = error ? name + format_apart(*error, 0) : name;
    return ToneAlgo::flip_quantity_name(whole).value_or(whole);
}

std::string first_quantity(const Token& token) {
    return token.name == "flipdiff"   ? "max"
           : token.name == "errormap" ? modifier(token, "metric")
           : token.name == "tmqi"     ? ToneAlgo::tmqi_quantities().front()
                                      : ToneAlgo::flip_quantities().front();
}

Limits limits_of(const Token& token, const std::string& key, bool& open) {
    Limits limits;
    const std::string text = modifier(token, key), named = modifier(token, "quantity");
    for (const std::string& word : text.empty() ? Strings{} : split(text, ',')) {
        const size_t equals = word.find('=');
        const bool has_name = equals != std::string::npos;
        const auto limit = parse_number(has_name ? word.substr(equals + 1) : word);
        const std::string name = has_name        ? word.substr(0, equals)
                                 : named.empty() ? first_quantity(token)
                                                 : named;
        open = open || !limit;
        limits[quantity_name(token, name)] = limit.value_or(0);
    }
    return limits;
}

Asked asked_of(const Token& token, const Limits& diff, bool open) {
    Asked asked;
    asked.open = open || token.text.find('{') != std::string::npos;
    asked.fail = limits_of(token, "fail", asked.open);
    asked.warn = limits_of(token, "warn", asked.open);
    asked.limited = compares_values(token.name) || !asked.fail.empty() || !asked.warn.empty();
    asked.metric = modifier(token, "metric");
    asked.peak = parse_number(modifier(token, "peak")).value_or(1);
    asked.diff = diff;
    return asked;
}

Check check_of(const std::vector<std::string>& words) {
    Check check;
    Limits diff = usual_diff_limits();
    bool open = false; // the limits of --diff
    for (size_t i = 0; i < words.size(); ++i) {
        const Token token = parse_token(words[i], true);
        check.open |= words[i][0] == '{' || token.name.find('{') != std::string::npos;
        if (!token.is_command)
            continue;
        check.blocks |= token.name == "if" || token.name == "while" || token.name == "for";
        if (const auto limit = diff.find(token.name); limit != diff.end()) {
            const auto value = i + 1 < words.size() ? parse_number(words[i + 1]) : std::nullopt;
            open = open || !value;
            limit->second = double(float(value.value_or(0)));
        } else if (measures(token.name)) {
            check.asked[token.name].push_back(
                asked_of(token, diff, compares_values(token.name) && (open || check.blocks)));
        }
    }
    return check;
}

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

// Also of what a sum or a logarithm has rounded.
bool near(double a, double b) {
    return same(a, b) || std::abs(a - b) <= 1e-9 * std::max({1.0, std::abs(a), std::abs(b)});
}

std::optional<double> quantity(const Measurement& measured, const std::string& name) {
    const auto& all = measured.quantities;
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const auto& one) { return one.first == name; });
    return found == all.end() ? std::nullopt : std::optional<double>(found->second);
}

// ---- limits. What is wrong with a measurement as one of a word is a text, empty where nothing is.

std::string text_of(const std::string& key, const Limits& limits) {
    std::vector<std::string> words;
    for (const auto& [name, limit] : limits)
        words.push_back(format("{}={}", name, limit));
    return words.empty() ? "no " + key + "=" : key + "=" + join(words, ",");
}

std::string unlike_limits(const Measurement& measured, const Asked& asked) {
    Limits fail, warn;
    for (const Threshold& threshold : measured.thresholds) {
        if (threshold.fail)
            fail[threshold.quantity] = *threshold.fail;
        if (threshold.warn)
            warn[threshold.quantity] = *threshold.warn;
    }
    const auto compared = [](const std::string& key, const Limits& held, const Limits& wanted) {
        return held == wanted ? ""
                              : format(" was held to {}, but the check's limit is {}",
                                       text_of(key, held), text_of(key, wanted));
    };
    const std::string of_fail = compared("fail", fail, asked.fail);
    return of_fail.empty() ? compared("warn", warn, asked.warn) : of_fail;
}

// A comparison of values has one threshold: of the pixels that differ, of the largest difference,
// or of images that are not alike in more than their pixels.
std::string unlike_diff(const Measurement& measured, const Asked& asked) {
    if (measured.thresholds.size() != 1 ||
        measured.thresholds[0].fail.has_value() == measured.thresholds[0].warn.has_value())
        return " has not the one limit of a comparison of values";
    const Threshold& only = measured.thresholds[0];
    if (only.quantity == "differing-images") {
        return only.value == 1 && only.fail == 0.0 ? ""
                                                   : " has differing-images that do not differ";
    }
    const bool fails = only.fail.has_value();
    const std::string kind = fails ? "fail" : "warn";
    const double allowed = asked.diff.at(kind + "percent") / 100 * double(measured.pixels);
    const double limit = only.quantity == "max" ? asked.diff.at("hard" + kind) : allowed;
    if (only.quantity != "max" && only.quantity != "differing-pixels")
        return " has a limit of " + only.quantity + " (valid: differing-pixels, max)";
    const double held = fails ? *only.fail : *only.warn;
    return held == limit ? ""
                         : format(" was held to {} {}={}, but the check's limit is {}",
                                  only.quantity, kind, held, limit);
}

// Pixels differ where the largest difference is above what one may have.
std::string contradictory_diff(const Measurement& measured, const Asked& asked) {
    const Threshold& only = measured.thresholds.at(0);
    if (only.quantity == "differing-images")
        return "";
    const auto most = quantity(measured, "max");
    if (!most)
        return " has no max";
    const bool holds = only.value <= only.fail.value_or(HUGE_VAL); // it does not fail
    const bool passes = only.fail && holds;
    const auto beyond = [&](const std::string& kind) {
        const bool one = measured.command == "diff" && std::isfinite(*most) &&
                         asked.diff.at(kind + "percent") == 0 && *most > asked.diff.at(kind);
        return one || *most > asked.diff.at("hard" + kind);
    };
    if ((holds && beyond("fail")) || (passes && beyond("warn"))) {
        return format(" has a max of {}, which is above a limit of the check, but {} {} is not",
                      *most, only.quantity, only.value);
    }
    if (measured.command != "diff" || !std::isfinite(*most))
        return "";
    if (only.quantity == "differing-pixels" &&
        (only.value > 0) != (*most > asked.diff.at(only.fail ? "fail" : "warn"))) {
        return format(" has differing-pixels {}, which contradicts its max of {}", only.value,
                      *most);
    }
    for (const char* name : {"mean", "rms"}) {
        const auto value = quantity(measured, name);
        if (value && std::isfinite(*value) && (*value > 0) != (*most > 0))
            return format(" has a {} of {}, which contradicts its max of {}", name, *value, *most);
    }
    return "";
}

// ---- numbers that follow from each other

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
    const auto mean = quantity(measured, "mean"), least = quantity(measured, "min"),
               most = quantity(measured, "max");
    if (most && !std::isfinite(*most)) { // what is not finite has no rank, but it is in the mean
        return mean && std::isfinite(*mean)
                   ? format(" has a max of {}, but a mean of {}", *most, *mean)
                   : "";
    }
    std::string why = unordered(all);
    for (const char* name : {"weighted-q1", "weighted-median", "weighted-q3", "mean"}) {
        const auto value = quantity(measured, name);
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
    const auto mean = quantity(measured, "mean");
    const bool decibels = higher_is_better(measured.command, name);
    if (!mean || asked.open)
        return "";
    const double wanted = decibels ? 10 * std::log10(asked.peak * asked.peak / *mean) : *mean;
    return near(value, wanted)
               ? ""
               : format(" has {} {}, but its mean of {} gives {}", name, value, *mean, wanted);
}

// As TmqiScore (tonetool/numbers.h) says what Q is.
std::string contradictory_tmqi(const Measurement& measured) {
    const auto q = quantity(measured, "Q"), s = quantity(measured, "S"),
               n = quantity(measured, "N");
    if (!q || !s || !n)
        return "";
    const double wanted = 0.8012 * std::pow(*s, 0.3046) + 0.1988 * std::pow(*n, 0.7088);
    return near(*q, wanted) ? ""
                            : format(" has Q {}, but S {} and N {} give {}", *q, *s, *n, wanted);
}

// ---- one measurement

std::string bad_threshold(const Measurement& measured) {
    std::set<std::string> names;
    for (const Threshold& threshold : measured.thresholds) {
        const std::string& name = threshold.quantity;
        const auto value = quantity(measured, name);
        if (!names.insert(name).second)
            return " has two thresholds of " + name;
        if (value && !same(*value, threshold.value)) {
            return format(": the threshold is held against {} {}, but {} is {}", name,
                          threshold.value, name, *value);
        }
        if (!value && !compares_values(measured.command))
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

std::string problem(const Measurement& measured, const Asked& asked) {
    if (asked.limited && measured.thresholds.empty())
        return " has no threshold, though the check gives it a limit";
    std::string why = bad_threshold(measured);
    if (!why.empty())
        return why;
    if (compares_values(measured.command)) {
        why = asked.open ? "" : unlike_diff(measured, asked);
        return why.empty() && !asked.open ? contradictory_diff(measured, asked) : why;
    }
    why = asked.open ? "" : unlike_limits(measured, asked);
    if (why.empty() && measured.command == "errormap")
        why = contradictory_error(measured, asked);
    if (why.empty()) {
        why =
            measured.command == "tmqi" ? contradictory_tmqi(measured) : contradictory_map(measured);
    }
    return why;
}

void check_measurement(const FrameResult& frame, const Measurement& measured, const Check& check) {
    const auto found = check.asked.find(measured.command);
    if (found == check.asked.end()) {
        if (check.open)
            return;
        throw std::runtime_error(format("{} was measured by {}, which the check does not have",
                                        name_of(frame), measured.command));
    }
    std::string first;
    for (const Asked& asked : found->second) {
        const std::string why = problem(measured, asked);
        if (why.empty())
            return;
        first = first.empty() ? why : first;
    }
    throw std::runtime_error(name_of(frame) + ": " + measured.command + first);
}

// What a frame that nothing kept from being checked must have.
void check_whole(const FrameResult& frame, const Check& check) {
    if (check.open || check.blocks || frame.status > Status::Failed)
        return;
    for (const auto& [command, words] : check.asked) {
        const auto count = std::count_if(
            frame.measurements.begin(), frame.measurements.end(),
            [&name = command](const Measurement& one) { return one.command == name; });
        if (size_t(count) < words.size()) {
            throw std::runtime_error(format("{} has {} measurements by {}, but the check has {}",
                                            name_of(frame), count, command, words.size()));
        }
    }
}

} // namespace

void judge_from_numbers(FrameResult& frame) {
    const Status said = frame.status;
    judge(frame);
    const Status found = frame.status;
    if (found == said)
        return;
    if (found <= Status::Measured || found < said) {
        throw std::runtime_error(
            format("{} is called \"{}\", but its numbers and faults say \"{}\"", name_of(frame),
                   status_name(said), status_name(found)));
    }
    frame.warnings.push_back(format("it was called \"{}\", but its numbers and faults say \"{}\"",
                                    status_name(said), status_name(found)));
    judge(frame);
}

void check_limits(const ShotResult& shot) {
    const Check check = check_of(shot.check);
    for (const FrameResult& frame : shot.frames) {
        for (const Measurement& measured : frame.measurements)
            check_measurement(frame, measured, check);
        check_whole(frame, check);
    }
}

} // namespace tonetool::sequence
