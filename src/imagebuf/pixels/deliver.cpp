// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/deliver.h"

#include <utility>

namespace tonetool {

using OIIO::ImageBuf;

bool takes_map(const ImageBuf& dst, const OIIO::ROI& roi) {
    return dst.initialized() && dst.nchannels() == 1 && dst.pixeltype() == OIIO::TypeFloat &&
           dst.localpixels() && dst.roi().contains(roi);
}

void deliver(ImageBuf& dst, ImageBuf&& map, const std::string& prefix) {
    if (!takes_map(dst, map.roi())) {
        dst = std::move(map);
        return;
    }
    if (map.localpixels() != dst.pixeladdr(map.xbegin(), map.ybegin()))
        dst.set_pixels(map.roi(), OIIO::TypeFloat, map.localpixels());
    OIIO::ImageSpec& spec = dst.specmod();
    spec.erase_attribute(prefix + ".*");
    for (const auto& attribute : map.spec().extra_attribs)
        if (attribute.name().find(prefix) == 0)
            spec.attribute(attribute.name(), attribute.type(), attribute.data());
}

} // namespace tonetool
