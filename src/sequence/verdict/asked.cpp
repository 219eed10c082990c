// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/asked.h"

#include <algorithm>
#include <optional>

#include "sequence/against/against_rules.h"
#include "sequence/qc/qc_rules.h"
#include "text/text.h"
#include "text/token.h"
#include "tonetool/tonetool.h"

namespace tonetool::sequence {

namespace {

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

Limits limits_of(const MeasuringCommand& command, const Token& token, const std::string& key,
                 bool& open) {
    Limits limits;
    const std::string text = modifier(token, key), named = modifier(token, "quantity");
    for (const std::string& word : text.empty() ? Strings{} : split(text, ',')) {
        const size_t equals = word.find('=');
        const bool has_name = equals != std::string::npos;
        const auto limit = parse_number(has_name ? word.substr(equals + 1) : word);
        const std::string name = has_name        ? word.substr(0, equals)
                                 : named.empty() ? command.first_quantity(modifier(token, "metric"))
                                                 : named;
        open = open || !limit;
        limits[quantity_name(token, name)] = limit.value_or(0);
    }
    return limits;
}

// Each of so many frames is tested at a part of alpha.
void ask_verdict(const Token& token, Asked& asked) {
    const auto number = [&](const char* key, double otherwise) {
        const std::string text = modifier(token, key);
        const auto given = parse_number(text);
        asked.open = asked.open || (!given && !text.empty());
        return given.value_or(otherwise);
    };
    const std::string inconclusive = modifier(token, "inconclusive");
    const BiasTest usual;
    asked.limited = true;
    asked.verdict.fails = modifier(token, "fail") != "0";
    asked.verdict.inconclusive = inconclusive.empty() ? "fail" : inconclusive;
    asked.within = number("within", usual.within);
    const bool each = modifier(token, "frames") == "each";
    asked.alpha = number("alpha", usual.alpha) / (each ? 1 : number("frames", 1));
}

Asked asked_of(const MeasuringCommand& command, const Token& token, const DiffLimits& diff,
               bool open) {
    Asked asked;
    asked.open = open || token.text.find('{') != std::string::npos;
    if (command.scoring == Scoring::Verdict) {
        ask_verdict(token, asked);
        return asked;
    }
    asked.fail = limits_of(command, token, "fail", asked.open);
    asked.warn = limits_of(command, token, "warn", asked.open);
    asked.limited = command.compares_values() || !asked.fail.empty() || !asked.warn.empty();
    asked.metric = modifier(token, "metric");
    asked.peak = parse_number(modifier(token, "peak")).value_or(1);
    asked.diff = diff;
    return asked;
}

const FaultRules* rules_of(const std::string& command) {
    return command == "qc" ? &qc_rules() : command == "against" ? &against_rules() : nullptr;
}

// The modifiers that are limits of faults.
std::map<std::string, std::string> fault_limits_of(const Token& token, const FaultRules& rules) {
    std::map<std::string, std::string> limits;
    for (const auto& [key, value] : token.modifiers)
        if (rank_of(rules, key) < rules.size())
            limits[key] = value;
    return limits;
}

// The limit of --diff that the word sets.
float* diff_limit(DiffLimits& limits, const std::string& name) {
    for (const DiffOption& option : kDiffOptions)
        if (name == option.name)
            return &((limits.*option.limit).*option.number);
    return nullptr;
}

} // namespace

Check check_of(const std::vector<std::string>& words) {
    Check check;
    DiffLimits diff;
    bool open = false; // the limits of --diff
    for (size_t i = 0; i < words.size(); ++i) {
        const Token token = parse_token(words[i], true);
        check.open |= words[i][0] == '{' || token.name.find('{') != std::string::npos;
        if (!token.is_command)
            continue;
        check.blocks |= token.name == "if" || token.name == "while" || token.name == "for";
        if (const FaultRules* rules = rules_of(token.name))
            check.searches[token.name] = fault_limits_of(token, *rules);
        if (float* limit = diff_limit(diff, token.name)) {
            const auto value = i + 1 < words.size() ? parse_number(words[i + 1]) : std::nullopt;
            open = open || !value;
            *limit = float(value.value_or(0));
        } else if (const MeasuringCommand* command = measuring_command(token.name)) {
            const bool unknown = command->compares_values() && (open || check.blocks);
            check.asked[token.name].push_back(asked_of(*command, token, diff, unknown));
        }
    }
    return check;
}

} // namespace tonetool::sequence
