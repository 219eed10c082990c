// SPDX-License-Identifier: BSD-3-Clause
// Display light of a view: what its code values shine on the display, in Rec.709.
#include "imagebuf/color/view_light.h"

#include <algorithm>
#include <cmath>

#include "imagebuf/color/view_config.h"
#include "imagebuf/options/flip_options.h"
#include "imagebuf/pixels/colorimetry.h"
#include "imagebuf/pixels/guard.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

constexpr ptrdiff_t kPixelsAtOnce = 512;
// Display light of code value 1, above which a display is of high dynamic range: SDR is 1, HLG 10,
// PQ 100. OpenColorIO's displays have a luminance of 1 for 100 cd/m2.
constexpr double kSdrLight = 1.5, kReferenceWhite = 100;
constexpr const char* kReference = "tonetool display reference";

std::string encodings() {
    return OIIO::Strutil::join(kViewEncodings, ", ");
}

ocio::TransformRcPtr power(double exponent) {
    const auto transform = ocio::ExponentTransform::Create();
    const double values[4] = {exponent, exponent, exponent, 1};
    transform->setValue(values);
    transform->setNegativeStyle(ocio::NEGATIVE_MIRROR);
    return transform;
}

ocio::TransformRcPtr srgb_decoding() {
    const auto transform = ocio::ExponentWithLinearTransform::Create();
    const double gamma[4] = {2.4, 2.4, 2.4, 1}, offset[4] = {0.055, 0.055, 0.055, 0};
    transform->setGamma(gamma);
    transform->setOffset(offset);
    return transform;
}

// Code values to Rec.709 light; null for an unknown name.
ocio::TransformRcPtr decoding(const std::string& encoding) {
    if (encoding == "srgb")
        return srgb_decoding();
    if (encoding == "linear")
        return ocio::MatrixTransform::Create();
    return encoding == "rec1886"    ? power(2.4)
           : encoding == "gamma2.2" ? power(2.2)
           : encoding == "gamma2.6" ? power(2.6)
                                    : nullptr;
}

// From the display's code values to its reference, XYZ with D65 white.
ocio::TransformRcPtr to_display_reference(ChosenView& chosen) {
    const auto role = known_space(chosen, ocio::ROLE_INTERCHANGE_DISPLAY);
    const bool known = role && role->getReferenceSpaceType() == ocio::REFERENCE_SPACE_DISPLAY;
    if (!known) {
        const auto space = ocio::ColorSpace::Create(ocio::REFERENCE_SPACE_DISPLAY);
        space->setName(kReference);
        const ocio::ConfigRcPtr config = chosen.config->createEditableCopy();
        config->addColorSpace(space);
        chosen.config = config;
    }
    const auto transform = ocio::ColorSpaceTransform::Create();
    transform->setSrc(chosen.space.c_str());
    transform->setDst(known ? role->getName() : kReference);
    return transform;
}

void check_peak(const ChosenView& chosen, const ocio::TransformRcPtr& to_reference) {
    const auto processor = make_processor(chosen, to_reference);
    float white[3] = {1, 1, 1};
    processor->applyRGB(white);
    if (!(white[1] > 0 && double(white[1]) <= kSdrLight))
        throw Refusal(format(
            "display \"{}\" is of high dynamic range: its code value 1 is light of {:.5g} "
            "cd/m2, and HDR-FLIP compares light up to a white; pass peak=, the cd/m2 that "
            "count as 1 ({} to {}; 100 is the white of an SDR view), or choose an SDR view",
            chosen.display, double(white[1]) * kReferenceWhite, kPeakRange.low, kPeakRange.high));
}

