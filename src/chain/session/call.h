// SPDX-License-Identifier: BSD-3-Clause
// One use of a command: its row, arguments, modifiers and the images it popped.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "chain/images/image.h"
#include "chain/language/registry.h"
#include "chain/language/values.h"
#include "text/token.h"

namespace tonetool::chain {

class Call {
public:
    /// Checks the keys of the modifiers against the row; if `lenient`, unknown ones are ignored.
    Call(const Command& row, Token token, Strings arguments, bool lenient = false);

    const Command& row() const { return *m_row; }
    /// As typed: "--resize:filter=box".
    const std::string& text() const { return m_token.text; }
    /// What oiiotool calls an operation, and the image that it makes: "-mulc". Empty where the
    /// image keeps its name and messages say what was typed.
    const std::string& operation() const { return m_row->operation; }
    /// As typed, with the arguments: "--mulc", "2".
    std::string quoted_words() const {
        Strings words = m_arguments;
        words.insert(words.begin(), m_token.text);
        return '"' + join(words, "\", \"") + '"';
    }
    const std::string& argument(size_t index) const { return m_arguments.at(index); }
    bool has_argument(size_t index) const { return index < m_arguments.size(); }
    /// With --compat: the modifiers that have no effect, as they are unknown or malformed.
    Strings dropped() const;
    int pops() const;
    int pushes() const;

    /// The place of its word on the command line.
    size_t at = 0;
    /// The images popped, the deepest first.
    std::vector<ImagePtr> images;

    // Modifiers: nullopt where not given. A value that is not valid is a CommandError; if lenient,
    // it is what oiiotool makes of it.
    bool has(const std::string& key) const;
    std::optional<std::string> text(const std::string& key) const;
    std::optional<double> number(const std::string& key, Range range) const;
    std::optional<int> integer(const std::string& key, Range range) const;
    bool flag(const std::string& key, bool otherwise) const;
    std::optional<std::string> choice(const std::string& key, const Strings& valid) const;
    /// Exactly `count` numbers with commas between them.
    std::vector<double> numbers(const std::string& key, size_t count) const;

    double number_argument(size_t index, Range range) const;
    int integer_argument(size_t index, Range range) const;
    double parsed(const std::string& what, const std::string& value, Range range) const;

private:
    const Command* m_row;
    Token m_token;
    Strings m_arguments;
    bool m_lenient;
};

} // namespace tonetool::chain
