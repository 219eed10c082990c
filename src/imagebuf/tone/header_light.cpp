// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/header_light.h"

#include <OpenImageIO/strutil.h>
#include <cmath>

#include "imagebuf/options/camera_options.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

double value_of(const OIIO::ParamValue& found) {
    double value = double(found.get_float());
    if (found.type() == OIIO::TypeRational) {
        const int* parts = static_cast<const int*>(found.data());
        value = parts[1] != 0 ? double(parts[0]) / parts[1] : 0;
    }
    return std::isfinite(value) && value > 0 ? value : 0;
}

double setting(const char* name, std::optional<double> given, const OIIO::ImageSpec& spec,
               const char* title, std::initializer_list<const char*> names) {
    if (given)
        return *given;
    if (const double found = header_number(spec, names); found > 0)
        return found;
    for (const char* header : names)
        if (const OIIO::ParamValue* wrong = spec.find_attribute(header))
            throw Refusal(format("method=camera: the header's {} is {}: must be above 0 (valid: "
                                 "{}=X)",
                                 title, wrong->get_string(), name));
    throw Refusal(format("method=camera: the header has no {} (valid: {}=X)", title, name));
}

} // namespace

double header_number(const OIIO::ImageSpec& spec, std::initializer_list<const char*> names) {
    for (const char* name : names)
        if (const OIIO::ParamValue* found = spec.find_attribute(name))
            if (const double value = value_of(*found); value > 0)
                return value;
    return 0;
}

double header_unit(const OIIO::ImageSpec& spec) {
    return header_number(spec, {"whiteLuminance"});
}

double unit_or_1(std::optional<double> given, double of_header, std::vector<std::string>& notes) {
    if (given)
        return *given;
    if (!(of_header > 0))
        notes.emplace_back(
            "no header says whiteLuminance above 0: a pixel value of 1 is taken for 1 cd/m2 "
            "(unit= says what it is)");
    return of_header > 0 ? of_header : 1;
}

// The names are OpenEXR's, which OpenImageIO reads as those of other formats, and those of Exif.
tonemap::CameraSettings camera_settings(const CameraOptions& options, const OIIO::ImageSpec& spec) {
    return {setting("fnumber", options.fnumber, spec, "aperture", {"FNumber", "aperture"}),
            setting("shutter", options.shutter, spec, "expTime", {"ExposureTime", "expTime"}),
            setting("iso", options.iso, spec, "isoSpeed",
                    {"isoSpeed", "Exif:PhotographicSensitivity", "Exif:ISOSpeedRatings"})};
}

void refuse_camera(const CameraOptions& options, const std::string& method) {
    describe(options, [&](const auto& row) {
        if (options.*row.member)
            throw Refusal(format("{} is of method=camera, and this is method={}", row.key, method));
    });
}

} // namespace tonetool
