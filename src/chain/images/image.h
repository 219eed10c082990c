// One entry of the image stack: what was read from a file, or what a command made.
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

/// The data types that an image would be written with.
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

/// What tells whether a file is still the one that was opened.
struct FileState {
    std::filesystem::file_time_type written{};
    uintmax_t size = 0;
    bool operator==(const FileState& o) const { return written == o.written && size == o.size; }
};

/// One subimage with its MIP levels. The headers are there at once, pixels come with the first use.
class Part {
public:
    /// A subimage of a file, whose levels have these headers.
    Part(std::string file, int subimage, std::vector<OIIO::ImageSpec> levels, ReadOptions how);
    /// Pixels that a command made, a level each. Without a format the file they are written to
    /// is as wide as those that were read.
    Part(std::vector<OIIO::ImageBuf> levels, std::optional<DataFormat> format,
         bool integer_encoded);

    /// The same pixels under headers that `edit` changes in anything but their size and type.
    static std::shared_ptr<Part> with_headers(std::shared_ptr<Part> source,
                                              const std::function<void(OIIO::ImageSpec&)>& edit);
    /// One MIP level.
    static std::shared_ptr<Part> of_level(std::shared_ptr<Part> source, int level);

    const OIIO::ImageSpec& header(int level = 0) const { return m_headers.at(size_t(level)); }
    int mip_levels() const { return int(m_headers.size()); }
    const std::optional<DataFormat>& format() const { return m_format; }
    bool from_file() const { return m_source ? m_source->from_file() : !m_file.empty(); }
    /// The values come from an integer file: display-encoded unless the header says otherwise.
    bool integer_encoded() const { return m_integer_encoded; }

    /// The pixels as float (deep ones as they are). A CommandError where they cannot be read.
    const OIIO::ImageBuf& pixels(int level = 0);

    /// Reads the pixels now if they are still to come from `filename`.
    void read_before_replacing(const std::string& filename);

    /// The pixels with a header that says sRGB where that was only implied by the integer file
    /// they come from. Valid as long as this part is.
    OIIO::ImageBuf color_view();

    /// The same for functions that read what they need of an ImageBuf that was not read: the file
    /// if its pixels are still to come.
    OIIO::ImageBuf color_source();

    /// As color_view(), but of a file whose pixels are still to come only the channels from `begin`
    /// to before `end`, which the caller owns.
    OIIO::ImageBuf color_view(int begin, int end);

private:
    void tag_encoding(OIIO::ImageSpec& spec) const;
    void read(int level);
    void share(int level);
    void check_unchanged() const;

    std::vector<OIIO::ImageSpec> m_headers; ///< of the MIP levels
    std::optional<DataFormat> m_format;
    std::shared_ptr<Part> m_source; ///< whose pixels these are; else nullptr
    int m_first_level = 0;          ///< of the source
    std::string m_file;
    FileState m_state; ///< of the file when its header was read
    ReadOptions m_how;
    int m_subimage = 0;
    bool m_integer_encoded = false;
    std::vector<OIIO::ImageBuf> m_pixels; ///< of the MIP levels; not initialized: still to be read
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

    /// Opens the file and reads the headers of its subimages; a CommandError if that fails.
    static ImagePtr open(const std::string& filename, const ReadOptions& how = {});
    /// What a command made of `from`: a format that is its own and the encoding go on.
    static ImagePtr derived(const Image& from, OIIO::ImageBuf pixels);
    /// Several subimages (of one or more MIP levels) that a command made of those of `from`.
    static ImagePtr derived(const Image& from, std::vector<std::vector<OIIO::ImageBuf>> subimages);
    /// What a command made of nothing, written in the widest format that was read.
    static ImagePtr created(std::string name, OIIO::ImageBuf pixels,
                            std::optional<DataFormat> format = {});
    /// Black, or a checker board, in the place of a file that is not there: written with the data
    /// type of the header.
    static ImagePtr placeholder(std::string name, OIIO::ImageSpec header, bool checker);
    /// What a command measured: float, and not display-encoded unless its header says so.
    static ImagePtr computed(std::string name, OIIO::ImageBuf pixels);

    /// Whether some command has taken the image from the stack, or has written it.
    bool used = false, written = false;
    /// Whether one has done more with it than move it about, or has measured it.
    bool worked_on = false;
    /// A comparison has made it, or what was made of that.
    bool is_result = false;
    /// It is made of files that are the same in every frame, and of nothing else; and the command
    /// line says of them that this is meant.
    bool same_in_all_frames = false, meant_for_all_frames = false;
    /// The same for images that must have the same pixels: those of one file (by whatever name),
    /// and what the same commands make of them. 0: nothing is known of it.
    uint64_t lineage = 0;
    /// Parts with a picture that a command has left out without being asked to.
    std::set<std::string> left_out;
    bool noted = false; ///< its data type has gone into Session::read_format

    void rename(std::string name) { m_name = std::move(name); }
    const std::string& name() const { return m_name; } ///< file, or what it was made from
    Part& part(size_t index = 0) const { return *m_parts.at(index); }
    /// The subimage of that name or index; a CommandError if there is none.
    size_t find_part(const std::string& which, bool lenient) const;
    size_t part_count() const { return m_parts.size(); }
    const std::vector<PartPtr>& parts() const { return m_parts; }
    const std::string& file_format() const { return m_file_format; } ///< "openexr"; "" if no file

private:
    std::string m_name, m_file_format;
    std::vector<PartPtr> m_parts;
};

/// The process decodes files on at most so many threads from now on; 0 sets no bound.
void limit_reader_threads(int most);

} // namespace tonetool::chain
