// What is said about the whole command line.
#include <algorithm>

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

bool is_compat(const Strings& words) {
    return std::find(words.begin(), words.end(), "--compat") != words.end();
}

} // namespace tonetool::runs
