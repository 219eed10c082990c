// SPDX-License-Identifier: BSD-3-Clause
// A curve or view as the steps that OpenColorIO takes and files hold. Only lut*.cpp include this.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "imagebuf/lut/lut_shaper.h"
#include "imagebuf/lut/lut_source.h"

namespace tonetool {

/// Steps from the input of a file to its result. The numbers of the tables are those of the file.
struct LutSteps {
    ocio::GroupTransformRcPtr group = ocio::GroupTransform::Create();
    ocio::Lut1DTransformRcPtr table; ///< the one that .cube and .spi1d hold, or
    ocio::Lut3DTransformRcPtr cube;
    std::string structure;
};

/// For formats of scene light: everything is in the group.
LutSteps scene_steps(const LutSource& source, const LutShaper& shaper, int size,
                     bool fixed_functions);
/// For formats of one table: the group has the shaper, which their readers must do, and the table.
LutSteps shaped_steps(const LutSource& source, const LutShaper& shaper, int size, bool cube);

/// Khronos PBR neutral without a cube.
void append_neutral(const LutShaper& shaper, int size, ocio::GroupTransform& group);

// Steps.
ocio::TransformRcPtr lut_range(bool upper);
ocio::MatrixTransformRcPtr lut_matrix(const double (&rows)[3][3],
                                      const std::array<double, 3>& offset);
/// Of `size` entries for 0 to 1; `value(c, v)` of channel c.
ocio::Lut1DTransformRcPtr lut_table(int size, const std::function<double(int, double)>& value);

} // namespace tonetool
