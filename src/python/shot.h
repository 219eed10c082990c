// SPDX-License-Identifier: BSD-3-Clause
// The options of shots, which tone mapping takes, too.
#pragma once

#include "python/results.h"
#include "tonetool/shot_numbers.h"

namespace tonetool::python {

template <>
const Table<AdaptOptions>& table_of<AdaptOptions>();
template <>
struct Python<AdaptOptions> : PythonStruct<AdaptOptions> {};

/// Statistics, or the frames alone.
template <>
struct Python<ShotStatistics> {
    static std::string wanted() { return "ShotStatistics | Sequence[FrameLight]"; }
    static std::string given() { return "ShotStatistics"; }
    static ShotStatistics from(py::handle v, const std::string& where) {
        if (py::isinstance<ShotStatistics>(v))
            return v.cast<ShotStatistics>();
        return {"shot", Python<std::vector<FrameLight>>::from(v, where)};
    }
    static py::object to(const ShotStatistics& v) { return py::cast(v); }
};

} // namespace tonetool::python
