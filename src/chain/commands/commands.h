// SPDX-License-Identifier: BSD-3-Clause
// The families of commands, one file each.
#pragma once

#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

// oiiotool's.
Rows general_commands();
Rows control_commands();
Rows read_commands();
Rows write_commands();
Rows texture_commands();
Rows inspect_commands();
Rows color_commands();
Rows metadata_commands();
Rows create_commands();
Rows arithmetic_commands();
Rows geometry_commands();
Rows filter_commands();
Rows composite_commands();
Rows ocio_commands();
Rows channel_commands();
Rows stack_commands();
Rows diff_commands();

// Those of tonetool itself.
Rows flip_commands();
Rows metric_commands();
Rows bias_commands();
Rows noise_floor_commands();
Rows qc_commands();
Rows against_commands();
Rows exposure_commands();
Rows bloom_commands();
Rows tone_commands();
Rows cgtmo_commands();
Rows light_commands();
Rows memory_commands();

/// Adds those that work on images and settings.
void add_image_commands();
/// Adds those that compare, measure and tone map.
void add_measuring_commands();

} // namespace tonetool::chain
