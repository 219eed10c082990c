// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/commands.h"

namespace tonetool::chain {

void add_image_commands() {
    add_commands(Group::General, general_commands());
    add_commands(Group::Control, control_commands());
    add_commands(Group::Read, read_commands());
    add_commands(Group::Write, write_commands());
    add_commands(Group::Write, texture_commands());
    add_commands(Group::Print, inspect_commands());
    add_commands(Group::Color, color_commands());
    add_commands(Group::Metadata, metadata_commands());
    add_commands(Group::Create, create_commands());
    add_commands(Group::Arithmetic, arithmetic_commands());
    add_commands(Group::Geometry, geometry_commands());
    add_commands(Group::Filter, filter_commands());
    add_commands(Group::Composite, composite_commands());
    add_commands(Group::Color, ocio_commands());
    add_commands(Group::Channels, channel_commands());
    add_commands(Group::Stack, stack_commands());
}

void add_measuring_commands() {
    constexpr bool own = true;
    add_commands(Group::Compare, diff_commands());
    add_commands(Group::Compare, flip_commands(), own);
    add_commands(Group::Compare, metric_commands(), own);
    add_commands(Group::Compare, bias_commands(), own);
    add_commands(Group::Compare, noise_floor_commands(), own);
    add_commands(Group::Measure, qc_commands(), own);
    add_commands(Group::Measure, against_commands(), own);
    add_commands(Group::Color, exposure_commands(), own);
    add_commands(Group::Color, bloom_commands(), own);
    add_commands(Group::Color, tone_commands(), own);
    add_commands(Group::Color, cgtmo_commands(), own);
    add_commands(Group::Channels, light_commands(), own);
    add_commands(Group::General, memory_commands(), own);
}

} // namespace tonetool::chain
