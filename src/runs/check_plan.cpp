// SPDX-License-Identifier: BSD-3-Clause
#include "runs/check_plan.h"

#include <algorithm>
#include <set>
#include <stdexcept>

#include "chain/language/values.h"
#include "chain/session/call.h"
#include "sequence/results/limits_file.h"
#include "sequence/results/measuring.h"
#include "text/error.h"
#include "text/token.h"
#include "tonetool/tonetool.h"

namespace tonetool::runs {

namespace {

using chain::Command;
using chain::Group;
using chain::Word;

class Walk {
public:
    explicit Walk(const chain::ParsedLine& line) : m_line(line) {}

    CheckPlan plan() {
        for (const Word& word : m_line.words)
            if (word.row)
                take_command(word);
            else
                take_file(word.at);
        if (!m_plan.part_lists.empty())
            m_plan.words.emplace("merge", "");
        check_merge();
        check_exit_zero();
        return std::move(m_plan);
    }

private:
    const std::string& text(size_t at) const { return m_line.texts[at]; }

    void keep(size_t at, const std::string& text) {
        m_plan.essence.push_back(text);
        m_plan.essence_at.push_back(at);
    }

    void take_command(const Word& word) {
        const bool check = word.row->group == Group::Check;
        const bool manner = check || word.row->manner || word.is("n");
        note_blocks(word.row->names.front());
        m_plan.dry_run |= word.is("n");
        m_plan.only_validates |= word.is("dry-run");
        note_what_is_judged(word);
        note_shot(word);
        if (!manner)
            keep(word.at, with_numbers(word.row->names.front(), with_shot_exposures(word.token)));
        // What these look for is part of what comes of the line.
        if (check || word.is("qc") || word.is("against"))
            take_check(word);
        for (const size_t argument : word.arguments)
            take_argument(word, manner, argument);
    }

    void note_blocks(const std::string& name) {
        const bool begins = name == "if" || name == "while" || name == "for";
        const bool ends = name == "endif" || name == "endwhile" || name == "endfor";
        m_depth += begins ? 1 : ends && m_depth > 0 ? -1 : 0;
    }

    // oiiotool's own commands are as lenient as it is with --compat.
    void note_what_is_judged(const Word& word) {
        const Command& row = *word.row;
        if (m_line.compat && !row.own)
            return;
        m_plan.compares |= row.group == Group::Compare && row.pops > 0;
        m_plan.has_limits |= row.always_judges;
        for (const auto& [key, value] : word.token.modifiers) {
            m_plan.has_limits |= key == "fail" || key == "warn";
            if (row.writes_to(key) && m_depth == 0)
                m_plan.always_written.push_back(word.at);
        }
    }

    // What is wrong with its modifiers is told when it runs; expressions have a value then.
    void note_shot(const Word& word) {
        if (!word.row->shot_need)
            return;
        Token token = word.token;
        auto& all = token.modifiers;
        all.erase(std::remove_if(
                      all.begin(), all.end(),
                      [](const auto& one) { return one.second.find('{') != std::string::npos; }),
                  all.end());
        try {
            const chain::ShotNeed need =
                word.row->shot_need(chain::Call(*word.row, std::move(token), {}));
            if (!need.mode.empty())
                m_plan.shots.push_back({word.at, need});
            else if (!need.lack.empty())
                m_shot_lack = "\"" + text(word.at) + "\": " + need.lack;
        } catch (const CommandError&) {
        }
    }

    void take_check(const Word& word) {
        const std::string name = "--" + word.row->names.front();
        const std::string argument = word.arguments.empty() ? "" : text(word.arguments.front());
        if (!word.missing.empty())
            throw CommandError(name + ": missing argument " + word.missing);
        if (!word.arguments.empty() && argument.empty()) {
            const std::string& what = word.argument_name(0);
            throw CommandError(name + ": " + what + " is empty (valid: a name, " + name + " " +
                               what + ")");
        }
        if (word.is("merge-list"))
            m_plan.part_lists.push_back(argument);
        else if (word.is("only"))
            m_plan.only.push_back(argument);
        else if (!word.is("dry-run") &&
                 !m_plan.words.emplace(word.row->names.front(), argument).second)
            throw CommandError(name + " is given twice");
        if (word.is("report") || word.is("pictures"))
            take_picture_limits(word, name);
        else if (word.is("table"))
            take_table(word, name, argument);
        else if (word.is("figure"))
            take_figure(word, name);
        else if (!word.is("qc") && !word.is("against")) // whose own are read when they run
            take_modifiers(name, word);
    }

