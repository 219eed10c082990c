// SPDX-License-Identifier: BSD-3-Clause
// Files of curves that are text, line by line. Only curve_*.cpp include this.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tonemap/table_curve.h"
#include "tonetool/tonemap.h"

namespace tonetool {

/// Rows that a table may have.
inline constexpr size_t kLeastCurveRows = 2, kMostCurveRows = 65536;

/// All of a word as a number, "nan" too; nullopt: it is none.
std::optional<double> number_in_curve(const std::string& word);

class CurveText {
public:
    /// A Refusal unless the file is text.
    explicit CurveText(const std::string& file);

    size_t count() const { return m_lines.size(); }
    /// Line i, from 0, without the blanks around it.
    const std::string& line(size_t i) const { return m_lines[i]; }
    /// Blank, or a remark behind '#'.
    bool empty(size_t i) const { return m_lines[i].empty() || m_lines[i].front() == '#'; }
    std::vector<std::string> words(size_t i) const; ///< between blanks
    std::vector<std::string> cells(size_t i) const; ///< between commas

    [[noreturn]] void fail(const std::string& why) const;
    [[noreturn]] void fail(size_t i, const std::string& why) const; ///< names the line
    /// A word of line i as a finite number.
    double number(size_t i, const std::string& word) const;
    /// Exactly `count` of them, from word `first` on.
    std::vector<double> numbers(size_t i, const std::vector<std::string>& words, size_t first,
                                size_t count) const;
    /// A number of rows, in range.
    size_t rows(size_t i, const std::string& word) const;
    void check_rows(size_t count) const;
    void check_rising(size_t i, double before, double x) const;

private:
    std::string m_file;
    std::vector<std::string> m_lines;
};

// The kinds of text.
tonemap::MeasuredRows read_spi1d(const CurveText& text);
tonemap::MeasuredRows read_cube(const CurveText& text);
/// `logarithms`: x may be negative.
tonemap::MeasuredRows read_csv(const CurveText& text, bool logarithms);
/// Camera responses of the DoRF database's form: of the name, or R, G and B of it.
tonemap::MeasuredRows read_responses(const CurveText& text, const std::string& name);
/// A mean response and base functions of the EMoR model's form.
tonemap::MeasuredRows read_model(const CurveText& text, const std::vector<double>& weights);

bool holds_responses(const CurveText& text);
bool holds_model(const CurveText& text);

} // namespace tonetool
