// SPDX-License-Identifier: BSD-3-Clause
// Writes images to files: data types, the limits of formats, metadata.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "chain/images/channels.h"
#include "chain/images/image.h"
#include "text/text.h"

namespace tonetool::chain {

/// A data type as -d and datatype= name it.
struct NamedType {
    OIIO::TypeDesc type;
    int bits = 0;
};

/// The settings of -d, --compression and the like for the outputs that follow.
struct OutputSettings {
    std::optional<NamedType> type;
    std::map<std::string, NamedType> type_of_channel;
    std::string compression, planarconfig, format_name;
    int tile_width = 0, tile_height = 0;
    bool scanline = false, dither = false, adjust_time = false, autocrop = true, autotrim = false;
    bool history = true; ///< not --nosoftwareattrib
    int quality = 0;     ///< 0: the format's own

    /// Sets "half", or "R=float,Z=uint32" for some channels; throws a CommandError for anything
    /// else. If `lenient`, unknown types of channels are ignored.
    void set_type(const std::string& text, bool lenient);
    /// "64x32"
    void set_tile(const std::string& text);
};

/// The widest data types of the images that were read: results that are computed from them are
/// written with these.
class ReadTypes {
public:
    void note(const Image& image);
    /// The types that a subimage is written with by default; `uniform`: one for all channels.
    DataFormat of(const Part& part, bool uniform) const;

    std::optional<DataFormat> widest;

private:
    /// The types of each subimage by its name, as it was read.
    std::map<std::string, OIIO::TypeDesc> m_of_subimage;
};

/// The command line that an output belongs to.
struct Writer {
    std::string command_line;
    bool lenient = false; ///< as oiiotool, where nothing but a message is lost
    const ReadTypes* types = nullptr;
    Warn warn;
    /// Collects the channels of type_of_channel that exist.
    std::set<std::string>* matched = nullptr;
};

/// Names of the data types of -d.
const Strings& data_type_names();
/// The type of that name; else throws a CommandError that lists the valid ones.
NamedType parse_data_type(const std::string& name, bool lenient);

/// Throws a CommandError unless the text can be a compression, "name" or "name:quality".
void check_compression(const std::string& compression);

/// The data type that a subimage would be written with, where the file format has it.
OIIO::TypeDesc output_type(const Part& part, const OutputSettings& settings, const Writer& writer);

/// The source of a texture: cropped to windows that its format can store, unless --noautocrop.
/// `owned` holds the pixels where that changes them.
const OIIO::ImageBuf& texture_pixels(const OIIO::ImageBuf& image, const std::string& filename,
                                     const OutputSettings& settings, bool lenient,
                                     OIIO::ImageBuf& owned);

/// Writes an image with these settings. If that fails, it throws a CommandError and the file that
/// was there is untouched. `before` is called before anything is replaced.
void write_output(const Image& image, const std::string& filename, const OutputSettings& settings,
                  const Writer& from, const std::function<void()>& before);

} // namespace tonetool::chain
