// SPDX-License-Identifier: BSD-3-Clause
// How many pixels the objects of a layer of IDs have.
#pragma once

#include <cstdint>
#include <map>

#include "metrics/fault_scan.h"

namespace tonetool::metrics {

class ObjectScan {
public:
    struct Object {
        int64_t pixels = 0;
        bool at_border = false; ///< one of them is near the left or the right border
    };

    /// `border`: the pixels at the left and at the right that are near it.
    void add_row(const ChannelRow& row, int channel, int64_t border);
    void add(const ObjectScan& later);

    /// By the bits of their IDs; 0, which is nothing, and -0 are not there.
    const std::map<uint32_t, Object>& objects() const { return m_objects; }

private:
    std::map<uint32_t, Object> m_objects;
};

} // namespace tonetool::metrics
