// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/call.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "chain/language/values.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

Strings keys_of(const Command& row) {
    Strings keys;
    for (const Modifier& modifier : row.modifiers)
        keys.push_back(modifier.key);
    return keys;
}

// Modifiers whose help begins with the word that somebody took for a name: stops= for "exposure".
std::string told_by_help(const std::string& word, const Command& row) {
    constexpr size_t least = 4;
    Strings keys;
    for (const Modifier& modifier : row.modifiers)
        if (word.size() >= least && !modifier.of_curve &&
            modifier.help.compare(0, word.size(), word) == 0)
            keys.push_back("\"" + modifier.key + "\"");
    return keys.empty() ? "" : ", did you mean " + join(keys, " or ") + "?";
}

void check_keys(const Command& row, const Token& token) {
    const Strings keys = keys_of(row);
    for (const auto& [key, value] : token.modifiers) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
            std::string near = meant(key, keys);
            near = near.empty() ? told_by_help(key, row) : near;
            const std::string rest = keys.empty()   ? " (this command has none)"
                                     : near.empty() ? " (valid: " + join(keys, ", ") + ")"
                                                    : " (--help " + row.label() + " lists all)";
            throw CommandError("unknown modifier \"" + key + "\"" + near + rest);
        }
    }
}

} // namespace

Call::Call(const Command& row, Token token, Strings arguments, bool lenient)
    : m_row(&row),
      m_token(std::move(token)),
      m_arguments(std::move(arguments)),
      m_lenient(lenient && !row.own) {
    if (!m_lenient)
        check_keys(row, m_token);
}

Strings Call::dropped() const {
    const Strings keys = keys_of(*m_row);
    Strings found = m_token.dropped;
    for (const auto& [key, value] : m_token.modifiers)
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
            found.push_back(key + "=" + value);
    return found;
}

int Call::pops() const {
    return m_row->pops_of ? m_row->pops_of(*this) : m_row->pops;
}

int Call::pushes() const {
    return m_row->pushes_of ? m_row->pushes_of(*this) : m_row->pushes;
}

bool Call::has(const std::string& key) const {
    return text(key).has_value();
}

double Call::parsed(const std::string& what, const std::string& value, Range range) const {
    return m_lenient ? double(OIIO::Strutil::stof(value)) : checked_number(what, value, range);
}

std::optional<std::string> Call::text(const std::string& key) const {
    for (const auto& [name, value] : m_token.modifiers)
        if (name == key)
            return value;
    return std::nullopt;
}

std::optional<double> Call::number(const std::string& key, Range range) const {
    std::optional<std::string> value = text(key);
    return value ? std::optional<double>(parsed(key, *value, range)) : std::nullopt;
}

std::optional<int> Call::integer(const std::string& key, Range range) const {
    std::optional<std::string> value = text(key);
    return !value      ? std::nullopt
           : m_lenient ? std::optional<int>(OIIO::Strutil::stoi(*value))
                       : std::optional<int>(checked_integer(key, *value, range));
}

bool Call::flag(const std::string& key, bool otherwise) const {
    std::optional<std::string> value = choice(key, {"0", "1"});
    return value ? OIIO::Strutil::stoi(*value) != 0 : otherwise;
}

std::optional<std::string> Call::choice(const std::string& key, const Strings& valid) const {
    std::optional<std::string> value = text(key);
    if (value && !m_lenient)
        check_choice(key, *value, valid);
    return value;
}

std::vector<double> Call::numbers(const std::string& key, size_t count) const {
    std::vector<double> values;
    std::optional<std::string> list = text(key);
    if (!list)
        return values;
    for (const std::string& word : split(*list, ','))
        values.push_back(checked_number(key, word, {-1e30, 1e30}));
    if (values.size() != count) {
        throw CommandError(key + " \"" + *list + "\" has " + std::to_string(values.size()) +
                           " numbers (valid: " + std::to_string(count) +
                           " numbers with commas between them)");
    }
    return values;
}

double Call::number_argument(size_t index, Range range) const {
    return parsed(m_row->args.at(index), argument(index), range);
}

int Call::integer_argument(size_t index, Range range) const {
    return m_lenient ? OIIO::Strutil::stoi(argument(index))
                     : checked_integer(m_row->args.at(index), argument(index), range);
}

} // namespace tonetool::chain
