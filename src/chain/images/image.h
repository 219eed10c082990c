// SPDX-License-Identifier: BSD-3-Clause
// One entry of the image stack: read from a file, or made by a command.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagecache.h>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tonetool::chain {

/// The data types that an image is written with by default.
struct DataFormat {
    OIIO::TypeDesc type = OIIO::TypeFloat;  ///< the widest
    std::vector<OIIO::TypeDesc> of_channel; ///< empty where all are the same
    int bits = 0;                           ///< 10 or 12 in a uint16; 0: all of them
};

/// How files are opened: --iconfig, and the data type of their pixels in memory.
struct ReadOptions {
    OIIO::ImageSpec config;
    OIIO::TypeDesc type = OIIO::TypeFloat; ///< unknown: the file's own
};

/// Whether values come from an integer file, and what its reader multiplied by alpha.
enum class Integers {
    None,
    Encoded, ///< the encoded values
    Light    ///< light, which was encoded after that
};

/// The integers of a file of that format with this header.
Integers integers_of(const OIIO::ImageSpec& header, const std::string& file_format);

/// The time and size of a file, which tell whether it is still the one that was opened.
struct FileState {
    std::filesystem::file_time_type written{};
    uintmax_t size = 0;
    bool operator==(const FileState& o) const { return written == o.written && size == o.size; }
};

/// One subimage with its MIP levels. Headers are read at once, pixels on first use.
class Part {
public:
    /// A subimage of a file, whose levels have these headers.
    Part(std::string file, int subimage, std::vector<OIIO::ImageSpec> levels, Integers integers,
         ReadOptions how);
    /// Pixels that a command made, one ImageBuf for each level. Without a format they are written
    /// in the widest data type of the images that were read.
    Part(std::vector<OIIO::ImageBuf> levels, std::optional<DataFormat> format, Integers integers);

    /// The same pixels under headers that `edit` changes in anything but their size and type.
    static std::shared_ptr<Part> with_headers(std::shared_ptr<Part> source,
                                              const std::function<void(OIIO::ImageSpec&)>& edit);
    /// One MIP level.
    static std::shared_ptr<Part> of_level(std::shared_ptr<Part> source, int level);

    const OIIO::ImageSpec& header(int level = 0) const { return m_headers.at(size_t(level)); }
    int mip_levels() const { return int(m_headers.size()); }
    const std::optional<DataFormat>& format() const { return m_format; }
    bool from_file() const { return m_source ? m_source->from_file() : !m_file.empty(); }
    int subimage() const { return m_source ? m_source->subimage() : m_subimage; }
    /// The values come from an integer file: display-encoded unless the header says otherwise.
    bool integer_encoded() const { return m_integers != Integers::None; }
    Integers integers() const { return m_integers; }

    /// The pixels as float (deep images in their own types). Throws a CommandError if they cannot
    /// be read.
    const OIIO::ImageBuf& pixels(int level = 0);

    /// Reads the pixels now if they have not been read from `filename` yet.
    void read_before_replacing(const std::string& filename);

    /// The pixels with a header that says sRGB where that was only implied by an integer file.
    /// Valid as long as this part is.
    OIIO::ImageBuf color_view();

    /// The same for functions that read by themselves what they need: an unread ImageBuf if the
    /// pixels have not been read yet.
    OIIO::ImageBuf color_source();

    /// As color_view(); but if the pixels have not been read yet, only the channels from `begin` to
    /// before `end` are read, into an ImageBuf that the caller owns.
    OIIO::ImageBuf color_view(int begin, int end);

private:
    void tag_encoding(OIIO::ImageSpec& spec) const;
    void read(int level);
    void share(int level);
    void check_unchanged() const;

    std::vector<OIIO::ImageSpec> m_headers; ///< of the MIP levels
    std::optional<DataFormat> m_format;
    std::shared_ptr<Part> m_source; ///< the part that owns the pixels; nullptr: this one
    int m_first_level = 0;          ///< of the source
    std::string m_file;
    FileState m_state; ///< of the file when its header was read
    ReadOptions m_how;
    int m_subimage = 0;
    Integers m_integers = Integers::None;
    /// Of the MIP levels; an uninitialized one has not been read yet.
    std::vector<OIIO::ImageBuf> m_pixels;
    std::shared_ptr<OIIO::ImageCache> m_cache; ///< of the header, for color_source
};

using PartPtr = std::shared_ptr<Part>;
class Image;
using ImagePtr = std::shared_ptr<Image>;

/// A stack entry: one or more subimages. Entries are never changed once they are on the stack,
/// so that copies share them.
class Image {
public:
    Image(std::string name, std::vector<PartPtr> parts)
        : m_name(std::move(name)),
          m_parts(std::move(parts)) {}

    /// Opens the file and reads the headers of its subimages; throws a CommandError if that fails.
    static ImagePtr open(const std::string& filename, const ReadOptions& how = {});
    /// The result of a command on `from`: it inherits an explicit format and the encoding.
    static ImagePtr derived(const Image& from, OIIO::ImageBuf pixels);
    /// The same for several subimages, each with one or more MIP levels.
    static ImagePtr derived(const Image& from, std::vector<std::vector<OIIO::ImageBuf>> subimages);
    /// An image that a command created, written in the widest format that was read.
    static ImagePtr created(std::string name, OIIO::ImageBuf pixels,
                            std::optional<DataFormat> format = {});
    /// Black, or a checkerboard, in place of a missing file: written with the data type of the
    /// header.
    static ImagePtr placeholder(std::string name, OIIO::ImageSpec header, bool checker);
    /// The result of a measurement: float, and not display-encoded unless its header says so.
    static ImagePtr computed(std::string name, OIIO::ImageBuf pixels);

    /// Whether a command has taken the image from the stack, or has written it.
    bool used = false, written = false;
    /// Whether a command has changed or measured it, beyond rearranging the stack.
    bool worked_on = false;
    /// It is the result of a comparison, or derived from one.
    bool is_result = false;
    /// There is no such file, and it is black: only --against can do without its approved version.
    bool absent = false;
    /// It is made only of files that are the same in every frame; and the command line says that
    /// this is intended.
    bool same_in_all_frames = false, meant_for_all_frames = false;
    /// An id that is equal for images that must have equal pixels: images of the same file (by
    /// whatever name), and the results of the same commands on them. 0: unknown.
    uint64_t lineage = 0;
    /// Subimages with a beauty that a command has left out without being asked to.
    std::set<std::string> left_out;
    bool noted = false; ///< its data type has gone into Session::read_format

    void rename(std::string name) { m_name = std::move(name); }
    const std::string& name() const { return m_name; } ///< file, or what it was made from
    Part& part(size_t index = 0) const { return *m_parts.at(index); }
    /// The subimage of that name or index; throws a CommandError if there is none.
    size_t find_part(const std::string& which, bool lenient) const;
    size_t part_count() const { return m_parts.size(); }
    const std::vector<PartPtr>& parts() const { return m_parts; }
    const std::string& file_format() const { return m_file_format; } ///< "openexr"; "" if no file

private:
    std::string m_name, m_file_format;
    std::vector<PartPtr> m_parts;
};

/// From now on the process decodes files on at most this many threads; 0 sets no bound.
void limit_reader_threads(int most);

} // namespace tonetool::chain
