// SPDX-License-Identifier: BSD-3-Clause
// A pair and its error map as pictures, for --images and --figure.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>

#include "sequence/report/report_pictures.h"

namespace tonetool::sequence {

/// 8 bits, sRGB-encoded, upright; what is not initialized is not there. Pixels of the images that
/// are not finite are magenta.
struct CasePictures {
    OIIO::ImageBuf reference, test;
    OIIO::ImageBuf error; ///< in magma; without a bound up to the largest error
    bool bounded = false; ///< its colours go from 0 to 1
    /// The exposure of both; none where the images were not compared at exposures.
    std::optional<double> stops;
    int x = 0, y = 0; ///< where they lie in the file; 0 where they were turned
};

/// At the exposure that has the error of the pixel `worst`, else at the middle one. Throws a
/// runtime_error.
CasePictures draw_worst(const PictureRequest& request, const std::optional<Position>& worst,
                        int nthreads = 0);
/// At this exposure, else at the middle one.
CasePictures draw_case(const PictureRequest& request, const std::optional<double>& stops,
                       int nthreads = 0);

/// What is drawn of one case, beside the report, while its commands run.
struct CaseDrawing {
    bool worst_asked = false; ///< by --images
    bool worst_always = true; ///< also where the case has passed so far: something else may come
    bool first_asked = false; ///< by --figure
    std::optional<double> stops{}; ///< of that
    /// Of the command with the worst result, the first of equals; a pair before an image.
    CasePictures worst{};
    CasePictures first{}; ///< of the first command that compares

    /// `warned`: the commands have told warnings, which the result so far does not have.
    void take(const PictureRequest& request, const FrameResult& so_far, bool warned);

private:
    std::pair<bool, Status> m_rank{false, Status::Passed};
};

} // namespace tonetool::sequence
