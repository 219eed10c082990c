// SPDX-License-Identifier: BSD-3-Clause
// The colour tags of file headers: reading them, and keeping them true after a conversion.
#pragma once

#include <OpenImageIO/imageio.h>
#include <optional>
#include <string>

#include "tonetool/export.h"

namespace tonetool {

/// The exponent that a header says its values are to be raised to (`oiio:Gamma` of a PNG file with
/// a gAMA chunk and no sRGB chunk, or the tag "GammaCorrected1.8"); 0 where it says none, or where
/// `oiio:ColorSpace` says what the values are.
TONETOOL_API double stated_gamma(const OIIO::ImageSpec& spec);

/// The factor that the values of a Radiance file were multiplied by (`hdr:exposure`), 1 where the
/// header does not say.
TONETOOL_API double stated_exposure(const OIIO::ImageSpec& spec);

/// OpenImageIO keeps the last EXPOSURE line of a Radiance file: where it has one, this makes
/// `hdr:exposure` the product of all in the header of the file.
TONETOOL_API void take_whole_exposure(OIIO::ImageSpec& spec, const std::string& filename);

/// The description of the ICC profile of an image whose colour this library does not read as the
/// profile says: any but one of sRGB's primaries and curve. Nothing if there is none.
TONETOOL_API std::optional<std::string> unapplied_profile(const OIIO::ImageSpec& spec);

/// Tags values that have a new encoding: removes the attributes of the old one (profile, gamma,
/// exposure, `colorInteropID`, and chromaticities unless the primaries are still the same) and sets
/// `oiio:ColorSpace` to `tag`.
TONETOOL_API void retag(OIIO::ImageSpec& spec, const std::string& tag, bool same_primaries = false);
/// Removes those of these attributes that belong to encoded values and not to light: the ICC
/// profile and the gamma.
TONETOOL_API void drop_profile(OIIO::ImageSpec& spec);

/// Sets the `chromaticities` to those of the linear space that `oiio:ColorSpace` names, and removes
/// them where it names an encoding. A `colorInteropID` of another space is removed.
TONETOOL_API void state_chromaticities(OIIO::ImageSpec& spec);

/// The attribute of an image of floats that holds the data type of the file behind it: integers are
/// read as sRGB, and their colour is decoded before it is multiplied by alpha.
inline constexpr const char* kStoredType = "tonetool:stored";

} // namespace tonetool
