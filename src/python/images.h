// SPDX-License-Identifier: BSD-3-Clause
// Images of Python: OpenImageIO.ImageBuf, and arrays of numpy, without a copy where their numbers
// are those of images.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <memory>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <string>
#include <vector>

namespace tonetool::python {

namespace py = pybind11;

/// Which arrays are images.
enum class Channels {
    Plain, ///< 1, 3 or 4: grey; R, G, B; with alpha
    Named, ///< any number, each of which gets a name
};

/// What a function was given as an image. Nothing but construction and destruction needs the GIL.
class InputImage {
public:
    /// `where` names the function and the parameter.
    InputImage(const py::object& object, const std::string& where,
               Channels channels = Channels::Plain);

    const OIIO::ImageBuf& buf() const { return m_view.initialized() ? m_view : *m_image; }
    bool is_array() const { return m_dimensions > 0; }
    /// Of the array; 0 for an ImageBuf.
    int dimensions() const { return m_dimensions; }

private:
    void look_at(const py::array& array, const std::string& where, Channels channels);

    py::object m_object; ///< keeps the pixels
    const OIIO::ImageBuf* m_image = nullptr;
    OIIO::ImageBuf m_view; ///< of the array's pixels
    int m_dimensions = 0;
};

/// Looks for OpenImageIO's module. It may be missing, or be of another version, pybind11 or
/// compiler than this one: then its ImageBuf is unknown here.
void find_openimageio();
/// Whether an ImageBuf can be taken and given.
bool knows_imagebuf();
/// Why it cannot.
const std::string& why_no_imagebuf();

/// How a result is handed back: as what was given.
struct OutputKind {
    bool array = false;
    bool keep_channel_axis = false; ///< height x width x 1, not height x width

    /// Maps: one channel has no axis.
    static OutputKind map(const InputImage& like) { return {like.is_array(), false}; }
    /// Pictures have the axes of the image they were made of.
    static OutputKind picture(const InputImage& like) {
        return {like.is_array(), like.dimensions() == 3};
    }
};

/// The pixels change hands without a copy. Where ImageBuf is unknown, always an array.
py::object to_python(OIIO::ImageBuf&& image, OutputKind kind);

/// Refuses an image that could not be read, in its reader's words.
void check_read(const OIIO::ImageBuf& image, const std::string& function);

/// What a reader said of a file, which it names.
std::string with_path(const std::string& path, const std::string& why);

/// The pixels in memory: of an image that is still in its file those are read, else it is a copy.
OIIO::ImageBuf read_here(const OIIO::ImageBuf& image, const std::string& function);

/// A copy of an array (or of the ImageBuf's pixels) as an ImageBuf with names of channels.
OIIO::ImageBuf named_image(const InputImage& image, const std::vector<std::string>& channels,
                           const std::string& where);

} // namespace tonetool::python
