// The modifiers of the commands that compare, and the library's options made from them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "include/tonetool/tonetool.h"
#include "measure/commands.h"

namespace tonetool::measure {

/// When a quantity of the summary fails or warns.
struct Thresholds {
    std::string quantity = "mean";
    std::optional<double> fail, warn;
};

// Lists of modifiers, to be put together into rows.
std::vector<Modifier> pixel_modifiers();   ///< layer, from
std::vector<Modifier> pair_modifiers();    ///< and resize, crop, alpha
std::vector<Modifier> viewing_modifiers(); ///< ppd, distance, width, pixels
std::vector<Modifier> hdr_modifiers();     ///< tone curve and exposures
/// fail, warn, quantity, print; `unless` says what keeps from failing.
std::vector<Modifier> threshold_modifiers(const Strings& quantities = ToneAlgo::flip_quantities(),
                                          const std::string& unless = "at most X (0 to 1)");
std::vector<Modifier> concatenated(const std::vector<std::vector<Modifier>>& lists);

/// layer and from, or "ldrlayer" and "ldrfrom" with the prefix "ldr".
PixelOptions pixel_options(const Call& call, const std::string& prefix = "");
void read_pair_options(const Session& session, const Call& call, PairOptions& options);
/// `screen`: distance, width and pixels describe the screen; else only ppd does.
void read_flip_options(const Session& session, const Call& call, bool screen, FlipOptions& options);
void read_hdr_options(const Session& session, const Call& call, HdrFlipOptions& options);
/// Quantities, of which the first is the default, and limits of another measure than FLIP.
Thresholds thresholds_of(const Call& call, const Strings& quantities = ToneAlgo::flip_quantities(),
                         Range range = {0, 1});
std::vector<Modifier> error_modifiers();
ErrorOptions error_options(const Session& session, const Call& call);

/// OpenImageIO 3.2's names and defaults.
std::vector<Modifier> flipdiff_modifiers();
HdrFlipOptions flipdiff_options(const Session& session, const Call& call);

} // namespace tonetool::measure
