// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/object_scan.h"

#include <cstring>

namespace tonetool::metrics {

void ObjectScan::add_row(const ChannelRow& row, int channel, int64_t border) {
    constexpr uint32_t sign = 0x80000000U;
    uint32_t last = 0;
    Object* object = nullptr;
    for (int64_t x = 0; row.pixels && x < row.width; ++x) {
        uint32_t id = 0;
        std::memcpy(&id, row.pixels + x * row.stride + channel, sizeof id);
        if ((id & ~sign) == 0)
            continue;
        if (!object || id != last)
            object = &m_objects[id];
        last = id;
        ++object->pixels;
        object->at_border = object->at_border || x < border || x >= row.width - border;
    }
}

void ObjectScan::add(const ObjectScan& later) {
    for (const auto& [id, object] : later.m_objects) {
        Object& to = m_objects[id];
        to.pixels += object.pixels;
        to.at_border = to.at_border || object.at_border;
    }
}

} // namespace tonetool::metrics
