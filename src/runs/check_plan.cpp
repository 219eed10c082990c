#include "runs/check_plan.h"

#include <algorithm>
#include <set>

#include "chain/language/registry.h"
#include "runs/frames.h"
#include "text/error.h"
#include "text/token.h"

namespace tonetool::runs {

namespace {

using chain::Command;
using chain::find_command;
using chain::Group;

class Walk {
public:
    Walk(const Strings& words, bool compat) : m_words(words), m_compat(compat) {}

    CheckPlan plan() {
        for (const LeadWord& lead : lead_words(m_words))
            if (lead.row)
                take_command(lead);
            else
                take_file(lead.at);
        check_merge();
        return std::move(m_plan);
    }

private:
    void keep(size_t at, const std::string& word) {
        m_plan.essence.push_back(word);
        m_plan.essence_at.push_back(at);
    }

    void take_command(const LeadWord& lead) {
        const Command& row = *lead.row;
        const size_t at = lead.at;
        const std::string& name = row.names.front();
        const bool check = row.group == Group::Check;
        const bool manner = check || row.manner || name == "n";
        note_blocks(name);
        m_plan.dry_run |= name == "n";
        note_what_is_judged(row, at);
        if (!manner)
            keep(at, with_shot_exposures(m_words[at]));
        // What --qc looks for is part of what comes of the line.
        if (check || name == "qc")
            take_check(lead);
        for (const size_t argument : lead.arguments)
            take_argument(row, manner, argument);
    }

    void note_blocks(const std::string& name) {
        const bool begins = name == "if" || name == "while" || name == "for";
        const bool ends = name == "endif" || name == "endwhile" || name == "endfor";
        m_depth += begins ? 1 : ends && m_depth > 0 ? -1 : 0;
    }

    // oiiotool's own commands are as lenient as it is with --compat.
    void note_what_is_judged(const Command& row, size_t at) {
        if (m_compat && !row.own)
            return;
        const std::string& name = row.names.front();
        m_plan.compares |= row.group == Group::Compare && row.pops > 0;
        m_plan.has_limits |= name == "diff" || name == "pdiff";
        for (const auto& [key, text] : parse_token(m_words[at], true).modifiers) {
            m_plan.has_limits |= key == "fail" || key == "warn";
            for (const chain::Modifier& modifier : row.modifiers)
                if (modifier.key == key && modifier.writes() && m_depth == 0)
                    m_plan.always_written.push_back(at);
        }
    }

    static bool is_known_command(const std::string& word) {
        return word.size() > 1 && word[0] == '-' && find_command(parse_token(word, true).name);
    }

    void take_check(const LeadWord& lead) {
        const Strings& arguments = lead.row->args;
        const std::string& name = lead.row->names.front();
        const std::string argument = lead.arguments.empty() ? "" : m_words[lead.arguments.front()];
        if (!arguments.empty() && (lead.arguments.empty() || is_known_command(argument)))
            throw CommandError("--" + name + ": missing argument " + arguments.front());
        if (!arguments.empty() && argument.empty()) {
            throw CommandError("--" + name + ": " + arguments.front() +
                               " is empty (valid: a name, --" + name + " " + arguments.front() +
                               ")");
        }
        if (!m_plan.words.emplace(name, argument).second)
            throw CommandError("--" + name + " is given twice");
    }

    void take_argument(const Command& row, bool manner, size_t at) {
        const std::string& name = row.names.front();
        if (name == "frames")
            for (int frame : sequence::parse_frames(m_words[at], m_compat))
                m_plan.expected.push_back({frame, ""});
        if (manner)
            return;
        if (row.group == Group::Write && name[0] == 'o') {
            m_plan.outputs.push_back(at);
            if (m_depth == 0 && !m_compat)
                m_plan.always_written.push_back(at);
        } else if (name == "i") {
            m_plan.inputs.push_back(at);
        } else if (name == "label") {
            m_labels.insert(m_words[at]);
        }
        keep(at, sequence::without_range(m_words[at]));
    }

    void take_file(size_t at) {
        const std::string& word = m_words[at];
        if (m_plan.has("merge")) { // parts are names, whatever signs are in them
            m_plan.inputs.push_back(at);
            keep(at, word);
            return;
        }
        if (m_labels.count(word) == 0 && word.find('{') == std::string::npos)
            m_plan.inputs.push_back(at);
        keep(at, sequence::without_range(word));
    }

    // The range of a shot is the same whether it was measured now or is read from a file.
    std::string with_shot_exposures(const std::string& word) {
        std::string value;
        for (const auto& [key, text] : parse_token(word, true).modifiers)
            value = key == "exposures" && text != "frame" ? text : value;
        if (value.empty())
            return word;
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
        const size_t begin = word.find(":exposures=") + 11;
        const bool quoted = word[begin] == '\'' || word[begin] == '"';
        const size_t end = quoted ? word.find(word[begin], begin + 1) + 1 : word.find(':', begin);
        return word.substr(0, begin) + "shot" + (end < word.size() ? word.substr(end) : "");
    }

    void check_merge() const {
        if (m_plan.has("merge") && m_plan.has("state"))
            throw CommandError("--merge and --state exclude each other");
        if (m_plan.has("statistics") && !m_plan.has("merge") && m_plan.exposures != "shot") {
            throw CommandError("--statistics measures what exposures=shot needs: no command has it "
                               "(valid: --hdrflip:exposures=shot)");
        }
    }

    const Strings& m_words;
    CheckPlan m_plan;
    std::set<std::string> m_labels;
    bool m_compat;
    int m_shot_commands = 0;
    int m_depth = 0; ///< of --if, --while and --for
};

} // namespace

std::map<std::string, std::string> CheckPlan::written() const {
    std::map<std::string, std::string> files;
    for (const auto& [command, file] : words)
        if (!dry_run || file == "-")
            files.emplace(command, file);
    return files;
}

bool CheckPlan::is_input(size_t at) const {
    return std::find(inputs.begin(), inputs.end(), at) != inputs.end();
}

CheckPlan plan_check(const Strings& words, bool compat) {
    return Walk(words, compat).plan();
}

} // namespace tonetool::runs
