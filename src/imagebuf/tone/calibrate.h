// SPDX-License-Identifier: BSD-3-Clause
// Calibration of images: statistics to exposures.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <memory>
#include <string>
#include <vector>

#include "imagebuf/pixels/planes.h"
#include "tonemap/calibration.h"
#include "tonetool/tonemap.h"

namespace tonetool {

/// What an image's colour is to be multiplied by.
class Calibration {
public:
    /// Checks the options, measures where that is needed.
    void make(const OIIO::ImageBuf& image, const PixelOptions& pixels,
              const CalibrationOptions& options, int nthreads);

    const CalibrationSummary& summary() const { return m_summary; }
    /// One factor for all pixels.
    bool uniform() const { return m_means == nullptr; }
    float factor() const { return m_factor; }
    /// Factors of the pixels [xbegin, xend) of a row of the image.
    void row(int y, int xbegin, int xend, float* out) const;
    /// What options.show asks for, in their place.
    void shown_row(int y, int xbegin, int xend, float* out) const;

private:
    void measure(const OIIO::ImageBuf& image, const PixelOptions& pixels, int nthreads);
    void take_shot();
    void expose(double mean);
    void expose_by_camera(const OIIO::ImageSpec& spec);
    bool by_mean() const {
        return m_options.method == CalibrationMethod::Mean ||
               m_options.method == CalibrationMethod::AutoKey;
    }
    double key_of(double mean) const;
    double factor_of(double mean) const;
    void means_row(int y, int xbegin, int xend, double* out) const;
    double cells_of(const float* plane, int nthreads) const;
    double keep_lit(const OIIO::ImageBuf& image, const ColorPlanes& planes,
                    std::vector<float>& luminance, int nthreads) const;
    void find_white(std::vector<float>& luminance, int nthreads);

    CalibrationOptions m_options;
    CalibrationSummary m_summary;
    OIIO::ROI m_region;
    float m_factor = 1;
    std::unique_ptr<tonemap::LocalMeans> m_means;
};

} // namespace tonetool