    void take_table(const Word& word, const std::string& name, const std::string& file) {
        if (!file.empty())
            (void)sequence::table_format(file);
        sequence::MethodTableOptions& table = m_plan.table;
        for (const auto& [key, value] : word.token.modifiers) {
            if (key == "quantity")
                table.quantities = split(value, ',');
            else if (key == "methods")
                table.methods = split(value, ',');
            else if (key == "digits")
                table.digits = checked_integer(name + ": " + key, value, {0, 17});
            else
                throw CommandError(name + " has no modifier \"" + key +
                                   "\" (valid: quantity, digits, methods)");
        }
    }

    void take_figure(const Word& word, const std::string& name) {
        sequence::FigureOptions& figure = m_plan.figure;
        for (const auto& [key, value] : word.token.modifiers) {
            if (key == "names")
                figure.names = split(value, ',');
            else if (key == "methods")
                figure.methods = split(value, ',');
            else if (key == "inset")
                take_insets(name, value);
            else if (key == "scale")
                figure.scale = checked_integer(name + ": " + key, value, {1, 64});
            else if (key == "stops")
                figure.stops = checked_number(name + ": " + key, value, {-100, 100});
            else if (key == "text")
                figure.text = checked_integer(name + ": " + key, value, {8, 200});
            else if (key == "background") {
                check_choice(name + ": " + key, value, {"white", "dark"});
                figure.dark = value == "dark";
            } else
                throw CommandError(
                    name + " has no modifier \"" + key +
                    "\" (valid: names, methods, inset, scale, stops, text, background)");
        }
    }

    void take_insets(const std::string& name, const std::string& value) {
        for (const std::string& text : split(value, ',')) {
            const auto inset = sequence::parse_inset(text);
            if (!inset) {
                throw CommandError(name + ": inset is \"" + text +
                                   "\" (valid: WIDTHxHEIGHT+X+Y, as 96x64+120+40)");
            }
            m_plan.figure.insets.push_back(*inset);
        }
    }

    void take_modifiers(const std::string& name, const Word& word) {
        for (const auto& [key, value] : word.token.modifiers) {
            const auto& all = word.row->modifiers;
            const auto known = std::find_if(
                all.begin(), all.end(), [&key = key](const auto& one) { return one.key == key; });
            if (known == all.end()) {
                Strings keys;
                for (const chain::Modifier& one : all)
                    keys.push_back(one.key);
                throw CommandError(name + " has no modifier \"" + key + "\"" +
                                   (keys.empty() ? "" : " (valid: " + join(keys, ", ") + ")"));
            }
            check_choice(name + ": " + key, value, split(known->hint, '|'));
            if (key == "from" && value == "warning")
                m_plan.bad_from = sequence::Status::Warning;
            m_plan.json_records &= key != "records" || value != "0";
        }
    }

    void take_picture_limits(const Word& word, const std::string& name) {
        for (const auto& [key, value] : word.token.modifiers) {
            const bool size = key == "size" && word.is("report");
            if (key != "pixels" && !size) {
                throw CommandError(name + " has no modifier \"" + key + "\" (valid: pixels" +
                                   (word.is("report") ? ", size)" : ")"));
            }
            const int number = checked_integer(name + ": " + key, value, {1, size ? 2000.0 : 24.0});
            if (size)
                m_plan.page.bytes = size_t(number) << 20;
            else
                m_plan.pictures.exact = size_t(number);
        }
    }

    void take_argument(const Word& word, bool manner, size_t at) {
        if (word.is("frames"))
            for (int frame : sequence::parse_frames(text(at), m_line.compat))
                m_plan.expected.push_back({frame, ""});
        if (manner)
            return;
        if (word.row->group == Group::Write && word.row->names.front()[0] == 'o') {
            m_plan.outputs.push_back(at);
            if (m_depth == 0 && !m_line.compat)
                m_plan.always_written.push_back(at);
        } else if (word.is("i")) {
            m_plan.inputs.push_back(at);
        } else if (word.is("label")) {
            m_labels.insert(text(at));
        }
        keep(at, sequence::without_range(text(at)));
    }

    void take_file(size_t at) {
        const bool part = m_plan.has("merge") || !m_plan.part_lists.empty();
        if (part) { // parts are names, whatever signs are in them
            m_plan.inputs.push_back(at);
            keep(at, text(at));
            return;
        }
        if (m_labels.count(text(at)) == 0 && text(at).find('{') == std::string::npos)
            m_plan.inputs.push_back(at);
        keep(at, sequence::without_range(text(at)));
    }

