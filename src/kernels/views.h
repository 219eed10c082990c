// SPDX-License-Identifier: BSD-3-Clause
// Images as the libraries below the ImageBuf border see them: pointers, strides and numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>

namespace tonetool::kernels {

/// Three planes of one image, row stride in floats; or of a scanline block that holds all rows
/// which the result depends on.
struct ConstRgb {
    const float* plane[3] = {nullptr, nullptr, nullptr};
    ptrdiff_t stride = 0;
    int width = 0, height = 0; ///< of the whole image
    int first_row = 0;         ///< row of the image that the planes begin with
};

/// A rectangle of an image.
struct Window {
    int x0 = 0, y0 = 0, width = 0, height = 0;
};

/// Runs task(0) ... task(count - 1), in any order, on as many threads as it likes.
using ParallelFor = std::function<void(int64_t count, const std::function<void(int64_t)>& task)>;

} // namespace tonetool::kernels
