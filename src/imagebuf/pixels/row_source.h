// SPDX-License-Identifier: BSD-3-Clause
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
    void open(const OIIO::ImageBuf& image, std::vector<ChannelRun> runs);

    bool from_file() const { return m_from_file; }
    /// An error about the image, after the name of its file.
    std::string named(const std::string& error) const;
    const std::vector<ChannelRun>& runs() const { return m_runs; }
    int left() const { return m_spec.x; } ///< first column of the rows
    int width() const { return m_spec.width; }
    /// How many rows from `row` on are best read at once, when they take about `bytes` as float:
    /// decoders want enough rows for all threads.
    int rows_at_once(int row, size_t bytes = size_t(32) << 20) const;
    /// What the decoder of the file holds until `rest`, by estimate.
    size_t decoder_bytes() const;
    /// What is kept of the file for the next read, at most.
    size_t kept_bytes() const;

    /// Rows of the data window, its whole width, as interleaved floats of one run. From a file
    /// only one thread at a time may ask. A file that has changed since `open` is refused; every
    /// Refusal names the file.
    void read(int begin, int end, size_t run, float* out);
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

    void open_file();
    void fetch(int begin, int end, size_t run, float* out);
    bool read_file(int begin, int end, size_t run, float* out);
    bool read_blocks(int begin, int end, size_t run, float* out);
    bool read_block(int begin, int end, size_t run, float* out);
    void check_unchanged() const;
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

/// The same pixels in x and y.
bool same_window(const OIIO::ROI& a, const OIIO::ROI& b);

/// What a region of interest is of an image, with all its channels; one without a pixel of it is an
/// error.
OIIO::ROI part_of(const OIIO::ImageBuf& image, const OIIO::ROI& roi);

/// The pixels of a part of an image, which lies within it, as floats; of a file only once, past
/// every ImageCache. A Refusal names the file.
OIIO::ImageBuf copy_pixels(const OIIO::ImageBuf& image, const OIIO::ROI& part, int nthreads);

} // namespace tonetool
