// SPDX-License-Identifier: BSD-3-Clause
// Tokens, expressions, numbers, and what is printed of them.
#include <algorithm>

#include "chain/language/arithmetic.h"
#include "fuzz.h"
#include "text/error.h"
#include "text/printable.h"
#include "text/text.h"
#include "text/token.h"

namespace {

using namespace tonetool;

class Names : public ExpressionNames {
public:
    std::optional<std::string> value(const std::string& name) override {
        return name == "x" ? std::optional<std::string>("3") : std::nullopt;
    }
    bool select_top() override { return true; }
    bool select(const std::string& which) override { return which == "0"; }
    std::optional<std::string> attribute(const std::string& name) override {
        return name == "width" ? std::optional<std::string>("64") : std::nullopt;
    }
};

void read_word(const std::string& word, bool lenient) {
    try {
        const Token token = parse_token(word, lenient);
        fuzz::require(token.text == word, "a token keeps its word");
    } catch (const CommandError&) {
    }
    Names names;
    try {
        (void)is_true(evaluated(word, names, lenient));
    } catch (const CommandError& problem) {
        fuzz::require(*problem.what() != '\0', "an error has a text");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string word = fuzz::text_of(data, size);
    read_word(word, false);
    read_word(word, true);
    (void)parse_number(word);
    (void)parse_integer(word);
    (void)parse_size(word);
    const auto is_control = [](char c) { return (c >= 0 && c < ' ') || c == 127; };
    for (const std::string& shown : {printable(word), shell_quoted(word)}) {
        fuzz::require(std::none_of(shown.begin(), shown.end(), is_control),
                      "what is printed has no control characters");
    }
    fuzz::require(printable(printable(word)) == printable(word), "printable text stays as it is");
    return 0;
}
