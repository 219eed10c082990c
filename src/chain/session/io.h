// SPDX-License-Identifier: BSD-3-Clause
// Reading and writing, as the chain does it.
#pragma once

#include <string>

#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

/// A bare word: the image of that label, else the file of that name.
void push_file_or_label(Session& session, const std::string& word);

/// Read a file, push it, print what --info, -v and --stats ask for.
void push_file(Session& session, const std::string& filename);

/// The colour space that the role "linear" has in the configuration.
std::string linear_space(Session& session);
/// Converts the current image, unless the spaces are the same; for --autocc.
void convert_current(Session& session, const std::string& from, const std::string& to,
                     bool unpremult, bool all_subimages = false);

/// Writes the file of an image; its settings are those of the session and of the call.
using Save = void (*)(Session&, const Call&, const Image&, const std::string& filename,
                      const OutputSettings&);
/// -o and its like: writes the current image, or all of them, unless old files are to stay.
void write_to_files(Session& session, const Call& call, const Save& save);
Modifiers output_modifiers();

/// Settings that no output has used: a -d CHAN=TYPE that fits no channel is an error.
void check_outputs(const Session& session);

} // namespace tonetool::chain
