// SPDX-License-Identifier: BSD-3-Clause
#include "chain/language/arithmetic.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <cmath>
#include <utility>

#include "text/error.h"
#include "text/text.h"

namespace tonetool {

namespace {

namespace Strutil = OIIO::Strutil;

// The begin of a text that may be long, for a message.
std::string shortened(const std::string& text) {
    constexpr size_t most = 200;
    return text.size() > most ? text.substr(0, most) + "..." : text;
}

bool find_global(const std::string& name, OIIO::ParamValue& value) {
    if (int number = 0; OIIO::getattribute(name, number))
        value = {name, number};
    else if (float real = 0; OIIO::getattribute(name, real))
        value = {name, real};
    else if (std::string text; OIIO::getattribute(name, text))
        value = {name, text};
    else
        return false;
    return true;
}

// Recursive descent; every level returns its value as text, as metadata and variables are text.
class Evaluator {
public:
    Evaluator(ExpressionNames& names, const std::string& text, bool lenient)
        : m_names(names),
          m_lenient(lenient),
          m_text(text),
          m_rest(m_text) {}

    std::string value() {
        std::string result = binary(0);
        Strutil::skip_whitespace(m_rest);
        if (!m_rest.empty())
            fail("syntax error");
        return result;
    }

private:
    using Compute = double (*)(double, double);
    struct Operator {
        int level; // binds tighter than the ones below it
        const char* sign;
        Compute compute;
    };
    static const std::vector<Operator>& operators();

    [[noreturn]] void fail(const std::string& why) const {
        throw CommandError(Strutil::fmt::format(
            "{} at char {} of '{}'", why, m_text.size() - m_rest.size() + 1, shortened(m_text)));
    }

    std::string binary(int level);
    std::string combined(const std::string& left, const Operator& with, const std::string& right);
    std::string atom();
    std::string value_of_atom();
    std::string function(const std::string& name);
    std::string named(const std::string& name);
    std::string image_attribute(bool found);
    bool select_indexed();
    std::string attribute_name();

