// What is said about the whole command line.
#include <algorithm>

#include "chain/registry.h"
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

Strings with_values_apart(const Strings& words) {
    static const Strings names = {"frames", "views", "framepadding", "parallel-frames", "jobs"};
    Strings apart;
    size_t arguments = 0; // that the last command still takes
    for (const std::string& word : words) {
        const size_t equals = word.find('=');
        const bool dashed = arguments == 0 && word.size() > 1 && word[0] == '-';
        const Token token = parse_token(dashed ? word : "", true);
        const chain::Command* row = dashed ? chain::find_command(token.name) : nullptr;
        const bool takes =
            row && (row->group == chain::Group::Check ||
                    std::find(names.begin(), names.end(), token.name) != names.end());
        if (takes && !row->args.empty() && equals < word.find(':')) {
            apart.push_back(word.substr(0, equals));
            apart.push_back(word.substr(equals + 1));
            continue;
        }
        apart.push_back(word);
        const bool value_follows = row && !row->args.empty() && row->args.front()[0] != '=';
        arguments = value_follows   ? row->args.size() - token.value.size()
                    : arguments > 0 ? arguments - 1
                                    : 0;
    }
    return apart;
}

bool is_compat(const Strings& words) {
    return std::find(words.begin(), words.end(), "--compat") != words.end();
}

} // namespace tonetool::runs
