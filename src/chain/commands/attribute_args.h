// SPDX-License-Identifier: BSD-3-Clause
// attribute= of the commands that compare: whose error is it?
#pragma once

#include <optional>

#include "chain/commands/commands.h"
#include "tonetool/attribute.h"

namespace tonetool::chain {

Modifiers attribute_modifiers();

/// What attribute= asks for of a command with these options and this metric; nothing without it.
std::optional<AttributeOptions> attribute_options(const Call& call, const HdrFlipOptions& options,
                                                  const std::string& metric);
std::optional<AttributeOptions> attribute_options(const Call& call, const ErrorOptions& options);

/// Attributes the error of a test, whose measurement is the last one that was recorded: prints the
/// findings and adds them to the results.
void attribute_error(Session& session, const Call& call,
                     const std::optional<AttributeOptions>& options, const OIIO::ImageBuf& map,
                     size_t test = 0);

} // namespace tonetool::chain
