// SPDX-License-Identifier: BSD-3-Clause
// Displays and views of OpenColorIO configurations. Nothing but view*.cpp
// and lut*.cpp knows OpenColorIO.
#pragma once

#include <OpenImageIO/imageio.h>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "kernels/tone_curve.h"
#include "tonetool/tonemap.h"

namespace tonetool {

/// What a view does to the pixels of an image: from one of its scene-referred spaces to the
/// display's encoding.
class ViewTransform {
public:
    /// Chosen and checked; a Refusal lists what would be valid. `from` names a colour space (or
    /// alias or role) of the configuration; empty: that which `oiio:ColorSpace` names there, else
    /// the image's own under one of its known names. Chromaticities are believed over a tag that
    /// says only "Linear"; stock oiiotool 2.4.7 looks that word up in the configuration.
    void open(const ViewOptions& options, const std::string& from, const OIIO::ImageSpec& header);

    const std::string& display() const { return m_display; }
    const std::string& view() const { return m_view; }
    const std::string& from() const { return m_from; }   ///< as the configuration calls it
    const std::string& space() const { return m_space; } ///< colour space of the result
    /// Packed RGB in place; several threads may call.
    void apply(float* rgb, ptrdiff_t count) const;

private:
    struct State;
    std::shared_ptr<const State> m_state;
    std::string m_display, m_view, m_from, m_space;
};

/// The configuration that a view is of: its own, else that of the environment variable OCIO.
std::string config_file(const ViewOptions& options);

/// What HDR-FLIP needs to know of a view to look through it.
struct DisplayLightOptions {
    ViewOptions view;
    /// Of the view's output, where the display has no colour space that says: "srgb", "rec1886",
    /// "gamma2.2", "gamma2.6", "linear"; empty: the display's own colour space.
    std::string encoding;
    /// Display light in cd/m2 that counts as 1. Displays of high dynamic range are refused without.
    std::optional<double> peak;
    /// The configuration's space that images are said to be in, which only configurations need that
    /// do not say what their light is.
    std::string from{};
};

/// Turns scene light into display light: packed RGB in place, nothing clamped.
using LightSource = std::function<void(float* rgb, ptrdiff_t count)>;

/// A view from linear Rec.709 scene light to linear Rec.709 display light, 1 the display's white.
class DisplayLight {
public:
    void open(const DisplayLightOptions& options);

    std::string name() const; ///< "display/view"
    LightSource source() const;
    /// Through OpenColorIO's processor.
    kernels::ToneRows exact() const;
    /// Through a baked table, which is made by the first call (0.1 s): a cube behind a shaper,
    /// read tetrahedrally.
    kernels::ToneRows baked() const;
    /// Luminance of the display light of greys, unclamped.
    std::vector<double> greys(const std::vector<double>& values) const;

private:
    struct State;
    std::shared_ptr<const State> m_state;
};

} // namespace tonetool
