// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lut/lut_ops.h"

#include <OpenImageIO/strutil.h>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "kernels/curve_constants.h"
#include "kernels/tone_curve.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using Structure = LutSource::Structure;

constexpr int kTableSize = 4096, kCubeSize = 33;

// Few enough digits that every processor and library arrives at the same.
float rounded(double v) {
    char text[32];
    std::snprintf(text, sizeof text, "%.6g", v);
    return std::strtof(text, nullptr);
}

int size_or(int size, int otherwise) {
    return size > 0 ? size : otherwise;
}

ocio::TransformRcPtr power(double exponent, ocio::TransformDirection direction) {
    const auto transform = ocio::ExponentTransform::Create();
    transform->setValue({exponent, exponent, exponent, 1});
    transform->setDirection(direction);
    return transform;
}

// Of display light of 0 to 1; null: none.
ocio::TransformRcPtr encoding(const std::string& name) {
    if (name == "none")
        return nullptr;
    if (name != "srgb") {
        const double gamma = name == "rec1886" ? 2.4 : std::atof(name.c_str() + 5);
        return power(gamma, ocio::TRANSFORM_DIR_INVERSE);
    }
    const auto transform = ocio::ExponentWithLinearTransform::Create();
    transform->setGamma({2.4, 2.4, 2.4, 1});
    transform->setOffset({0.055, 0.055, 0.055, 0});
    transform->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    return transform;
}

void append(const ocio::GroupTransformRcPtr& group, const ocio::TransformRcPtr& transform) {
    if (transform)
        group->appendTransform(transform);
}

ocio::Lut3DTransformRcPtr make_cube(const LutSource& source, const LutShaper& shaper, int size) {
    const auto nodes = (unsigned long)(size);
    auto cube = ocio::Lut3DTransform::Create(nodes);
    cube->setFileOutputBitDepth(ocio::BIT_DEPTH_F32);
    cube->setInterpolation(ocio::INTERP_TETRAHEDRAL);
    std::vector<float> axis(nodes), row(3 * nodes);
    for (size_t i = 0; i < nodes; ++i)
        axis[i] = float(shaper.light(double(i) / double(nodes - 1)));
    for (size_t r = 0; r < nodes; ++r)
        for (size_t g = 0; g < nodes; ++g) {
            for (size_t b = 0; b < nodes; ++b) {
                row[3 * b] = axis[r];
                row[3 * b + 1] = axis[g];
                row[3 * b + 2] = axis[b];
            }
            source.exact(row.data(), ptrdiff_t(nodes));
            for (size_t b = 0; b < nodes; ++b)
                cube->setValue(r, g, b, rounded(double(row[3 * b])),
                               rounded(double(row[3 * b + 1])), rounded(double(row[3 * b + 2])));
        }
    return cube;
}

// Display light of 0 to 1, encoded.
void append_display(const LutSource& source, const ocio::GroupTransformRcPtr& group) {
    group->appendTransform(lut_range(true));
    append(group, encoding(source.encode()));
}

void append_matrices(const LutSource& source, const LutShaper& shaper, int size, LutSteps& steps) {
    const bool agx = source.curve().numbers.kind == kernels::CurveKind::Agx;
    steps.group->appendTransform(lut_matrix(agx ? kernels::kAgxIn : kernels::kAcesHillIn, {}));
    append(steps.group, shaper.transform());
    steps.group->appendTransform(
        lut_table(size, [&](int c, double v) { return source.inner(c, shaper.light(v)); }));
    steps.group->appendTransform(lut_matrix(agx ? kernels::kAgxOut : kernels::kAcesHillOut, {}));
    if (agx) {
        steps.group->appendTransform(lut_range(false));
        steps.group->appendTransform(power(kernels::kDisplayGamma, ocio::TRANSFORM_DIR_FORWARD));
    }
    append_display(source, steps.group);
    steps.structure = format("matrix, 1D {}, matrix", size);
}

