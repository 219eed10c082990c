// What is said about the whole command line.
#include <algorithm>

#include "chain/language/registry.h"
#include "runs/frames.h"
#include "text/token.h"

namespace tonetool::runs {

std::string full_command_line(const Strings& words, bool compat) {
    static const Strings attributes = {"attrib", "sattrib"};
    const auto is_in = [](const Strings& names, const std::string& name) {
        return std::find(names.begin(), names.end(), name) != names.end();
    };
    const bool sans = is_in(words, "--sansattrib") || is_in(words, "-sansattrib");
    std::string line = "tonetool";
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const std::string name = parse_token(word, true).name;
        if (sans && (name == "sansattrib" || is_in(attributes, name))) {
            i += name == "sansattrib" ? 0 : 2;
            continue;
        }
        bool quoted = word.find_first_of(" \t\n") != std::string::npos;
        line += " " + (!compat ? shell_quoted(word) : (quoted ? '"' + word + '"' : word));
    }
    return line;
}

std::vector<LeadWord> lead_words(const Strings& words) {
    std::vector<LeadWord> found;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        LeadWord lead{i, word.size() > 1 && word[0] == '-'};
        const Token token = parse_token(lead.is_command ? word : "", true);
        lead.row = lead.is_command ? chain::find_command(token.name) : nullptr;
        for (size_t a = token.value.size(); lead.row && a < lead.row->args.size(); ++a) {
            const std::string& argument = lead.row->args[a];
            if (argument.front() == '=' || i + 1 >= words.size() ||
                chain::is_left_out(argument, words, i + 1))
                break;
            lead.arguments.push_back(++i);
        }
        found.push_back(std::move(lead));
    }
    return found;
}

std::vector<bool> commands_among(const Strings& words) {
    std::vector<bool> found(words.size());
    for (const LeadWord& lead : lead_words(words))
        found[lead.at] = lead.is_command;
    return found;
}

Strings with_values_apart(const Strings& words) {
    static const Strings names = {"frames", "views", "framepadding", "parallel-frames", "jobs"};
    const std::vector<bool> commands = commands_among(words);
    Strings apart;
    for (size_t i = 0; i < words.size(); ++i) {
        const std::string& word = words[i];
        const size_t equals = word.find('=');
        const Token token = parse_token(commands[i] ? word : "", true);
        const chain::Command* row = commands[i] ? chain::find_command(token.name) : nullptr;
        const bool takes =
            row && (row->group == chain::Group::Check ||
                    std::find(names.begin(), names.end(), token.name) != names.end());
        if (takes && !row->args.empty() && equals < word.find(':')) {
            apart.push_back(word.substr(0, equals));
            apart.push_back(word.substr(equals + 1));
        } else {
            apart.push_back(word);
        }
    }
    return apart;
}

bool is_compat(const Strings& words) {
    const std::vector<bool> command = commands_among(words);
    for (size_t i = 0; i < words.size(); ++i)
        if (command[i] && (words[i] == "--compat" || words[i] == "-compat"))
            return true;
    return false;
}

} // namespace tonetool::runs
