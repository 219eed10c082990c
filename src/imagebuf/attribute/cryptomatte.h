// SPDX-License-Identifier: BSD-3-Clause
// Cryptomattes by the header of a file: their names, and those of what they hold.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <cstdint>
#include <map>
#include <string>
#include <unordered_map>
#include <vector>

namespace tonetool {

/// One Cryptomatte of a header: `cryptomatte/KEY/...`, also as Nuke writes it, `exr/cryptomatte/`.
struct CryptomatteType {
    std::string name;                                ///< its channels are called so, and two digits
    std::unordered_map<uint32_t, std::string> names; ///< of ids; empty without a manifest
};

/// Those of a file, by name. What is wrong with one, or with its manifest, becomes a warning;
/// one of another hash or conversion is left out. A manifest beside the file is read only from the
/// file's own folder and below it.
std::map<std::string, CryptomatteType>
cryptomatte_types(const std::vector<const OIIO::ImageBuf*>& parts,
                  std::vector<std::string>& warnings);

/// The channels of a type's ranks in the order of their numbers: id, coverage, id, coverage...
/// Empty where it has none.
std::vector<int> cryptomatte_channels(const OIIO::ImageSpec& spec, const std::string& type);

} // namespace tonetool
