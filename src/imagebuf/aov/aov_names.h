// SPDX-License-Identifier: BSD-3-Clause
// The names that renderers give to layers which hold data: the one table.
#pragma once

#include <string>
#include <vector>

namespace tonetool {

/// What a layer holds, by its name.
enum class AovKind { Light, Position, Normal, Albedo, Depth, Motion, Coordinates, Id, Statistic };

/// "normals", "positions": for sentences.
const char* plural_of(AovKind kind);

/// Names of passes (as plain_word() makes them) that serve as guides of this kind, best first;
/// empty for kinds that are no guides.
const std::vector<std::string>& guide_passes(AovKind kind);

/// "normals" of "vraynormals", "worlddepth" of "finalimagemovierenderqueueworlddepth".
std::string bare_pass(const std::string& pass);

/// What a layer of this name (its last part: "Denoising Normal", "N_world") holds: Light unless the
/// name is known to be that of data. "diffuse" is light: only V-Ray calls its albedo so.
AovKind kind_of_layer(const std::string& layer_name);

/// Lower case, letters and digits only.
std::string plain_word(const std::string& name);

/// "left", "right" and their short forms: an eye of a stereo pair, as plain_word() makes it.
bool is_eye(const std::string& word);

} // namespace tonetool
