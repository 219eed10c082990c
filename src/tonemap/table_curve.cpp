// SPDX-License-Identifier: BSD-3-Clause
#include "tonemap/table_curve.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "kernels/curve_table.h"

namespace tonetool::tonemap {
namespace {

// Between code values or densities this far apart light is a straight line within 1e-6.
constexpr double kStep = 1.0 / 1024;
constexpr size_t kMostKnots = 1 << 17;

// What the logarithm of a normal float can be, and a value that stays finite times white.
constexpr double kMostStops = 120, kMostLight = 1e15;

std::string number_text(double value) {
    char buffer[32];
    std::snprintf(buffer, sizeof buffer, "%.6g", value);
    return buffer;
}

// x of the file to x of the kernel's table.
double placed(double x, const TableMeaning& meaning) {
    const bool linear = meaning.input == TableInput::Linear;
    const double u = linear ? x * meaning.white
                            : x * (meaning.input == TableInput::Log10 ? std::log2(10.0) : 1) +
                                  std::log2(meaning.white);
    const double most = linear ? kMostLight : kMostStops;
    if (!(std::abs(u) <= most))
        throw std::invalid_argument(
            "x = " + number_text(x) + " with white = " + number_text(meaning.white) +
            (linear ? " is beyond light of 1e15 (valid: less, or tableinput=log2 or log10)"
                    : " is beyond 2^120 (valid: logarithms, or tableinput=linear)"));
    return u;
}

double light_of(double y, double least, const TableMeaning& meaning) {
    if (meaning.output == TableOutput::Encoded)
        return meaning.decode(std::max(y, 0.0));
    return meaning.output == TableOutput::Density ? std::pow(10, least - y) : y;
}

// How many lines stand for the one behind row i.
size_t pieces(const MeasuredRows& rows, size_t i, const TableMeaning& meaning) {
    if (meaning.output == TableOutput::Linear)
        return 1;
    double rise = 0;
    for (const auto& column : rows.y)
        rise = std::max(rise, std::abs(column[i + 1] - column[i]));
    const size_t most = std::max<size_t>(1, kMostKnots / rows.x.size());
    return size_t(std::clamp(std::ceil(rise / kStep), 1.0, double(most)));
}

kernels::TableRows refined(const MeasuredRows& rows, const TableMeaning& meaning) {
    kernels::TableRows out;
    out.log2 = meaning.input != TableInput::Linear;
    std::vector<double> least;
    for (const auto& column : rows.y)
        least.push_back(*std::min_element(column.begin(), column.end()));
    const size_t last = rows.x.size() - 1;
    for (size_t i = 0; i <= last; ++i) {
        const double x = placed(rows.x[i], meaning);
        const size_t n = i < last ? pieces(rows, i, meaning) : 1;
        for (size_t k = 0; k < n; ++k) {
            const double share = double(k) / double(n);
            out.x.push_back(k == 0 ? x : x + share * (placed(rows.x[i + 1], meaning) - x));
            for (size_t c = 0; c < 3; ++c) {
                const size_t from = rows.y.size() == 3 ? c : 0;
                const double y = rows.y[from][i];
                const double between = k == 0 ? y : y + share * (rows.y[from][i + 1] - y);
                out.y[c].push_back(light_of(between, least[from], meaning));
            }
        }
    }
    return out;
}

double scene_light(const kernels::TableRows& rows, double x) {
    return rows.log2 ? std::exp2(x) : x;
}

double grey_of(const kernels::TableRows& rows, size_t i) {
    return (rows.y[0][i] + rows.y[1][i] + rows.y[2][i]) / 3;
}

TableFacts facts_of(const MeasuredRows& measured, const kernels::TableRows& rows) {
    constexpr double rounding = 1e-6; // of the digits that files have
    TableFacts facts;
    facts.rows = measured.x.size();
    facts.low = scene_light(rows, rows.x.front());
    facts.high = scene_light(rows, rows.x.back());
    facts.by_channel = rows.y[1] != rows.y[0] || rows.y[2] != rows.y[0];
    facts.largest = grey_of(rows, 0);
    for (size_t i = 1; i < rows.x.size(); ++i) {
        const double y = grey_of(rows, i);
        if (!facts.falls_at && y < facts.largest - rounding)
            facts.falls_at = scene_light(rows, rows.x[i - 1]);
        facts.largest = std::max(facts.largest, y);
    }
    return facts;
}

} // namespace

TableCurve table_curve(const MeasuredRows& rows, const TableMeaning& meaning) {
    kernels::TableRows knots = refined(rows, meaning);
    TableCurve curve;
    curve.facts = facts_of(rows, knots);
    curve.numbers.kind = kernels::CurveKind::Table;
    curve.numbers.table = std::make_shared<kernels::CurveTable>(std::move(knots));
    return curve;
}

std::optional<double> first_reach(const kernels::CurveNumbers& table, double y) {
    const kernels::TableRows& rows = table.table->rows();
    size_t i = 0;
    while (i < rows.x.size() && grey_of(rows, i) < y)
        ++i;
    if (i == rows.x.size())
        return std::nullopt;
    double x = rows.x[i];
    if (i > 0) {
        const double below = grey_of(rows, i - 1);
        x = rows.x[i - 1] + (y - below) / (grey_of(rows, i) - below) * (x - rows.x[i - 1]);
    }
    const double light = scene_light(rows, x);
    return light > 0 ? std::optional(light) : std::nullopt;
}

} // namespace tonetool::tonemap