// Red, luminance and blue take the places of X, Y and Z: what x and y keep are ratios.
void append_luminance(const LutSource& source, const LutShaper& shaper, int size, LutSteps& steps) {
    const auto& weights = source.curve().use.weights;
    const double rows[3][3] = {{1, 0, 0}, {weights[0], weights[1], weights[2]}, {0, 0, 1}};
    const auto in = lut_matrix(rows, {}), out = lut_matrix(rows, {});
    out->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    const auto to = ocio::FixedFunctionTransform::Create(ocio::FIXED_FUNCTION_XYZ_TO_xyY);
    const auto back = ocio::FixedFunctionTransform::Create(ocio::FIXED_FUNCTION_XYZ_TO_xyY);
    back->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    steps.group->appendTransform(in);
    steps.group->appendTransform(to);
    steps.group->appendTransform(shaper.channels({false, false, true}));
    steps.group->appendTransform(lut_table(size, [&](int c, double v) {
        return c < 2 ? std::exp2(v) - 1 : source.inner(0, shaper.light(v));
    }));
    steps.group->appendTransform(back);
    steps.group->appendTransform(out);
    append_display(source, steps.group);
    steps.structure = format("xyY, 1D {} of Y", size);
}

void append_table(const LutSource& source, const LutShaper& shaper, int size, LutSteps& steps) {
    append(steps.group, shaper.transform());
    steps.table = lut_table(
        size, [&](int c, double v) { return source.encoded(source.inner(c, shaper.light(v))); });
    steps.group->appendTransform(steps.table);
    steps.structure = format("1D {}", size);
}

// Unclamped, so that what is cut off is cut exactly.
void append_scene_table(const LutSource& source, const LutShaper& shaper, int size,
                        LutSteps& steps) {
    append(steps.group, shaper.transform());
    steps.group->appendTransform(
        lut_table(size, [&](int c, double v) { return source.inner(c, shaper.light(v)); }));
    append_display(source, steps.group);
    steps.structure = format("1D {}", size);
}

void append_cube(const LutSource& source, const LutShaper& shaper, int size, LutSteps& steps) {
    append(steps.group, shaper.transform());
    steps.cube = make_cube(source, shaper, size);
    steps.group->appendTransform(steps.cube);
    steps.structure = format("3D {}", size);
}

} // namespace

ocio::TransformRcPtr lut_range(bool upper) {
    const auto range = ocio::RangeTransform::Create();
    range->setMinInValue(0);
    range->setMinOutValue(0);
    if (upper) {
        range->setMaxInValue(1);
        range->setMaxOutValue(1);
    }
    return range;
}

ocio::MatrixTransformRcPtr lut_matrix(const double (&rows)[3][3],
                                      const std::array<double, 3>& offset) {
    double values[16] = {};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            values[4 * i + j] = rows[i][j];
    values[15] = 1;
    const double offsets[4] = {offset[0], offset[1], offset[2], 0};
    auto transform = ocio::MatrixTransform::Create();
    transform->setMatrix(values);
    transform->setOffset(offsets);
    return transform;
}

ocio::Lut1DTransformRcPtr lut_table(int size, const std::function<double(int, double)>& value) {
    const auto entries = (unsigned long)(size);
    auto table = ocio::Lut1DTransform::Create(entries, false);
    table->setFileOutputBitDepth(ocio::BIT_DEPTH_F32);
    table->setInterpolation(ocio::INTERP_LINEAR);
    for (unsigned long i = 0; i < entries; ++i) {
        const double v = double(i) / double(entries - 1);
        table->setValue(i, rounded(value(0, v)), rounded(value(1, v)), rounded(value(2, v)));
    }
    return table;
}

LutSteps scene_steps(const LutSource& source, const LutShaper& shaper, int size,
                     bool fixed_functions) {
    LutSteps steps;
    steps.group->appendTransform(lut_range(false));
    const int table_size = size_or(size, kTableSize);
    const bool in_parts = fixed_functions && shaper.is_log2();
    if (source.structure() == Structure::Channel)
        append_scene_table(source, shaper, table_size, steps);
    else if (source.structure() == Structure::Matrices)
        append_matrices(source, shaper, table_size, steps);
    else if (in_parts && source.structure() == Structure::Luminance)
        append_luminance(source, shaper, table_size, steps);
    else if (in_parts && source.structure() == Structure::Neutral) {
        append_neutral(shaper, table_size, *steps.group);
        append_display(source, steps.group);
        steps.structure = format("HSV, 3 x 1D {}", table_size);
    } else
        append_cube(source, shaper, size_or(size, kCubeSize), steps);
    return steps;
}

LutSteps shaped_steps(const LutSource& source, const LutShaper& shaper, int size, bool cube) {
    LutSteps steps;
    if (cube)
        append_cube(source, shaper, size_or(size, kCubeSize), steps);
    else
        append_table(source, shaper, size_or(size, kTableSize), steps);
    return steps;
}

} // namespace tonetool
