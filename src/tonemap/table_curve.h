// SPDX-License-Identifier: BSD-3-Clause
// A measured table as a tone curve.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "kernels/curve.h"

namespace tonetool::tonemap {

/// Rows as a file has them.
struct MeasuredRows {
    std::vector<double> x;              ///< strictly rising, at least two
    std::vector<std::vector<double>> y; ///< one column or three: R, G, B
};

enum class TableInput { Linear, Log2, Log10 };
enum class TableOutput {
    Linear,  ///< display light
    Encoded, ///< code values of the display
    Density  ///< 10^-(D - the least D of the column) is display light
};

/// What the numbers of a table mean.
struct TableMeaning {
    TableInput input = TableInput::Linear;
    TableOutput output = TableOutput::Linear;
    double white = 1;                     ///< the scene light of x = 1, or of its logarithm 0
    std::function<double(double)> decode; ///< code values to light, for Encoded
};

/// What is to be said of a table. All x are scene light.
struct TableFacts {
    size_t rows = 0;
    double low = 0, high = 0;       ///< first and last x
    bool by_channel = false;        ///< R, G and B differ
    double largest = 0;             ///< display light of the brightest grey
    std::optional<double> falls_at; ///< where a brighter grey first becomes darker
};

struct TableCurve {
    kernels::CurveNumbers numbers;
    TableFacts facts;
};

/// Lines between the rows are lines of the file's own numbers: where these are not light, or not of
/// light, rows are put between them, so that the lines of the curve follow within 1e-6. An x that
/// is out of range is a std::invalid_argument.
TableCurve table_curve(const MeasuredRows& rows, const TableMeaning& meaning);

/// The smallest x with y for a grey; nullopt where no row reaches y, or the first row has it at 0.
std::optional<double> first_reach(const kernels::CurveNumbers& table, double y);

} // namespace tonetool::tonemap