// Appends what turns the view's code values into light.
void add_display(const DisplayLightOptions& options, ChosenView& chosen,
                 const ocio::GroupTransformRcPtr& group) {
    const double scale = options.peak ? kReferenceWhite / *options.peak : 1;
    if (!options.encoding.empty()) {
        const auto decode = decoding(options.encoding);
        if (!decode)
            throw Refusal("unknown encoding \"" + options.encoding + "\"; valid: " + encodings());
        group->appendTransform(decode);
        const Matrix3 same{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
        group->appendTransform(matrix_transform(same, scale));
        return;
    }
    if (!chosen.display_space)
        throw Refusal(
            format("view \"{}\" of display \"{}\" ends in \"{}\", a scene-referred colour "
                   "space, which does not say what light its code values are; pass encoding= "
                   "one of: {}",
                   chosen.view, chosen.display, chosen.space, encodings()));
    const auto to_reference = to_display_reference(chosen);
    if (!options.peak)
        check_peak(chosen, to_reference);
    group->appendTransform(to_reference);
    group->appendTransform(matrix_transform(xyz_to_rec709(), scale));
}

// Appends the view, from linear Rec.709.
void add_view(const ChosenView& chosen, const std::string& from,
              const ocio::GroupTransformRcPtr& group) {
    const SceneBridge bridge = find_bridge(chosen, from);
    if (bridge.space.empty())
        throw Refusal(
            format("configuration \"{}\" does not say which space is linear Rec.709: it needs a "
                   "scene-referred colour space with one of the names or aliases {}, or the "
                   "role {} (ACES2065-1) or {}; or pass from=, one of its spaces: {}",
                   chosen.file, OIIO::Strutil::join(interchange_names("rec709"), ", "),
                   ocio::ROLE_INTERCHANGE_SCENE, ocio::ROLE_INTERCHANGE_DISPLAY,
                   OIIO::Strutil::join(scene_spaces(chosen), ", ")));
    const auto to_bridge = matrix_transform(bridge.to_rec709, 1);
    to_bridge->setDirection(ocio::TRANSFORM_DIR_INVERSE);
    group->appendTransform(to_bridge);
    group->appendTransform(
        std::const_pointer_cast<ocio::Transform>(through_view(chosen, bridge.space)));
}

} // namespace

void DisplayLight::State::light(float* rgb, ptrdiff_t count) const {
    if (count <= 0)
        return;
    ocio::PackedImageDesc pixels(rgb, long(count), 1, 3);
    processor->apply(pixels);
}

void DisplayLight::open(const DisplayLightOptions& options) {
    const QuietOcio quiet;
    if (options.peak && !(*options.peak >= kPeakRange.low && *options.peak <= kPeakRange.high))
        throw Refusal(format("peak is {}: must be {} to {} cd/m2", *options.peak, kPeakRange.low,
                             kPeakRange.high));
    const auto group = ocio::GroupTransform::Create();
    ChosenView chosen = choose_view(options.view);
    add_view(chosen, options.from, group);
    add_display(options, chosen, group);
    const auto state = std::make_shared<State>();
    state->processor = make_processor(chosen, group);
    state->name = chosen.display + "/" + chosen.view;
    m_state = state;
}

std::string DisplayLight::name() const {
    return m_state->name;
}

LightSource DisplayLight::source() const {
    return [state = m_state](float* rgb, ptrdiff_t count) { state->light(rgb, count); };
}

kernels::ToneRows DisplayLight::exact() const {
    return [state = m_state](const float* const in[3], float* const out[3], ptrdiff_t count,
                             float scale) {
        float rgb[3 * kPixelsAtOnce];
        for (ptrdiff_t start = 0; start < count; start += kPixelsAtOnce) {
            const ptrdiff_t n = std::min(kPixelsAtOnce, count - start);
            for (ptrdiff_t i = 0; i < n; ++i)
                for (ptrdiff_t c = 0; c < 3; ++c)
                    rgb[3 * i + c] = std::min(in[c][start + i] * scale, kernels::kLargestExposed);
            state->light(rgb, n);
            // NaN becomes 0.
            for (ptrdiff_t i = 0; i < n; ++i)
                for (ptrdiff_t c = 0; c < 3; ++c)
                    out[c][start + i] = rgb[3 * i + c] > 0 ? std::min(rgb[3 * i + c], 1.0f) : 0.0f;
        }
    };
}

std::vector<double> DisplayLight::greys(const std::vector<double>& values) const {
    std::vector<float> rgb(3 * values.size());
    for (size_t i = 0; i < rgb.size(); ++i)
        rgb[i] = float(std::min(values[i / 3], double(kernels::kLargestExposed)));
    m_state->light(rgb.data(), ptrdiff_t(values.size()));
    std::vector<double> out(values.size());
    for (size_t i = 0; i < values.size(); ++i)
        for (size_t c = 0; c < 3; ++c)
            out[i] += kernels::kLuminance[c] * double(rgb[3 * i + c]);
    return out;
}

} // namespace tonetool
