// Rows of an ImageBuf, from memory or straight from its file.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imageio.h>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace tonetool {

/// Channels next to each other that are read at once.
struct ChannelRun {
    int begin = 0, end = 0;
    int count() const { return end - begin; }
};

/// The channels in as few reads as are worth it, whatever their order in the file.
std::vector<ChannelRun> runs_of(std::vector<int> channels);

/// An ImageBuf that was opened with a file name and never read is taken from the file itself, by
/// an ImageInput of its own: no pixel goes into an ImageCache. Any other is asked for its pixels.
class RowSource {
public:
    /// The image must live as long as this does.
    bool open(const OIIO::ImageBuf& image, std::vector<ChannelRun> runs, std::string& error);

    bool from_file() const { return m_from_file; }
    /// An error about the image, after the name of its file.
    std::string named(const std::string& error) const;
    const std::vector<ChannelRun>& runs() const { return m_runs; }
    int left() const { return m_spec.x; } ///< first column of the rows
    int width() const { return m_spec.width; }
    /// How many rows from `row` on are best read at once, when they take about `bytes` as float.
    int rows_at_once(int row, size_t bytes) const;
    /// What the decoder of the file holds until `rest`, by estimate.
    size_t decoder_bytes() const;
    /// What is kept of the file for the next read, at most.
    size_t kept_bytes() const;

    /// Rows of the data window, its whole width, as interleaved floats of one run. From a file
    /// only one thread at a time may ask. A file that has changed since `open` is an error; every
    /// error names the file.
    bool read(int begin, int end, size_t run, float* out, std::string& error);
    /// Gives back what the decoder holds, where it costs little to start it again.
    void rest();

private:
    /// A block of rows that the next band may want again.
    struct Block {
        int begin = 0, end = 0;
        std::vector<float> pixels;
    };
    struct FileState {
        std::filesystem::file_time_type written{};
        uintmax_t size = 0;
        bool operator==(const FileState& o) const { return written == o.written && size == o.size; }
    };

    bool open_file(std::string& error);
    bool fetch(int begin, int end, size_t run, float* out, std::string& error);
    bool read_file(int begin, int end, size_t run, float* out);
    bool read_blocks(int begin, int end, size_t run, float* out);
    bool read_block(int begin, int end, size_t run, float* out);
    bool unchanged(std::string& error) const;
    FileState state() const;

    const OIIO::ImageBuf* m_image = nullptr;
    std::vector<ChannelRun> m_runs;
    bool m_from_file = false;
    FileState m_state;
    std::unique_ptr<OIIO::ImageInput> m_input;
    OIIO::ImageSpec m_spec;
    std::string m_format;
    int m_block = 0;             ///< rows that the file gives only together; 0: any
    std::vector<Block> m_blocks; ///< one per run
};

/// What a region of interest is of an image, with all its channels; one without a pixel of it is an
/// error.
bool part_of(const OIIO::ImageBuf& image, const OIIO::ROI& roi, OIIO::ROI& part,
             std::string& error);

/// The pixels of a part of an image, which lies within it, as floats; of a file only once, past
/// every ImageCache. On failure `out` holds what it did, and the error names the file.
bool copy_pixels(OIIO::ImageBuf& out, const OIIO::ImageBuf& image, const OIIO::ROI& part,
                 int nthreads, std::string& error);

} // namespace tonetool
