// SPDX-License-Identifier: BSD-3-Clause
#include "python/results.h"

#include <OpenImageIO/strutil.h>

namespace tonetool::python {

namespace {

using OIIO::Strutil::fmt::format;

std::string image_repr(const OIIO::ImageBuf& image) {
    return format("<ImageBuf {}x{}x{} {}>", image.spec().width, image.spec().height,
                  image.nchannels(), image.spec().format.c_str());
}

std::string value_repr(const py::handle& value);

std::string list_repr(const py::list& list) {
    constexpr size_t most = 8;
    std::string text;
    for (size_t i = 0; i < std::min(list.size(), most); ++i)
        text += (i == 0 ? "" : ", ") + value_repr(list[i]);
    return "[" + text + (list.size() > most ? format(", ... {} in all]", list.size()) : "]");
}

std::string value_repr(const py::handle& value) {
    if (PyFloat_Check(value.ptr()))
        return format("{:.6g}", value.cast<double>());
    if (py::isinstance<py::list>(value))
        return list_repr(value.cast<py::list>());
    if (py::isinstance<OIIO::ImageBuf>(value))
        return image_repr(value.cast<const OIIO::ImageBuf&>());
    if (py::isinstance<py::array>(value))
        return "<array " + std::string(py::str(value.attr("shape"))) + " " +
               std::string(py::str(value.attr("dtype"))) + ">";
    // OpenImageIO's own repr has no numbers.
    return py::isinstance<OIIO::ROI>(value) ? "ROI(" + std::string(py::str(value)) + ")"
                                            : std::string(py::repr(value));
}

} // namespace

std::string repr_of(const std::string& name, const py::object& result,
                    const std::vector<std::string>& fields) {
    constexpr size_t line_width = 100;
    std::vector<std::string> parts;
    bool lines = false;
    for (const std::string& field : fields) {
        parts.push_back(field + "=" + value_repr(result.attr(field.c_str())));
        lines = lines || parts.back().find('\n') != std::string::npos;
    }
    std::string text = OIIO::Strutil::join(parts, ", ");
    if (!lines && name.size() + text.size() + 2 <= line_width)
        return name + "(" + text + ")";
    text = OIIO::Strutil::join(parts, ",\n");
    return name + "(\n    " + OIIO::Strutil::replace(text, "\n", "\n    ", true) + ")";
}

} // namespace tonetool::python
