// SPDX-License-Identifier: BSD-3-Clause
// steady=1 of CG-TMO: what is kept of each frame, and what a frame makes of those about it.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "imagebuf/pixels/paged_array.h"
#include "tonemap/steady.h"
#include "tonetool/cgtmo.h"

namespace tonetool {

/// What is kept of a frame: 41 bytes a pixel, 57 with motion.
struct SteadyPlanes {
    int width = 0, height = 0;
    PagedArray<tonemap::SteadyPixel> pixels;
    PagedArray<float> noise;
    PagedArray<uint8_t> background;
    PagedArray<std::array<float, 4>> motion; ///< empty: none
    bool has_normal = false, has_albedo = false;
    std::optional<tonemap::Projection> camera;
    std::string lack; ///< why there is no camera; empty: there is one
};

/// The image as others use it. Options have all the preset's.
SteadyFrame steady_frame_of(const OIIO::ImageBuf& src, const CgTmoOptions& options, int nthreads);

/// Packed planes of a window.
struct SteadyResult {
    PagedArray<float> base, gain, share; ///< share: only where it is to be shown
};

/// Of the frame that the options name, by those about it; nullopt where it has no camera, which is
/// told. A Refusal where one of them is not given. `image` has the frame's footprints.
std::optional<SteadyResult> steady_result(const CgTmoOptions& options,
                                          const tonemap::LocalOperator& what,
                                          const kernels::GuidePlanes& image,
                                          const kernels::Window& window, CgTmoSummary& summary,
                                          int nthreads);

/// All channels of an OpenEXR file in memory, which each reader of a few would have to decode
/// again. Other files and types are read as what they are: not initialized.
OIIO::ImageBuf read_once(const OIIO::ImageBuf& src, const CgTmoOptions& options, int nthreads);

} // namespace tonetool
