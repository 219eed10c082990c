// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/recipe.h"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <set>

#include "imagebuf/pixels/names.h"

namespace tonetool::recipe {

namespace {

bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

bool is_name(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

// The first line is the magic alone.
bool begins_as_recipe(const std::string& text) {
    const size_t end = std::strlen(kMagic);
    const size_t next = text.find_first_not_of(" \t\r", end);
    return text.compare(0, end, kMagic) == 0 && (next == std::string::npos || text[next] == '\n');
}

class Parser {
public:
    Parser(const std::string& text, const Parameters& given) : m_text(text), m_values(given) {}

    Strings words() {
        m_at = std::min(m_text.find('\n'), m_text.size());
        while (skip_space())
            if (!take_default())
                m_words.push_back(word());
        check_given();
        return std::move(m_words);
    }

private:
    bool more() const { return m_at < m_text.size(); }

    [[noreturn]] void fail(const std::string& why) const {
        auto line = 1 + std::count(m_text.begin(), m_text.begin() + std::ptrdiff_t(m_at), '\n');
        throw RecipeError("line " + std::to_string(line) + ": " + why);
    }

    // To the next word; false at the end.
    bool skip_space() {
        for (; more(); ++m_at) {
            m_line_begins |= m_text[m_at] == '\n';
            if (m_text[m_at] == '#')
                m_at = std::min(m_text.find('\n', m_at), m_text.size()) - 1;
            else if (m_text.compare(m_at, 2, "\\\n") == 0)
                ++m_at;
            else if (!is_space(m_text[m_at]))
                return true;
        }
        return false;
    }

    std::string name(size_t& at) const {
        const size_t begin = at;
        while (at < m_text.size() && is_name(m_text[at]))
            ++at;
        return m_text.substr(begin, at - begin);
    }

    // "$name = value" to the end of the line; false for anything else.
    bool take_default() {
        const bool first = m_line_begins;
        m_line_begins = false;
        size_t at = m_at + 1;
        if (!first || m_text[m_at] != '$')
            return false;
        const std::string parameter = name(at);
        at = std::min(m_text.find_first_not_of(" \t", at), m_text.size());
        if (parameter.empty() || at == m_text.size() || m_text[at] != '=')
            return false;
        m_at = std::min(m_text.find_first_not_of(" \t", at + 1), m_text.size());
        const bool empty = !more() || is_space(m_text[m_at]) || m_text[m_at] == '#';
        const std::string value = empty ? "" : word();
        m_known.insert(parameter);
        m_values.emplace(parameter, value);
        if (skip_space() && !m_line_begins)
            fail("one value after \"$" + parameter + " =\" (valid: $name = \"a value\")");
        return true;
    }

    std::string word() {
        std::string out;
        for (char quote = '\0'; more() && (quote || !is_space(m_text[m_at]));) {
            const char c = m_text[m_at];
            if (c == quote || (!quote && (c == '\'' || c == '"'))) {
                quote = quote ? '\0' : c;
                ++m_at;
            } else if (c == '\\' && quote != '\'') {
                out += escaped();
            } else if (c == '$' && quote != '\'') {
                out += value();
            } else {
                out += c;
                ++m_at;
            }
            if (quote && !more())
                fail(std::string("unfinished quotation, no closing ") + quote);
            if (m_made + out.size() > most_made) {
                fail("with the values of its parameters it is longer than 16 MB, the most that "
                     "the words of a recipe may be");
            }
        }
        m_made += out.size();
        return out;
    }

    std::string escaped() {
        if (m_at + 1 == m_text.size())
            fail("nothing after the backslash");
        const char c = m_text[m_at + 1];
        m_at += 2;
        return c == '\n' ? "" : std::string(1, c);
    }

    // Of the parameter here.
    std::string value() {
        size_t at = m_at + 1;
        if (m_text.compare(at, 1, "$") == 0) {
            m_at += 2;
            return "$";
        }
        const bool braces = m_text.compare(at, 1, "{") == 0;
        at += braces ? 1 : 0;
        const std::string parameter = name(at);
        if (parameter.empty() || (braces && m_text.compare(at, 1, "}") != 0))
            fail("no name of a parameter after $ (valid: $name, ${name}, $$ for a dollar)");
        const auto found = m_values.find(parameter);
        if (found == m_values.end()) {
            fail("parameter \"" + parameter + "\" has no value (valid: FILE.tone?" + parameter +
                 "=VALUE, or a line \"$" + parameter + " = VALUE\" before)");
        }
        m_known.insert(parameter);
        m_at = at + (braces ? 1 : 0);
        return found->second;
    }

    // A parameter that nothing uses is a misspelt one.
    void check_given() const {
        for (const auto& [parameter, unused] : m_values) {
            if (m_known.count(parameter) == 0) {
                const Strings known(m_known.begin(), m_known.end());
                const Strings near = nearest_names(parameter, known, 1);
                throw RecipeError(
                    "no parameter \"" + parameter + "\"" +
                    (near.empty() ? "" : ", did you mean \"" + near.front() + "\"?") +
                    (known.empty() ? " (it has none)" : " (valid: " + join(known, ", ") + ")"));
            }
        }
    }

    // Parameters that hold parameters grow without an end.
    static constexpr size_t most_made = 16 << 20;

    const std::string& m_text;
    Parameters m_values;
    std::set<std::string> m_known;
    Strings m_words;
    size_t m_at = 0;
    size_t m_made = 0; ///< bytes of all words and values up to here
    bool m_line_begins = false;
};

} // namespace

bool has_magic(const std::string& filename) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(filename, ignored))
        return false;
    std::ifstream file(filename, std::ios::binary);
    std::string begin(std::strlen(kMagic) + 64, '\0');
    file.read(begin.data(), std::streamsize(begin.size()));
    begin.resize(size_t(file.gcount()));
    return begins_as_recipe(begin);
}

std::string read_text(const std::string& filename) {
    std::error_code problem;
    if (!std::filesystem::is_regular_file(filename, problem)) {
        throw RecipeError(std::filesystem::exists(filename, problem) ? "is no regular file"
                                                                     : "does not exist");
    }
    std::ifstream file(filename, std::ios::binary);
    std::string text(kMostBytes + 1, '\0');
    file.read(text.data(), std::streamsize(text.size()));
    text.resize(size_t(file.gcount()));
    if (file.bad() || (text.empty() && !file.eof()))
        throw RecipeError("cannot be read");
    if (!begins_as_recipe(text)) {
        const std::string first = text.substr(0, text.find('\n'));
        throw RecipeError(first.compare(0, 9, "tonetool ") == 0 && first.size() < 40
                              ? "is of another version, \"" + first + "\" (valid: \"" +
                                    std::string(kMagic) + "\")"
                              : "is no recipe: its first line is not \"" + std::string(kMagic) +
                                    "\"");
    }
    if (text.size() > kMostBytes)
        throw RecipeError("is larger than 1 MB, the most that a recipe may be");
    for (unsigned char c : text)
        if ((c < ' ' && !is_space(char(c))) || c == 127)
            throw RecipeError("is no text: it has a byte of value " + std::to_string(int(c)));
    return text;
}

Strings parse(const std::string& text, const Parameters& given) {
    return Parser(text, given).words();
}

} // namespace tonetool::recipe
