// From images to files: data types, what the format can hold, metadata.
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

/// What -d, --compression and the like ask of the outputs that follow.
struct OutputSettings {
    std::optional<NamedType> type;
    std::map<std::string, NamedType> type_of_channel;
    std::string compression, planarconfig, format_name;
    int tile_width = 0, tile_height = 0;
    bool scanline = false, dither = false, adjust_time = false, autocrop = true, autotrim = false;
    bool history = true; ///< not --nosoftwareattrib
    int quality = 0;     ///< 0: the format's own

    /// "half", or "R=float,Z=uint32" of some channels; a CommandError for anything else. If
    /// `lenient`, unknown types of channels are left out.
    void set_type(const std::string& text, bool lenient);
    /// "64x32"
    void set_tile(const std::string& text);
};

/// The widest data types of the images that were read: what is computed of them is written so.
class ReadTypes {
public:
    void note(const Image& image);
    /// Those that a part would be written with, if nothing else is asked for; `uniform`: one for
    /// all channels.
    DataFormat of(const Part& part, bool uniform) const;

    std::optional<DataFormat> widest;

private:
    std::map<std::string, OIIO::TypeDesc> m_of_subimage; ///< by its name: as it was read
};

/// The command line that an output belongs to.
struct Writer {
    std::string command_line;
    bool lenient = false; ///< as oiiotool, where that loses nothing but the message
    const ReadTypes* types = nullptr;
    Warn warn;
    std::set<std::string>* matched = nullptr; ///< gathers the channels of type_of_channel
};

/// Names of the data types of -d.
const Strings& data_type_names();
/// The type of that name; a CommandError that lists the valid ones otherwise.
NamedType parse_data_type(const std::string& name, bool lenient);

/// Check a compression, "name" or "name:quality"; a CommandError if it cannot be one.
void check_compression(const std::string& compression);

/// The data type that a subimage would be written with, where the file format has it.
OIIO::TypeDesc output_type(const Part& part, const OutputSettings& settings, const Writer& writer);

/// What a texture is made of, unless --noautocrop: windows that its format can hold. `owned` holds
/// the pixels where that changes them.
const OIIO::ImageBuf& texture_pixels(const OIIO::ImageBuf& image, const std::string& filename,
                                     const OutputSettings& settings, bool lenient,
                                     OIIO::ImageBuf& owned);

/// Write an image with these settings; a CommandError if that fails, and then the file that was
/// there is untouched. `before` is called before anything is replaced.
void write_output(const Image& image, const std::string& filename, const OutputSettings& settings,
                  const Writer& from, const std::function<void()>& before);

} // namespace tonetool::chain
