// The report: one HTML file that holds everything it shows and can load nothing.
#pragma once

#include <cstddef>
#include <string>

#include "sequence/report/report_store.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// What the page may weigh: thumbnails first, then full pictures, each of the worst frames first,
/// as long as they fit. The page says how many there are.
struct PageLimits {
    size_t small_bytes = size_t(20) << 20; ///< of all thumbnails
    size_t bytes = size_t(50) << 20;       ///< of all pictures
    size_t detailed_frames = 2000; ///< beyond, frames without full pictures have no histogram
};

/// The text of the page. The same shot and pictures give the same bytes.
std::string report_page(const ShotResult& shot, const PictureStore& pictures,
                        const PageLimits& limits = {});

} // namespace tonetool::sequence
