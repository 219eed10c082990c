// SPDX-License-Identifier: BSD-3-Clause
// The modifiers of the commands that compare, and the library's options made from them.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "chain/commands/commands.h"
#include "metrics/errors.h"
#include "tonetool/tonetool.h"

namespace tonetool::chain {

/// When a quantity of the summary fails or warns.
struct Limit {
    std::string quantity;
    std::optional<double> fail, warn;
    bool automatic = false; ///< fail=auto: it follows from all frames of the shot
};
/// Of different quantities: all must hold.
using Limits = std::vector<Limit>;

/// Between which values a quantity lies; a limit that no value can miss is an error.
struct Scale {
    double low = 0, high = 1;
};

/// What fail= and warn= may be of.
struct Measures {
    Strings names = ToneAlgo::flip_quantities(); ///< the first is the default
    bool map = true;                             ///< and pNN and above of an error map
    std::function<Scale(const std::string& quantity)> scale = [](const std::string&) {
        return Scale();
    };
};

// Lists of modifiers, to be put together into rows.
extern const Modifier kPrint;
Modifiers pixel_modifiers(); ///< layer, from
Modifiers pair_modifiers();  ///< and resize, crop, alpha, mask, ignore
Modifiers hdr_modifiers();   ///< tone curve and exposures
/// fail, warn, quantity, print, and above where there is a map; `unless` says what keeps from
/// failing.
Modifiers threshold_modifiers(const Measures& measures = {},
                              const std::string& unless = "at most X (0 to 1)");

/// layer and from, or "ldrlayer" and "ldrfrom" with the prefix "ldr".
PixelOptions pixel_options(const Call& call, const std::string& prefix = "");
/// `from` may name spaces of the view's configuration.
void read_view_spaces(const std::optional<ViewOptions>& view, PixelOptions& pixels);
/// resize= and crop=.
SizePolicy size_policy(const Call& call);
/// What --memory leaves beside the images that a report holds.
uint64_t memory_for(const Session& session, const Call& call);
/// mask= and ignore=.
void read_ignored(const Call& call, IgnoreOptions& options);
void read_pair_options(const Session& session, const Call& call, PairOptions& options);
/// `screen`: distance, width and pixels describe the screen; else only ppd does.
void read_flip_options(const Session& session, const Call& call, bool screen, FlipOptions& options);
void read_hdr_options(const Session& session, const Call& call, HdrFlipOptions& options);
/// fail= and warn=: a number, quantity=number with commas between them, or the file of
/// --noisefloor. What has to be pooled
/// for them is added to `pooled`.
Limits limits_of(Session& session, const Call& call, const Measures& measures, Strings& pooled);
Modifiers error_modifiers();
/// Errors that have no bound may have any limit.
Measures error_measures(const metrics::ErrorMetric& metric);
ErrorOptions error_options(const Session& session, const Call& call);

/// OpenImageIO 3.2's names and defaults.
Modifiers flipdiff_modifiers();
HdrFlipOptions flipdiff_options(const Session& session, const Call& call);

} // namespace tonetool::chain
