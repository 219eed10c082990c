// SPDX-License-Identifier: BSD-3-Clause
// fail= and warn= of commands that compare.
#include <algorithm>
#include <regex>
#include <stdexcept>

#include "chain/commands/flip_args.h"
#include "sequence/results/limits_file.h"
#include "sequence/results/measuring.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

class LimitReader {
public:
    LimitReader(Session& session, const Call& call, const Measures& measures, Strings& pooled)
        : m_session(session),
          m_call(call),
          m_measures(measures),
          m_pooled(pooled) {}

    Limits read() {
        (void)m_call.flag("print", true);
        const auto quantity = m_call.text("quantity");
        if (quantity && !m_call.has("fail") && !m_call.has("warn"))
            throw CommandError("quantity= needs fail= or warn=");
        m_default = quantity ? resolved(*quantity) : m_measures.names.front();
        if (m_call.has("above"))
            (void)resolved("above");
        read_list("fail", &Limit::fail);
        read_list("warn", &Limit::warn);
        if (quantity && !m_used_default) {
            throw CommandError("quantity= is of a limit without a name (valid: fail=X, or "
                               "fail=QUANTITY=X without quantity=)");
        }
        if (m_call.has("above") && m_used_default && !quantity) {
            throw CommandError("above= is not what the limit without a name is of, which is " +
                               m_default + " (valid: fail=above=X, or fail=" + m_default + "=X)");
        }
        return m_limits;
    }

private:
    using Member = std::optional<double> Limit::*;

    void read_list(const std::string& key, Member member) {
        if (!m_call.has(key))
            return;
        const std::string text = *m_call.text(key);
        if (!sequence::names_limits_file(text)) {
            refuse_decimal_comma(key, text);
            return read_numbers(key, text, member);
        }
        const std::string numbers = numbers_of(key, m_session.file(text));
        try {
            read_numbers(key, numbers, member);
        } catch (const CommandError& problem) { // a large error times 1.1
            throw CommandError(std::string(problem.what()) + "; it follows from what \"" + text +
                               "\" has measured: take another quantity, or a number");
        }
    }

    void read_numbers(const std::string& key, const std::string& text, Member member) {
        for (const std::string& word : split(text, ',')) {
            const size_t equals = word.find('=');
            const bool named = equals != std::string::npos;
            const bool automatic = word.substr(named ? equals + 1 : 0) == "auto" && key == "fail";
            if (!named && !automatic && !parse_number(word)) {
                throw CommandError(key + " \"" + word + "\" is not a number (valid: " + key +
                                   "=0.3, or QUANTITY=LIMIT as in " + key +
                                   "=p99.9=0.7, with a decimal point" +
                                   (key == "fail" ? ", or auto" : "") + ")");
            }
            m_used_default = m_used_default || !named;
            Limit& limit = limit_of(named ? resolved(word.substr(0, equals)) : m_default);
            if (limit.*member || (key == "fail" && limit.automatic)) {
                throw CommandError(key + "=" + *m_call.text(key) + " has two limits of " +
                                   limit.quantity + " (valid: one of each quantity)");
            }
            if (automatic)
                set_automatic(limit);
            else
                limit.*member = number(key, word.substr(named ? equals + 1 : 0), limit.quantity);
        }
    }

    // A comma separates limits, so "0,3" would be two.
    static void refuse_decimal_comma(const std::string& key, const std::string& text) {
        static const std::regex number("(^|[=,])([0-9]+),([0-9]+)(,|$)");
        std::smatch found;
        if (std::regex_search(text, found, number)) {
            throw CommandError(key + "=" + text + ": a comma separates limits (valid: a decimal " +
                               "point, as in " + found.str(2) + "." + found.str(3) +
                               ", or QUANTITY=LIMIT,QUANTITY=LIMIT)");
        }
    }

    void set_automatic(Limit& limit) const {
        if (!m_session.frame.loops) {
            throw CommandError(
                "fail=auto follows from the frames of a shot, and this line has none "
                "(valid: a number, a file, or frames with # in their names)");
        }
        if (sequence::higher_is_better(m_call.row().label(), limit.quantity)) {
            throw CommandError("fail=auto is of errors, and of " + limit.quantity +
                               " higher is better (valid: a number, or a file)");
        }
        limit.automatic = true;
    }

    // What the file of --noisefloor, or of a check, has, if it is of a command like this one.
    std::string numbers_of(const std::string& key, const std::string& file) {
        sequence::KeptLimits kept;
        try {
            kept = sequence::read_limits(file, m_call.row().label(), m_default);
        } catch (const std::runtime_error& problem) {
            throw CommandError(key + ": " + problem.what());
        }
        const std::string label = m_call.row().label(), of = "the limits of \"" + file + "\" are ";
        if (kept.command != label)
            throw CommandError(of + "for --" + kept.command + ", not for --" + label);
        for (const Modifier& one : m_call.row().modifiers) {
            const auto given = m_call.text(one.key);
            const auto measured =
                std::find_if(kept.modifiers.begin(), kept.modifiers.end(),
                             [&](const auto& modifier) { return modifier.first == one.key; });
            const bool had = measured != kept.modifiers.end();
            // The exposures of a shot are the same however they were found.
            const bool shot = one.key == "exposures" && given && had && *given != "frame" &&
                              measured->second != "frame";
            if (measures(one.key) && !shot &&
                (given.has_value() != had || (had && measured->second != *given))) {
                throw CommandError(
                    of + "of a comparison with " +
                    (had ? one.key + "=" + measured->second : "no " + one.key + "=") +
                    ", this one has " + (given ? one.key + "=" + *given : "none"));
            }
        }
        m_used_default |= kept.limits.size() == 1 && kept.limits.front().quantity == m_default;
        return sequence::limits_text(kept);
    }

