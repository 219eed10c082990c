#include "python/images.h"

#include <OpenImageIO/oiioversion.h>
#include <OpenImageIO/strutil.h>

#include "python/types.h"

namespace tonetool::python {

namespace {

const char wanted_image[] = "an OpenImageIO.ImageBuf or a float32 array of height x width or "
                            "height x width x channels";

std::string described(const py::array& array) {
    return std::string(py::str(array.dtype())) + " array of shape " +
           std::string(py::str(array.attr("shape")));
}

// An array of the pixels of `image`, which the array keeps.
py::object array_of(std::unique_ptr<OIIO::ImageBuf> image, bool channel_axis) {
    const OIIO::ImageSpec& spec = image->spec();
    std::vector<py::ssize_t> shape = {spec.height, spec.width};
    if (channel_axis || spec.nchannels != 1)
        shape.push_back(spec.nchannels);
    auto* pixels = static_cast<float*>(image->localpixels());
    const py::capsule owner(image.get(), [](void* p) { delete static_cast<OIIO::ImageBuf*>(p); });
    (void)image.release();
    return py::array_t<float>(shape, pixels, owner);
}

} // namespace

InputImage::InputImage(const py::object& object, const std::string& where) : m_object(object) {
    if (py::isinstance<OIIO::ImageBuf>(object)) {
        m_image = object.cast<const OIIO::ImageBuf*>();
    } else if (py::isinstance<py::array>(object)) {
        look_at(py::array(object), where);
    } else {
        wrong_type(where, object, wanted_image);
    }
}

void InputImage::look_at(const py::array& array, const std::string& where) {
    if (!py::isinstance<py::array_t<float>>(array))
        throw py::type_error(where + " is a " + described(array) + ": must be " + wanted_image +
                             "; .astype(numpy.float32) converts");
    const bool empty = array.size() == 0, large = array.size() > INT32_MAX;
    if ((array.ndim() != 2 && array.ndim() != 3) || empty || large)
        throw py::value_error(where + " is a " + described(array) + ": must be " + wanted_image +
                              (empty   ? ", not empty"
                               : large ? ", below 2^31 values"
                                       : ""));
    const auto packed = py::array_t<float, py::array::c_style>::ensure(array);
    if (!packed)
        throw py::error_already_set();
    m_object = packed;
    m_dimensions = int(array.ndim());
    const OIIO::ImageSpec spec(int(array.shape(1)), int(array.shape(0)),
                               m_dimensions == 3 ? int(array.shape(2)) : 1, OIIO::TypeFloat);
    m_view = OIIO::ImageBuf(spec, const_cast<float*>(packed.data()));
}

py::object to_python(OIIO::ImageBuf&& image, OutputKind kind) {
    if (!kind.array || image.deep())
        return py::cast(std::move(image));
    const bool plain = image.localpixels() && image.spec().format == OIIO::TypeFloat;
    auto owned =
        std::make_unique<OIIO::ImageBuf>(plain ? std::move(image) : image.copy(OIIO::TypeFloat));
    return array_of(std::move(owned), kind.keep_channel_axis);
}

OIIO::ImageBuf named_image(const InputImage& image, const std::vector<std::string>& channels,
                           const std::string& where) {
    OIIO::ImageBuf copy = image.buf().copy(OIIO::TypeUnknown);
    if (!channels.empty() && int(channels.size()) != copy.nchannels())
        throw py::value_error(OIIO::Strutil::fmt::format(
            "{} has {} names ({}): must be one for each of the {} channels", where, channels.size(),
            OIIO::Strutil::join(channels, ", "), copy.nchannels()));
    if (!channels.empty())
        copy.specmod().channelnames = channels;
    copy.specmod().alpha_channel = -1;
    for (int c = 0; c < copy.nchannels(); ++c) {
        if (copy.spec().channelnames[size_t(c)] == "A")
            copy.specmod().alpha_channel = c;
    }
    return copy;
}

void check_openimageio(const py::module_& module) {
    const std::string version = py::str(module.attr("VERSION_STRING"));
    const std::string minor =
        OIIO::Strutil::fmt::format("{}.{}.", OIIO_VERSION_MAJOR, OIIO_VERSION_MINOR);
    if (version.compare(0, minor.size(), minor) != 0)
        throw py::import_error("the OpenImageIO module is " + version +
                               ", tonetool was built with " + OIIO_VERSION_STRING);
    if (!py::detail::get_type_info(typeid(OIIO::ImageBuf), false))
        throw py::import_error("the OpenImageIO module was built with another pybind11 or compiler "
                               "than tonetool, which therefore does not know its ImageBuf");
}

} // namespace tonetool::python
