// SPDX-License-Identifier: BSD-3-Clause
// The curve or view that a look-up table is made of. Only lut*.cpp include this.
#pragma once

#include <OpenImageIO/imageio.h>
#include <string>

#include "imagebuf/color/curve_plan.h"
#include "imagebuf/color/tone_rows.h"
#include "imagebuf/color/view.h"
#include "tonetool/lut.h"

namespace tonetool {

class LutSource {
public:
    enum class Structure {
        Channel,   ///< a function of each channel
        Matrices,  ///< one between two matrices
        Luminance, ///< one of luminance, which leaves chromaticities
        Neutral,   ///< of the hue, the least and the largest channel
        Other
    };
    void open(const LutOptions& options);

    Structure structure() const { return m_structure; }
    /// Scene light to code values, packed RGB in place. Negative components count as 0.
    void exact(float* rgb, ptrdiff_t count) const;
    /// What is done to one channel, or to luminance: display light, neither clamped nor encoded.
    double inner(int channel, double x) const;
    /// Display light of one channel, clamped and encoded.
    double encoded(double light) const;

    const CurvePlan& curve() const { return m_curve; }
    const std::string& name() const { return m_name; }
    const std::string& input() const { return m_input; }
    const std::string& output() const { return m_output; }
    const std::string& encode() const { return m_encode; }

private:
    void open_curve(const LutOptions& options);
    void open_view(const LutOptions& options);

    Structure m_structure = Structure::Other;
    CurvePlan m_curve;
    bool m_is_view = false;
    ViewTransform m_view;
    Encoding m_encoding = nullptr;
    std::string m_name, m_input, m_output, m_encode;
};

} // namespace tonetool
