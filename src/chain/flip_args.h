// The modifiers of the FLIP commands, and the library's options made from them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chain/call.h"
#include "chain/session.h"
#include "include/tonetool/tonetool.h"

namespace tonetool::chain {

/// When a quantity of the summary fails or warns.
struct Thresholds {
    std::string quantity = "mean";
    std::optional<double> fail, warn;
};

// Lists of modifiers, to be put together into rows.
std::vector<Modifier> pixel_modifiers();     ///< layer, from
std::vector<Modifier> pair_modifiers();      ///< and resize, crop, alpha
std::vector<Modifier> viewing_modifiers();   ///< ppd, distance, width, pixels
std::vector<Modifier> hdr_modifiers();       ///< tone curve and exposures
std::vector<Modifier> threshold_modifiers(); ///< fail, warn, quantity, print
std::vector<Modifier> concatenated(const std::vector<std::vector<Modifier>>& lists);

PixelOptions pixel_options(const Call& call);
/// `screen`: distance, width and pixels describe the screen; else only ppd does.
void read_flip_options(const Call& call, bool screen, FlipOptions& options);
void read_hdr_options(const Session& session, const Call& call, HdrFlipOptions& options);
Thresholds thresholds_of(const Call& call);

/// OpenImageIO 3.2's names and defaults.
std::vector<Modifier> flipdiff_modifiers();
HdrFlipOptions flipdiff_options(const Call& call);

} // namespace tonetool::chain
