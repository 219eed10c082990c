// SPDX-License-Identifier: BSD-3-Clause
// The G-buffer AOVs that guide CG-TMO: found in the image, in other parts of its file or in files
// of their own, and substitutes for those that are missing.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

#include "imagebuf/aov/gbuffer.h"
#include "imagebuf/pixels/paged_array.h"
#include "tonemap/local.h"
#include "tonetool/cgtmo.h"

namespace tonetool {

class LocalGuides {
public:
    /// `pixels` has those of the image, perhaps in memory; parts and files are found by the image.
    LocalGuides(const OIIO::ImageBuf& image, const OIIO::ImageBuf& pixels,
                const CgTmoOptions& options, OIIO::ROI region, int nthreads)
        : m_image(image),
          m_pixels(pixels),
          m_options(options),
          m_region(region),
          m_nthreads(nthreads) {}

    /// Fills in the footprint of `what`, and the luminance term if it is all that is left.
    void read(tonemap::LocalOperator& what, CgTmoSummary& summary);

    /// Planes of the region without a value; valid as long as this is.
    const kernels::GuidePlanes& view() const { return m_view; }

    /// There are positions, and not those that depth alone tells, which are the camera's own.
    bool positions_are_of_scene() const { return m_view.position[0] && !m_of_depth; }

    /// 1 where no surface is seen; null where no guide tells.
    const uint8_t* background() const {
        const bool tells = m_guides.has_position() || m_guides.has_normal() || m_guides.has_depth();
        return tells ? m_view.background : nullptr;
    }

private:
    GBufferNames find(const std::string& beauty) const;
    GBufferNames find_in_files(GuideOptions& asked) const;
    void find_in_parts(const GuideOptions& asked, GBufferNames& names) const;
    void stand_in(tonemap::LocalOperator& what, CgTmoSummary& summary);
    void position_of_depth(CgTmoSummary& summary);
    void show(const GBufferNames& names, CgTmoSummary& summary);
    void find_footprint(tonemap::LocalOperator& what, CgTmoSummary& summary);
    void camera_footprints();

    const OIIO::ImageBuf& m_image;
    const OIIO::ImageBuf& m_pixels;
    const CgTmoOptions& m_options;
    OIIO::ROI m_region;
    int m_nthreads;
    bool m_of_depth = false;
    GBuffer m_guides;
    PagedArray<float> m_footprints;
    kernels::GuidePlanes m_view;
};

} // namespace tonetool
