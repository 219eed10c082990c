// SPDX-License-Identifier: BSD-3-Clause
// Configurations of OpenColorIO, written into a test's own folder.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <string>

#include "files.h"

namespace tonetool {

inline std::string write_text(const std::string& name, const std::string& text) {
    EXPECT_TRUE(OIIO::Filesystem::write_text_file(name, text));
    return name;
}

/// Made of built-in transforms: SDR and HDR displays, a look, a file named by a variable.
inline const char* const kConfig = R"(ocio_profile_version: 2.1
environment: {LUT: none.spi1d}
search_path: "."
roles: {aces_interchange: AP0, cie_xyz_d65_interchange: XYZ, default: AP0, scene_linear: AP1}
shared_views:
  - !<View> {name: SDR, view_transform: SDR, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: HDR 1000, view_transform: HDR 1000, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Plain, view_transform: Plain, display_colorspace: <USE_DISPLAY_NAME>}
  - !<View> {name: Warm, view_transform: Plain, display_colorspace: <USE_DISPLAY_NAME>, looks: warm}
displays:
  sRGB:
    - !<View> {name: Raw, colorspace: Raw}
    - !<View> {name: Film, colorspace: Film}
    - !<View> {name: Lost, colorspace: Nowhere}
    - !<Views> [SDR, Plain, Warm]
  Rec.1886: [!<Views> [SDR, Plain]]
  PQ: [!<Views> [HDR 1000]]
active_displays: [sRGB, Rec.1886, PQ]
active_views: [SDR, Film, Plain, HDR 1000]
looks:
  - !<Look> {name: warm, process_space: AP1, transform: !<CDLTransform> {slope: [1.25, 1, 0.8]}}
  - !<Look> {name: dim, process_space: AP1, transform: !<CDLTransform> {slope: [0.5, 0.5, 0.5]}}
view_transforms:
  - !<ViewTransform> {name: Plain, from_scene_reference: !<BuiltinTransform> {style: UTILITY - ACES-AP0_to_CIE-XYZ-D65_BFD}}
  - !<ViewTransform> {name: SDR, from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - SDR-VIDEO_1.0}}
  - !<ViewTransform> {name: HDR 1000, from_scene_reference: !<BuiltinTransform> {style: ACES-OUTPUT - ACES2065-1_to_CIE-XYZ-D65 - HDR-VIDEO-1000nit-15nit-REC2020lim_1.1}}
display_colorspaces:
  - !<ColorSpace> {name: XYZ}
  - !<ColorSpace> {name: sRGB, from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_sRGB}}
  - !<ColorSpace> {name: Rec.1886, from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.1886-REC.709}}
  - !<ColorSpace> {name: PQ, from_display_reference: !<BuiltinTransform> {style: DISPLAY - CIE-XYZ-D65_to_REC.2100-PQ}}
colorspaces:
  - !<ColorSpace> {name: AP0, aliases: [lin_ap0]}
  - !<ColorSpace> {name: AP1, aliases: [acescg, Linear], to_scene_reference: !<BuiltinTransform> {style: ACEScg_to_ACES2065-1}}
  - !<ColorSpace> {name: Raw, isdata: true}
  - !<ColorSpace> {name: Film, from_scene_reference: !<FileTransform> {src: "${LUT}"}}
)";

/// Of the first version, without view transforms: views end in scene-referred spaces.
inline const char* const kOldConfig = R"(ocio_profile_version: 1
search_path: "."
roles: {default: lin, reference: lin}
displays:
  screen:
    - !<View> {name: Film, colorspace: gamma22}
colorspaces:
  - !<ColorSpace> {name: lin, aliases: []}
  - !<ColorSpace> {name: lin_srgb}
  - !<ColorSpace>
    name: gamma22
    from_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1], direction: inverse}
)";

/// A table of one channel that multiplies by `factor`.
inline std::string lut_text(const std::string& factor) {
    return "Version 1\nFrom 0.0 1.0\nLength 2\nComponents 1\n{\n0.0\n" + factor + "\n}\n";
}

} // namespace tonetool
