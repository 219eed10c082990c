// SPDX-License-Identifier: BSD-3-Clause
// The pair of a request as people look at it: at one exposure, 8 bits, sRGB-encoded.
#pragma once

#include <OpenImageIO/imagebuf.h>

#include "sequence/report/reduced.h"
#include "sequence/report/report_pictures.h"

namespace tonetool::sequence {

class ShownPair {
public:
    explicit ShownPair(const PictureRequest& request, int nthreads = 0);

    /// Three channels of a region, as they are stored.
    struct Linear {
        OIIO::ImageBuf reference, test;
    };
    struct Shown {
        OIIO::ImageBuf reference, test; ///< 8 bits, sRGB-encoded
    };

    /// The region of the error map, else of the test.
    const OIIO::ROI& whole() const { return m_whole; }
    int orientation() const { return m_orientation; } ///< of both images

    Linear read(const OIIO::ROI& region, const PixelSize& side) const;
    /// The region of this image that corresponds to `region` of the whole: where the test was
    /// resized for the comparison, the whole test corresponds to the whole reference.
    OIIO::ROI region_of(const OIIO::ImageBuf& image, const OIIO::ROI& region) const;

    /// The middle of the exposures that were compared, else of the image's own.
    double middle_exposure(const Linear& linear) const;
    /// The exposure of the largest error at this pixel.
    double stops_at(const Position& at, double otherwise) const;

    /// The pair as it is compared at one exposure. Throws a runtime_error.
    Shown show(const Linear& linear, double stops) const;
    /// The same of a region in full size; pixels that are not finite are magenta.
    Shown show_region(const OIIO::ROI& region, double stops) const;
    /// That region of the error map in magma.
    OIIO::ImageBuf colored_error(const OIIO::ROI& region) const;

private:
    OIIO::ImageBuf displayed(const OIIO::ImageBuf& linear) const;

    const PictureRequest& m_request;
    int m_nthreads;
    HdrFlipOptions m_look;
    OIIO::ROI m_whole;
    int m_orientation;
};

} // namespace tonetool::sequence
