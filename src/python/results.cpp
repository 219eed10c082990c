// SPDX-License-Identifier: BSD-3-Clause
#include "python/results.h"

#include <OpenImageIO/strutil.h>
#include <cmath>
#include <functional>

namespace tonetool::python {

namespace {

using OIIO::Strutil::fmt::format;

std::string image_repr(const OIIO::ImageBuf& image) {
    return format("<ImageBuf {}x{}x{} {}>", image.spec().width, image.spec().height,
                  image.nchannels(), image.spec().format.c_str());
}

constexpr size_t kLineWidth = 100;

std::string value_repr(const py::handle& value);

bool is_result(const py::handle& value) {
    return py::hasattr(value, "__getstate__") &&
           std::string(py::str(py::type::handle_of(value).attr("__module__"))) == "tonetool";
}

// "[a, b, ... 9 in all]", about a line. Of results, which are long, one is shown.
std::string sequence_repr(const py::handle& items, const char* begin, const char* end,
                          const std::function<std::string(const py::handle&)>& show) {
    constexpr size_t length = 64;
    const size_t count = py::len(items);
    const size_t most = count > 4 ? 3 : 4; // windows are shown whole
    size_t shown = 0;
    std::string text;
    for (const py::handle item : py::iter(items)) {
        const std::string one = shown == most ? "" : show(item);
        const bool full = shown == most || is_result(item) || text.size() + one.size() > length;
        if (shown > 0 && full)
            break;
        text += (shown == 0 ? "" : ", ") + one;
        ++shown;
    }
    return begin + text + (count > shown ? format(", ... {} in all", count) : "") + end;
}

std::string text_repr(const py::handle& value) {
    constexpr size_t most = 60;
    const py::str text = value.cast<py::str>();
    if (py::len(text) <= most)
        return py::repr(text);
    return std::string(py::repr(text[py::slice(0, most, 1)])) + "...";
}

std::string value_repr(const py::handle& value) {
    if (PyFloat_Check(value.ptr()))
        return format("{:.6g}", value.cast<double>());
    if (py::isinstance<py::str>(value))
        return text_repr(value);
    if (py::isinstance<py::list>(value))
        return sequence_repr(value, "[", "]", value_repr);
    if (py::isinstance<py::dict>(value))
        return sequence_repr(value, "{", "}", [&value](const py::handle& key) {
            return value_repr(key) + ": " + value_repr(value[key]);
        });
    if (py::isinstance<OIIO::ImageBuf>(value))
        return image_repr(value.cast<const OIIO::ImageBuf&>());
    if (py::isinstance<py::array>(value))
        return "<array " + std::string(py::str(value.attr("shape"))) + " " +
               std::string(py::str(value.attr("dtype"))) + ">";
    // OpenImageIO's own repr has no numbers.
    return py::isinstance<OIIO::ROI>(value) ? "ROI(" + std::string(py::str(value)) + ")"
                                            : std::string(py::repr(value));
}

// As many parts in a line as fit; those that are lines themselves stand alone.
std::string in_lines(const std::vector<std::string>& parts) {
    const std::string indent(4, ' ');
    std::string text, line;
    const auto flush = [&] {
        text += line.empty() ? "" : "\n" + indent + line;
        line.clear();
    };
    for (size_t i = 0; i < parts.size(); ++i) {
        const std::string part = parts[i] + (i + 1 < parts.size() ? "," : "");
        const bool lines = part.find('\n') != std::string::npos;
        if (lines || indent.size() + line.size() + 1 + part.size() > kLineWidth)
            flush();
        line += (line.empty() ? "" : " ") + OIIO::Strutil::replace(part, "\n", "\n" + indent, true);
        if (lines)
            flush();
    }
    flush();
    return text;
}

} // namespace

std::string repr_of(const std::string& name, const py::object& result,
                    const std::vector<std::string>& fields) {
    std::vector<std::string> parts;
    bool lines = false;
    for (const std::string& field : fields) {
        parts.push_back(field + "=" + value_repr(result.attr(field.c_str())));
        lines = lines || parts.back().find('\n') != std::string::npos;
    }
    const std::string text = OIIO::Strutil::join(parts, ", ");
    if (!lines && name.size() + text.size() + 2 <= kLineWidth)
        return name + "(" + text + ")";
    return name + "(" + in_lines(parts) + ")";
}

bool same_value(const py::handle& one, const py::handle& other) {
    if (PyFloat_Check(one.ptr()) && PyFloat_Check(other.ptr())) {
        const double a = one.cast<double>(), b = other.cast<double>();
        return a == b || (std::isnan(a) && std::isnan(b));
    }
    if (!py::type::handle_of(one).is(py::type::handle_of(other)))
        return false;
    if (py::isinstance<py::array>(one))
        return py::module_::import("numpy")
            .attr("array_equal")(one, other, py::arg("equal_nan") = true)
            .cast<bool>();
    if (py::isinstance<OIIO::ImageBuf>(one)) {
        const auto packed = [](const py::handle& image) {
            return packed_images(py::reinterpret_borrow<py::object>(image));
        };
        return same_value(packed(one), packed(other));
    }
    const bool dict = py::isinstance<py::dict>(one);
    if (!dict && !py::isinstance<py::list>(one))
        return one.equal(other);
    if (py::len(one) != py::len(other))
        return false;
    py::size_t i = 0;
    for (const py::handle item : py::iter(one)) {
        const bool same = dict ? other.contains(item) && same_value(one[item], other[item])
                               : same_value(item, py::object(other[py::int_(i++)]));
        if (!same)
            return false;
    }
    return true;
}

} // namespace tonetool::python