    // The range of a shot is the same whether it was measured now or is read from a file.
    std::string with_shot_exposures(const Token& token) {
        std::string value;
        for (const auto& [key, given] : token.modifiers)
            value = key == "exposures" && given != "frame" ? given : value;
        if (value.empty())
            return token.text;
        if (!m_plan.exposures.empty() && m_plan.exposures != value) {
            throw CommandError("exposures=" + m_plan.exposures + " and exposures=" + value +
                               " exclude each other (valid: one range on a command line)");
        }
        m_shot_commands += value == "shot" ? 1 : 0;
        if (m_shot_commands > 1) {
            throw CommandError("exposures=shot is there twice (valid: one on a command line; "
                               "exposures=FILE for more)");
        }
        m_plan.exposures = value;
        return token.with_value("exposures", "shot");
    }

    // Limits are what a file of them says, so that results can be held to them. What cannot be read
    // is told when the command runs.
    std::string with_numbers(const std::string& command, const std::string& text) {
        Token token = parse_token(text, true);
        for (const char* key : {"fail", "warn"})
            for (const auto& [name, value] : Token(token).modifiers)
                if (name == key && sequence::measuring_command(command) &&
                    sequence::names_limits_file(value))
                    token = parse_token(
                        token.with_value(key, numbers_in(value, command, quantity_of(token))),
                        true);
        return token.text;
    }

    // Of a limit without a name.
    static std::string quantity_of(const Token& token) {
        const auto text = [&](const std::string& key) {
            const auto& all = token.modifiers;
            const auto found = std::find_if(all.begin(), all.end(),
                                            [&](const auto& one) { return one.first == key; });
            return found == all.end() ? std::string() : found->second;
        };
        const std::string named = text("quantity");
        return named.empty()
                   ? sequence::measuring_command(token.name)->first_quantity(text("metric"))
                   : ToneAlgo::flip_quantity_name(named).value_or(named);
    }

    static std::string numbers_in(const std::string& file, const std::string& command,
                                  const std::string& quantity) {
        try {
            return sequence::limits_text(sequence::read_limits(file, command, quantity));
        } catch (const std::runtime_error&) {
            return file;
        }
    }

    // Else nothing would say what was found.
    void check_exit_zero() const {
        if (m_plan.has("exit-zero") && (!m_plan.has("json") || m_plan.has("merge"))) {
            throw CommandError("--exit-zero is for the tasks of a farm, whose results are judged "
                               "when they are merged (valid: with --json FILE, without --merge)");
        }
    }

    void check_merge() const {
        if (m_plan.has("merge") && m_plan.has("state"))
            throw CommandError("--merge and --state exclude each other");
        if (m_plan.has("merge") && !m_plan.only.empty())
            throw CommandError(
                "--only chooses what is compared, and --merge takes all cases of its "
                "parts (valid: --only where the parts are made)");
        if (m_plan.has("merge") && m_plan.has("figure")) {
            throw CommandError(
                "--figure is drawn of images, which results do not have (valid: with "
                "the comparison, without --merge)");
        }
        if (!m_plan.has("statistics") || m_plan.has("merge") || m_plan.exposures == "shot")
            return;
        if (m_plan.shots.empty() && !m_shot_lack.empty())
            throw CommandError("--statistics: " + m_shot_lack);
        if (m_plan.shots.empty()) {
            throw CommandError("--statistics measures what exposures=shot and adapt=shot need: no "
                               "command has it (valid: --hdrflip:exposures=shot; --cgtmo, or "
                               "--tonemap and --calibrate with a method or a white that measures)");
        }
        if (m_plan.shots.size() > 1) {
            throw CommandError("--statistics: \"" + text(m_plan.shots[0].at) + "\" and \"" +
                               text(m_plan.shots[1].at) +
                               "\" both measure a shot (valid: one of them, adapt=frame or "
                               "adapt=FILE of the other)");
        }
    }

    const chain::ParsedLine& m_line;
    CheckPlan m_plan;
    std::set<std::string> m_labels;
    int m_shot_commands = 0;
    std::string m_shot_lack; ///< of a command that would measure what a shot's statistics lack
    int m_depth = 0;         ///< of --if, --while and --for
};

} // namespace

std::map<std::string, std::string> CheckPlan::written() const {
    std::map<std::string, std::string> files;
    for (const auto& [command, file] : written_places())
        if (!dry_run || file == "-")
            files.emplace(command, file);
    return files;
}

std::map<std::string, std::string> CheckPlan::written_places() const {
    std::map<std::string, std::string> places = words;
    for (const char* read : {"accept", "suite", "key"})
        places.erase(read);
    return places;
}

bool CheckPlan::is_input(size_t at) const {
    return std::find(inputs.begin(), inputs.end(), at) != inputs.end();
}

CheckPlan plan_check(const chain::ParsedLine& line) {
    return Walk(line).plan();
}

} // namespace tonetool::runs
