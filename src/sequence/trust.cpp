#include "sequence/trust.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>

#include "include/tonetool/flip.h"
#include "text/text.h"
#include "text/token.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

std::string name_of(const FrameResult& frame) {
    return "frame " + std::to_string(frame.frame) + (frame.view.empty() ? "" : " " + frame.view);
}

// The words of one command. A limit is asked for where each of them has one.
struct Asked {
    int words = 0, limited = 0;
    std::string fail; ///< of the only word

    bool always() const { return words > 0 && limited == words; }
};

std::map<std::string, Asked> asked_of(const std::vector<std::string>& check) {
    std::map<std::string, Asked> asked;
    for (const std::string& word : check) {
        const Token token = parse_token(word, true);
        if (!token.is_command) {
            continue;
        }
        Asked& one = asked[token.name];
        const auto has = [&](const std::string& key) {
            return std::find_if(token.modifiers.begin(), token.modifiers.end(),
                                [&](const auto& modifier) { return modifier.first == key; });
        };
        const auto fail = has("fail");
        const bool limited = fail != token.modifiers.end() || has("warn") != token.modifiers.end();
        one.limited += limited ? 1 : 0;
        one.fail = one.words == 0 && fail != token.modifiers.end() ? fail->second : "";
        ++one.words;
    }
    return asked;
}

bool same(double a, double b) {
    return a == b || (std::isnan(a) && std::isnan(b));
}

// Whether a threshold is that of "0.05", "p99.9=0.5" or "above=0.1", where above= says of what.
bool is_limit(const Threshold& threshold, const std::string& name, double limit) {
    const std::string known = ToneAlgo::flip_quantity_name(name).value_or(name);
    const bool of_it = name.empty() || threshold.quantity == known ||
                       (name == "above" && OIIO::Strutil::starts_with(threshold.quantity, name));
    return of_it && threshold.fail && *threshold.fail == limit;
}

// Each limit of fail=, which may have several with commas between them, was held.
void check_fail(const std::string& start, const Measurement& measured, const std::string& fail) {
    for (const std::string& word : split(fail, ',')) {
        const size_t equals = word.find('=');
        const bool named = equals != std::string::npos;
        const auto limit = parse_number(named ? word.substr(equals + 1) : word);
        if (!limit) {
            continue; // the value of an expression is not known here
        }
        const auto& all = measured.thresholds;
        if (std::any_of(all.begin(), all.end(), [&](const Threshold& threshold) {
                return is_limit(threshold, named ? word.substr(0, equals) : "", *limit);
            })) {
            continue;
        }
        const auto& held = all.front().fail;
        throw std::runtime_error(format("{} was held to {}, but the check's limit is fail={}",
                                        start, held ? format("fail={}", *held) : "no limit", fail));
    }
}

void check_thresholds(const FrameResult& frame, const Measurement& measured, const Asked& asked) {
    const std::string start = name_of(frame) + ": " + measured.command;
    if (measured.thresholds.empty()) {
        if (asked.always()) {
            throw std::runtime_error(start +
                                     " has no threshold, though the check gives it a limit");
        }
        return;
    }
    for (const Threshold& threshold : measured.thresholds) {
        for (const auto& [quantity, value] : measured.quantities) {
            if (quantity == threshold.quantity && !same(value, threshold.value)) {
                throw std::runtime_error(
                    format("{}: the threshold is held against {} {}, but {} is {}", start, quantity,
                           threshold.value, quantity, value));
            }
        }
    }
    if (asked.words == 1 && !asked.fail.empty()) {
        check_fail(start, measured, asked.fail);
    }
}

} // namespace

void judge_from_numbers(FrameResult& frame) {
    const Status said = frame.status;
    judge(frame);
    const Status found = frame.status;
    if (found == said) {
        return;
    }
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
    const std::map<std::string, Asked> asked = asked_of(shot.check);
    for (const FrameResult& frame : shot.frames) {
        for (const Measurement& measured : frame.measurements) {
            const auto found = asked.find(measured.command);
            check_thresholds(frame, measured, found == asked.end() ? Asked{} : found->second);
        }
    }
}

} // namespace tonetool::sequence
