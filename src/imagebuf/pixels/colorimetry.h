// SPDX-License-Identifier: BSD-3-Clause
// From the colour space an image is stored in to linear Rec.709 with its D65 white.
#pragma once

#include <OpenImageIO/imageio.h>
#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "tonetool/color_tags.h"
#include "tonetool/pixels.h"

namespace tonetool {

using Matrix3 = std::array<std::array<double, 3>, 3>;

/// CIE xy of red, green, blue, white.
struct Chromaticities {
    double red[2], green[2], blue[2], white[2];
};

struct ColorSpace {
    std::string name;          ///< as printed: "rec709", "acescg", "chromaticities", "srgb", ...
    bool srgb_encoded = false; ///< values pass the sRGB curve first
    bool is_rec709 = true;     ///< the matrix is the identity and need not be applied
    Matrix3 to_rec709{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    double gamma = 0; ///< values are raised to this power first; 0: they are not
    double scale = 1; ///< light of the value 1, when it is decoded: 1/EXPOSURE of Radiance files
    /// The values were multiplied by alpha after they were encoded, as 8 and 16 bit files are read.
    bool straight = false;
    /// The power of alpha that they were multiplied by: OpenImageIO's readers take the file's
    /// gamma.
    double alpha_power = 1;
    /// Packed RGB to linear Rec.709 in place, of a configuration's space, instead of all the above
    /// but the scale.
    std::function<void(float* rgb, ptrdiff_t count)> convert{};

    bool encoded() const { return srgb_encoded || gamma > 0; }
    /// The light of a value of a pixel of this alpha, in the space's own primaries.
    double light(double value, double alpha) const;
};

/// The space of an image: `from` if given, else its `chromaticities`, else its `oiio:ColorSpace`,
/// else sRGB for integer pixels and linear Rec.709 for others. Unknown names, unusable
/// chromaticities and tags that contradict each other are errors.
ColorSpace find_space(const OIIO::ImageSpec& spec, const std::string& from);

/// Whether a tag of `oiio:ColorSpace` says no more than "not encoded".
bool says_only_linear(const std::string& tag);

/// Names and aliases under which configurations of OpenColorIO have the space that find_space()
/// calls `name`, likeliest first; none that another space bears in some of them.
std::vector<std::string> interchange_names(const std::string& name);
/// Names of the spaces that are known and not encoded.
std::vector<std::string> linear_spaces();
/// Whether it is one of these names of any space.
bool is_interchange_name(const std::string& name);

/// The matrix of a space that find_space() knows by this name.
Matrix3 known_to_rec709(const std::string& name);
/// CIE XYZ, D65 white, to linear Rec.709.
Matrix3 xyz_to_rec709();

/// Linear RGB of these primaries to linear Rec.709; a white other than D65 is adapted (Bradford),
/// but for CIE XYZ, whose values are those of the light itself. False if the primaries do not span
/// a colour space.
bool matrix_to_rec709(const Chromaticities& primaries, Matrix3& matrix);

/// sRGB decoding (IEC 61966-2-1), continued beyond 1 and, as its linear part, below 0.
double srgb_to_linear(double v);
/// The inverse.
double linear_to_srgb(double v);

} // namespace tonetool
