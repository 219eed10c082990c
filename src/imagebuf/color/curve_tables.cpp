// SPDX-License-Identifier: BSD-3-Clause
// Curves as .spi1d, .cube and .csv.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>

#include "imagebuf/color/curve_text.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using tonemap::MeasuredRows;
using Words = std::vector<std::string>;

// A table of evenly spaced x, as it is read.
struct EvenTable {
    double low = 0, high = 1;
    size_t length = 0; ///< 0: not said yet
    std::vector<std::vector<double>> rows;

    MeasuredRows measured(const CurveText& text) const {
        if (!(low < high))
            text.fail(format("its x go from {} to {}: must rise", low, high));
        if (rows.size() != length)
            text.fail(format("has {} row(s), but says that it has {}", rows.size(), length));
        MeasuredRows out;
        out.y.resize(rows[0].size());
        for (size_t i = 0; i < length; ++i) {
            out.x.push_back(low + (high - low) * double(i) / double(length - 1));
            for (size_t c = 0; c < out.y.size(); ++c)
                out.y[c].push_back(rows[i][c]);
        }
        return out;
    }

    void add(const CurveText& text, size_t i, size_t columns) {
        if (rows.size() == length)
            text.fail(i, format("is behind the {} rows that the file says it has", length));
        rows.push_back(text.numbers(i, text.words(i), 0, columns));
    }
};

// The header of an .spi1d up to its brace, and how many numbers a row has.
size_t read_spi1d_header(const CurveText& text, EvenTable& table, size_t& columns) {
    bool version = false;
    for (size_t i = 0; i < text.count(); ++i) {
        const Words words = text.words(i);
        if (text.empty(i))
            continue;
        if (words[0] == "{") {
            if (!version || table.length == 0 || columns == 0)
                text.fail(i, "Version 1, From, Length and Components must come before {");
            return i + 1;
        }
        if (words[0] == "Version") {
            version = text.numbers(i, words, 1, 1)[0] == 1;
            if (!version)
                text.fail(i, "the version is \"" + words[1] + "\": must be 1");
        } else if (words[0] == "From") {
            const auto ends = text.numbers(i, words, 1, 2);
            table.low = ends[0];
            table.high = ends[1];
        } else if (words[0] == "Length") {
            table.length = text.rows(i, words.size() == 2 ? words[1] : "");
        } else if (words[0] == "Components") {
            const double given = text.numbers(i, words, 1, 1)[0];
            if (given != 1 && given != 3)
                text.fail(i, "Components is " + words[1] + ": must be 1 or 3");
            columns = size_t(given);
        } else {
            text.fail(i, '"' + words[0] + "\" is none of Version, From, Length, Components, {");
        }
    }
    text.fail("ends before its table, which begins with {");
}

// Words of a .cube that are no row; `edges` of each channel.
struct CubeHeader {
    std::array<std::vector<double>, 2> edges;
    bool three = false;
};

bool read_cube_word(const CurveText& text, size_t i, EvenTable& table, CubeHeader& header) {
    const Words words = text.words(i);
    if (words[0] == "LUT_3D_SIZE")
        header.three = true;
    else if (words[0] == "LUT_1D_SIZE")
        table.length = text.rows(i, words.size() == 2 ? words[1] : "");
    else if (words[0] == "DOMAIN_MIN" || words[0] == "DOMAIN_MAX")
        header.edges[words[0] == "DOMAIN_MAX"] = text.numbers(i, words, 1, 3);
    else if (words[0] == "LUT_1D_INPUT_RANGE") {
        const auto range = text.numbers(i, words, 1, 2);
        header.edges = {std::vector<double>(3, range[0]), std::vector<double>(3, range[1])};
    } else
        return words[0] == "TITLE";
    return true;
}

// x and its outputs; nothing for the one line of titles.
std::vector<double> csv_row(const CurveText& text, size_t i, bool first) {
    const Words cells = text.cells(i);
    if (first && std::none_of(cells.begin(), cells.end(),
                              [](const auto& cell) { return number_in_curve(cell).has_value(); }))
        return {};
    if (cells.size() != 2 && cells.size() != 4)
        text.fail(i, format("has {} field(s): must be x,y or x,r,g,b", cells.size()));
    return text.numbers(i, cells, 0, cells.size());
}

} // namespace

MeasuredRows read_spi1d(const CurveText& text) {
    EvenTable table;
    size_t columns = 0;
    for (size_t i = read_spi1d_header(text, table, columns); i < text.count(); ++i) {
        if (text.line(i) == "}")
            return table.measured(text);
        if (!text.empty(i))
            table.add(text, i, columns);
    }
    text.fail(format("ends in its table, behind row {} of {}", table.rows.size(), table.length));
}

MeasuredRows read_cube(const CurveText& text) {
    EvenTable table;
    CubeHeader header;
    for (size_t i = 0; i < text.count(); ++i) {
        if (text.empty(i) || read_cube_word(text, i, table, header))
            continue;
        if (header.three)
            text.fail("is a cube (LUT_3D_SIZE): a curve needs LUT_1D_SIZE");
        if (table.length == 0)
            text.fail(i, "LUT_1D_SIZE must come before the rows");
        table.add(text, i, 3);
    }
    if (table.length == 0)
        text.fail("has no LUT_1D_SIZE");
    for (size_t end = 0; end < 2; ++end) {
        const auto& edge = header.edges[end];
        if (edge.empty())
            continue;
        if (edge[0] != edge[1] || edge[0] != edge[2])
            text.fail(format("its domain has an end at {} {} {}: must be one for R, G and B",
                             edge[0], edge[1], edge[2]));
        (end == 0 ? table.low : table.high) = edge[0];
    }
    return table.measured(text);
}

MeasuredRows read_csv(const CurveText& text, bool logarithms) {
    MeasuredRows out;
    bool first = true;
    for (size_t i = 0; i < text.count(); ++i) {
        if (text.empty(i))
            continue;
        const auto row = csv_row(text, i, first);
        first = false;
        if (row.empty())
            continue;
        if (out.x.empty())
            out.y.resize(row.size() - 1);
        if (row.size() != out.y.size() + 1)
            text.fail(i, format("has {} number(s), but the rows above have {}", row.size(),
                                out.y.size() + 1));
        if (row[0] < 0 && !logarithms)
            text.fail(i,
                      format("x is {}: must be 0 or more, or a logarithm (tableinput=)", row[0]));
        if (!out.x.empty())
            text.check_rising(i, out.x.back(), row[0]);
        out.x.push_back(row[0]);
        for (size_t c = 1; c < row.size(); ++c)
            out.y[c - 1].push_back(row[c]);
        if (out.x.size() > kMostCurveRows)
            text.fail(i, format("is a row beyond the {} that a curve may have", kMostCurveRows));
    }
    text.check_rows(out.x.size());
    return out;
}

} // namespace tonetool
