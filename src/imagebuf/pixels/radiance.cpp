// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/radiance.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <cmath>

#include "tonetool/color_tags.h"

namespace tonetool {
namespace {

// Headers are a few lines; one that is longer holds a history of commands.
constexpr size_t kMostHeader = size_t(1) << 16;
constexpr const char* kExposure = "hdr:exposure";

} // namespace

std::optional<double> radiance_exposure(const std::string& text) {
    if (!OIIO::Strutil::starts_with(text, "#?"))
        return std::nullopt;
    constexpr const char* key = "EXPOSURE=";
    std::optional<double> product;
    for (const auto& line : OIIO::Strutil::splitsv(text, "\n")) {
        if (OIIO::Strutil::strip(line).empty())
            break;
        if (!OIIO::Strutil::starts_with(line, key))
            continue;
        const double factor = OIIO::Strutil::stod(line.substr(std::string(key).size()));
        if (std::isfinite(factor) && factor > 0)
            product = product.value_or(1) * factor;
    }
    return product;
}

void take_whole_exposure(OIIO::ImageSpec& spec, const std::string& filename) {
    if (!spec.find_attribute(kExposure) || !OIIO::Filesystem::is_regular(filename))
        return;
    std::string head(kMostHeader, '\0');
    head.resize(OIIO::Filesystem::read_bytes(filename, head.data(), head.size()));
    if (const auto exposure = radiance_exposure(head))
        spec.attribute(kExposure, float(*exposure));
}

} // namespace tonetool