    // The others say what becomes of the numbers.
    static bool measures(const std::string& key) {
        static const Strings others = {"fail",  "warn",        "quantity",      "print",   "above",
                                       "tests", "exposuremap", "saveexposures", "colormap"};
        return std::find(others.begin(), others.end(), key) == others.end();
    }

    // 30 dB as a limit of squared errors would pass everything.
    void refuse_decibels(const std::string& key, const std::string& text,
                         const std::string& quantity, double limit) const {
        const std::string& own = m_measures.names.front();
        const auto up = [&](const std::string& name) {
            return sequence::higher_is_better(m_call.row().label(), name);
        };
        if (up(own) && !up(quantity) && limit >= 1) {
            throw CommandError(key + "=" + quantity + "=" + text + ": " + quantity +
                               " is of the errors in the map, and the number in dB is " + own +
                               " (valid: " + key + "=" + own + "=" + text + ", or " + quantity +
                               " below 1)");
        }
    }

    double number(const std::string& key, const std::string& text,
                  const std::string& quantity) const {
        const Scale scale = scale_of(quantity);
        const double limit = checked_number(key, text, {scale.low, scale.high});
        const bool up = sequence::higher_is_better(m_call.row().label(), quantity);
        refuse_decibels(key, text, quantity, limit);
        const double idle = up ? scale.low : scale.high;
        if (limit == idle) {
            throw CommandError(
                key + "=" + text + " can never " + key + ": " + quantity + " is " +
                (up ? "never below " : "never above ") + format_number(idle) + " (valid: " +
                (up ? "above " + format_number(scale.low) + " to " + format_number(scale.high)
                    : format_number(scale.low) + " to below " + format_number(scale.high)) +
                ")");
        }
        return limit;
    }

    Scale scale_of(const std::string& quantity) const {
        return quantity.compare(0, m_above.size(), m_above) == 0 ? Scale()
                                                                 : m_measures.scale(quantity);
    }

    // Of above=E, or of a quantity above0.2: an error that some pixel can be above.
    void check_error_above(const std::string& text, double error) const {
        const Scale scale = m_measures.scale("max");
        if (error >= scale.high) {
            throw CommandError(m_above + "=" + text + ": no error is above it (valid: 0 to below " +
                               format_number(scale.high) + ")");
        }
    }

    // The name that the summary has for it.
    std::string resolved(const std::string& name) {
        const auto& names = m_measures.names;
        if (std::find(names.begin(), names.end(), name) != names.end())
            return name;
        const auto known = !m_measures.map   ? std::nullopt
                           : name == m_above ? std::optional<std::string>(m_above + error_above())
                                             : ToneAlgo::flip_quantity_name(name);
        if (!known) {
            throw CommandError("unknown quantity \"" + name + "\"" + meant(name, m_measures.names) +
                               " (valid: " + join(listed(), ", ") + ")");
        }
        if (known->compare(0, m_above.size(), m_above) == 0) {
            const std::string error = known->substr(m_above.size());
            check_error_above(error, parse_number(error).value());
        }
        m_pooled.push_back(*known);
        return *known;
    }

    Strings listed() const {
        Strings names = m_measures.names;
        if (m_measures.map)
            names.insert(names.end(), {"pNN", "above"});
        return names;
    }

    // The number of above=E as the name of the quantity has it.
    std::string error_above() const {
        const auto text = m_call.text("above");
        if (!text) {
            throw CommandError("the quantity above needs above=E, the error (valid: "
                               "above=0.2:fail=above=0.01, or fail=above0.2=0.01)");
        }
        const Scale scale = m_measures.scale("max");
        const double error = checked_number("above", *text, {0, scale.high});
        check_error_above(*text, error);
        return ToneAlgo::flip_quantity_name(m_above + format_apart(error, 0))
            .value()
            .substr(m_above.size());
    }

    Limit& limit_of(const std::string& quantity) {
        for (Limit& limit : m_limits)
            if (limit.quantity == quantity)
                return limit;
        m_limits.push_back({quantity, {}, {}});
        return m_limits.back();
    }

    const std::string m_above = "above";
    Session& m_session;
    const Call& m_call;
    const Measures& m_measures;
    Strings& m_pooled;
    std::string m_default;
    bool m_used_default = false;
    Limits m_limits;
};

} // namespace

Limits limits_of(Session& session, const Call& call, const Measures& measures, Strings& pooled) {
    return LimitReader(session, call, measures, pooled).read();
}

} // namespace tonetool::chain
