// SPDX-License-Identifier: BSD-3-Clause
// What attribute() finds: plain numbers, no images.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tonetool {

/// What stands beside the names of light groups for the light that is in none of them.
inline constexpr const char* kLightRest = "(rest)";
/// What stands beside the names of objects where there is none, or beyond the last one stored.
inline constexpr const char* kMatteNone = "(none)";

/// A light group, and how the error changes with it.
struct AttributedLight {
    std::string name;         ///< "key" of "ViewLayer.Combined_key", or kLightRest
    double mean_replaced = 0; ///< mean error of the test with the reference's light in this group
    double explains = 0;      ///< the part of the mean error that this takes away; noise has some
    /// Mean error of the reference with the test's light in this group.
    std::optional<double> mean_alone;
    /// Its light in the test, as a factor of that in the reference, and the standard error of this.
    /// None: of the rest, and of a group without light in the reference.
    std::optional<double> gain, gain_error;
    std::string finding; ///< "off", "weaker", "stronger", "new", or ""
};

/// An object or a material of a Cryptomatte. With a and b its coverage of a pixel in the reference
/// and the test, w = (a + b) / 2 and E the error:
struct AttributedMatte {
    std::string name;                             ///< of the manifest, "<0f3c9a21>" or kMatteNone
    double pixels_reference = 0, pixels_test = 0; ///< sums of a and b
    double mass = 0;                              ///< sum w E / sum E: all of a type add up to 1
    double mean = 0;                              ///< sum w E / sum w
    double cover = 0;                             ///< sum |b - a| / sum (a + b)
    double gained = 0, lost = 0;                  ///< sums of b - a above and below 0
    std::optional<std::array<double, 2>> shift;   ///< of its centroid, in pixels
    /// Red, green and blue of the test as factors of those of the reference, where both cover, and
    /// their standard errors. Light groups with a finding count as the reference has them. NaN
    /// where the reference is black.
    std::array<double, 3> gain{}, gain_error{};
    int64_t changed = 0; ///< pixels with |b - a| of 0.5 or more, which noise does nowhere
    /// "missing", "new", "replaced by NAME", "replaces NAME", "moved or reshaped", "larger",
    /// "smaller", "uncovered or hidden" by what has such a finding, "other colour", or "".
    std::string finding;
};

/// The objects, materials or assets of one Cryptomatte: findings first, then the largest mass.
struct AttributedType {
    std::string type; ///< "ViewLayer.CryptoObject"
    std::vector<AttributedMatte> mattes;
};

/// Another layer that both have.
struct AttributedLayer {
    std::string name;
    std::string kind;               ///< "depth", "position", "normal", "id", "albedo", "color"
    std::string unit;               ///< of `mean` and `max`
    double mean = 0;                ///< of the differences, where both have a surface
    double max = 0;                 ///< the largest
    int64_t changed = 0;            ///< pixels beyond the limit of the kind; of colours none
    int64_t background_changed = 0; ///< of them those with a surface in only one image
    std::optional<double> gain, gain_error; ///< of colours, as of a light
    /// Objects with the largest shares of the changed pixels, two at most.
    std::vector<std::pair<std::string, double>> most_under;
    std::string finding; ///< "changed", of colours as of a light, or ""
};

/// Names that only one side's manifest has: what is gone or new, even out of sight.
struct AttributedManifest {
    std::string type;
    std::vector<std::string> reference, test;
};

/// Where the error of a pair lies. Tables have their findings first.
struct AttributeResult {
    double mean = 0; ///< of the error
    std::vector<AttributedLight> lights;
    std::vector<AttributedType> mattes;
    std::vector<AttributedLayer> layers;
    std::vector<AttributedManifest> manifest_only;
    std::vector<std::string> warnings; ///< what could not be told and why, a sentence each
};

} // namespace tonetool
