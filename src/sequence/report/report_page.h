// SPDX-License-Identifier: BSD-3-Clause
// The report: one HTML file that holds everything it shows and can load nothing.
#pragma once

#include <cstddef>
#include <string>

#include "sequence/report/report_store.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// Bounds of the page's size: thumbnails are included first, then pictures and maps, then pictures
/// of the full size, then numbers of all pixels, each from the worst frame on, as long as they fit.
/// The page says how many it holds.
struct PageLimits {
    size_t small_bytes = size_t(20) << 20; ///< size of all thumbnails
    size_t bytes = size_t(50) << 20;       ///< size of the page
    std::string json;                      ///< the file of --json, for --approve
    size_t detailed_frames = 2000; ///< in larger shots frames without full images have no histogram
};

/// The text of the page. The same shot and images give the same bytes.
std::string report_page(const ShotResult& shot, const PictureStore& pictures,
                        const PageLimits& limits = {});

} // namespace tonetool::sequence
