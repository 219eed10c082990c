// SPDX-License-Identifier: BSD-3-Clause
// "TOP.width/2 + 1": arithmetic on numbers, texts, and what names stand for.
#pragma once

#include <optional>
#include <string>

namespace tonetool {

/// What names in expressions stand for.
class ExpressionNames {
public:
    virtual ~ExpressionNames() = default;
    /// Of a variable.
    virtual std::optional<std::string> value(const std::string& name) = 0;
    /// TOP, or an image by its place on the stack, label or name, whose attributes are asked for
    /// next. False if there is none.
    virtual bool select_top() = 0;
    virtual bool select(const std::string& which) = 0;
    /// Of the image that was selected.
    virtual std::optional<std::string> attribute(const std::string& name) = 0;
};

/// Parentheses and signs that may be within one another.
inline constexpr int kMostNestedExpressions = 100;

/// The value, as text; what is not understood is a CommandError, as is what is nested deeper than
/// `most_nested_expressions`. If `lenient`, text in place of a
/// number and unknown global attributes are let pass as oiiotool does.
std::string evaluated(const std::string& text, ExpressionNames& names, bool lenient);

/// What --if and --while take for true: neither empty nor 0 nor "false".
bool is_true(const std::string& value);

/// A number as expressions print it.
std::string expression_number(double value);

} // namespace tonetool
