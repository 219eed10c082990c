// SPDX-License-Identifier: BSD-3-Clause
// Modifiers of tone curves, views and calibration, for all commands that have them.
#pragma once

#include <vector>

#include "chain/commands/commands.h"
#include "tonetool/tonemap.h"

namespace tonetool::chain {

/// The curve itself, as `key`; its help begins with `what`.
Modifier curve_modifier(const std::string& key, const std::string& what = "tone curve (aces)");
/// The parameters of all curves, coeffs=, on=, saturation=; with `white=max|pN` if `measured`, and
/// HDR-FLIP's defaults in the help if `flip`.
Modifiers curve_modifiers(bool measured, bool flip = false);
/// The curve that one of the modifiers `keys` names.
CurveOptions curve_options(const Call& call, const Strings& keys);

/// display=, view=, looks=, context=.
Modifiers view_modifiers();
/// nullopt where none of them is given.
std::optional<ViewOptions> view_options(const Session& session, const Call& call);
/// A view and a curve exclude each other: one of `keys` names the curve.
void check_one_way(const Call& call, const Strings& keys);

/// calibrate=, stops=, key=, level=, ...
CalibrationOptions calibration_options(const Call& call);
/// white=max or white=pN.
std::optional<double> white_percentile(const Call& call);

} // namespace tonetool::chain