    ExpressionNames& m_names;
    const bool m_lenient;
    const std::string m_text;
    int m_depth = 0; ///< of the parentheses and signs around the atom here
    OIIO::string_view m_rest;
};

const std::vector<Evaluator::Operator>& Evaluator::operators() {
    // Whole numbers for // and %; a sign that begins another comes after it.
    static const std::vector<Operator> all = {
        {0, "||", [](double a, double b) -> double { return a != 0 || b != 0; }},
        {1, "&&", [](double a, double b) -> double { return a != 0 && b != 0; }},
        {2, "<=>", [](double a, double b) -> double { return a < b ? -1 : (a > b ? 1 : 0); }},
        {2, "==", [](double a, double b) -> double { return a == b; }},
        {2, "!=", [](double a, double b) -> double { return a != b; }},
        {2, "<=", [](double a, double b) -> double { return a <= b; }},
        {2, ">=", [](double a, double b) -> double { return a >= b; }},
        {2, "<", [](double a, double b) -> double { return a < b; }},
        {2, ">", [](double a, double b) -> double { return a > b; }},
        {3, "+", [](double a, double b) { return a + b; }},
        {3, "-", [](double a, double b) { return a - b; }},
        {4, "*", [](double a, double b) { return a * b; }},
        {4, "//",
         [](double a, double b) {
             return std::trunc(b) == 0 ? 0.0 : std::trunc(std::trunc(a) / std::trunc(b));
         }},
        {4, "/", [](double a, double b) { return a / b; }},
        {4, "%",
         [](double a, double b) {
             return std::trunc(b) == 0 ? 0.0 : std::fmod(std::trunc(a), std::trunc(b));
         }},
    };
    return all;
}

std::string Evaluator::combined(const std::string& left, const Operator& with,
                                const std::string& right) {
    if (!Strutil::string_is_float(left) || !Strutil::string_is_float(right)) {
        if (!m_lenient) {
            fail(
                Strutil::fmt::format("\"{}\" {} \"{}\" needs numbers (eq() and neq() compare text)",
                                     left, with.sign, right));
        }
        return left;
    }
    double value = with.compute(double(Strutil::stof(left)), double(Strutil::stof(right)));
    return value == 0 ? "0" : expression_number(value);
}

std::string Evaluator::binary(int level) {
    constexpr int atoms = 5;
    if (level == atoms)
        return atom();
    std::string left = binary(level + 1);
    for (bool found = true; found;) {
        found = false;
        for (const Operator& with : operators()) {
            if (with.level == level && Strutil::parse_prefix(m_rest, with.sign)) {
                left = combined(left, with, binary(level + 1));
                found = true;
                break;
            }
            Strutil::skip_whitespace(m_rest);
        }
    }
    return left;
}

// Text from a file must not exhaust the stack of the program that reads it.
std::string Evaluator::atom() {
    if (m_depth == kMostNestedExpressions) {
        throw CommandError(Strutil::fmt::format(
            "nested deeper than {}, the most that parentheses and signs may be, at char {} of '{}'",
            kMostNestedExpressions, m_text.size() - m_rest.size() + 1, shortened(m_text)));
    }
    ++m_depth;
    std::string value = value_of_atom();
    --m_depth;
    return value;
}

std::string Evaluator::value_of_atom() {
    Strutil::skip_whitespace(m_rest);
    if (Strutil::parse_char(m_rest, '(')) {
        std::string inner = binary(0);
        if (!Strutil::parse_char(m_rest, ')'))
            fail("missing `)'");
        return inner;
    }
    if (!m_rest.empty() && (m_rest.front() == '\'' || m_rest.front() == '"')) {
        OIIO::string_view text;
        if (!Strutil::parse_string(m_rest, text))
            fail("unfinished string");
        return text;
    }
    if (Strutil::parse_char(m_rest, '!'))
        return is_true(atom()) ? "0" : "1";
    if (float number = 0; Strutil::parse_float(m_rest, number))
        return expression_number(double(number));
    if (Strutil::parse_char(m_rest, '-'))
        return expression_number(-double(Strutil::stof(atom())));
    if (Strutil::parse_char(m_rest, '+'))
        return atom();
    std::string name = Strutil::parse_identifier(m_rest);
    if (name.empty())
        fail("syntax error");
    return Strutil::parse_char(m_rest, '(') ? function(name) : named(name);
}

std::string Evaluator::function(const std::string& name) {
    auto argument = [&](char end) {
        std::string value = binary(0);
        if (!Strutil::parse_char(m_rest, end))
            fail(name + "() lacks `" + end + "'");
        return value;
    };
    if (name == "not")
        return is_true(argument(')')) ? "0" : "1";
    if (name == "eq" || name == "neq") {
        std::string first = argument(',');
        return (first == argument(')')) == (name == "eq") ? "1" : "0";
    }
    if (name == "getattribute") {
        std::string key = Strutil::strip(Strutil::parse_until(m_rest, ")"), " '\"");
        (void)Strutil::parse_char(m_rest, ')');
        if (OIIO::ParamValue value; find_global(key, value))
            return value.get_string();
        return m_lenient ? m_text : (fail("unknown attribute name '" + key + "'"), "");
    }
    if (name == "var") {
        const std::string key = Strutil::strip(Strutil::parse_until(m_rest, ")"), "'\"");
        (void)Strutil::parse_char(m_rest, ')');
        return m_names.value(key).value_or("");
    }
    fail("unknown function " + name + "() (valid: not, eq, neq, getattribute, var)");
}

std::string Evaluator::named(const std::string& name) {
    if (name == "TOP")
        return image_attribute(m_names.select_top());
    if (name == "IMG")
        return image_attribute(select_indexed());
    if (auto value = m_names.value(name))
        return *value;
    m_rest = OIIO::string_view(m_text).substr(m_text.size() - m_rest.size() - name.size());
    fail("syntax error");
}

bool Evaluator::select_indexed() {
    if (!Strutil::parse_char(m_rest, '['))
        fail("expected `[`");
    std::string which = Strutil::strip(Strutil::parse_until(m_rest, "]"));
    if (!Strutil::parse_char(m_rest, ']'))
        fail("expected `]`");
    which = Strutil::strip(which, "'\"");
    if (which.find_first_of("+*/% (") != std::string::npos || m_names.value(which))
        which = Evaluator(m_names, which, m_lenient).value();
    return m_names.select(which);
}

std::string Evaluator::attribute_name() {
    OIIO::string_view name;
    if (Strutil::parse_char(m_rest, '[')) {
        const bool quoted = !m_rest.empty() && (m_rest.front() == '\'' || m_rest.front() == '"');
        std::string key = m_lenient && !quoted ? Strutil::parse_identifier(m_rest)
                                               : Strutil::strip(Strutil::parse_until(m_rest, "]"));
        if (!Strutil::parse_char(m_rest, ']'))
            fail("expected `]`");
        return Strutil::strip(key, "'\"");
    }
    if (!Strutil::parse_char(m_rest, '.'))
        fail("expected `.` or `[`");
    bool quoted = !m_rest.empty() && (m_rest.front() == '\'' || m_rest.front() == '"');
    if (quoted ? !Strutil::parse_string(m_rest, name)
               : (name = Strutil::parse_identifier(m_rest)).empty())
        fail("syntax error");
    return name;
}

std::string Evaluator::image_attribute(bool found) {
    if (!found)
        fail("not a valid image");
    const bool in_brackets = !m_rest.empty() && m_rest.front() == '[';
    const std::string name = attribute_name();
    if (auto value = m_names.attribute(name))
        return *value;
    if (in_brackets) // TOP[name]: what is not there is empty
        return "";
    fail("unknown attribute name '" + name + "'");
}

} // namespace

std::string expression_number(double value) {
    return Strutil::fmt::format("{:g}", value);
}

bool is_true(const std::string& value) {
    std::string text = Strutil::lower(Strutil::strip(value));
    bool number = Strutil::string_is_float(text);
    return number ? Strutil::stof(text) != 0
                  : !text.empty() && text != "false" && text != "no" && text != "off";
}

std::string evaluated(const std::string& text, ExpressionNames& names, bool lenient) {
    return Evaluator(names, text, lenient).value();
}

} // namespace tonetool
