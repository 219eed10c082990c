// SPDX-License-Identifier: BSD-3-Clause
#include "python/types.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/pixels/names.h"

namespace tonetool::python {

void wrong_type(const std::string& where, py::handle value, const std::string& wanted) {
    std::string shown =
        OIIO::Strutil::join(OIIO::Strutil::splits(std::string(py::repr(value))), " ");
    if (shown.size() > 60)
        shown.replace(57, std::string::npos, "...");
    const std::string type = py::str(py::type::handle_of(value).attr("__name__"));
    throw py::type_error(valid_utf8(where) + " is " + shown + " (" + type + "): must be " + wanted);
}

double to_double(py::handle value, const std::string& where) {
    const bool number =
        PyFloat_Check(value.ptr()) || PyIndex_Check(value.ptr()) || py::hasattr(value, "__float__");
    // Arrays have __float__, too.
    if (!number || PyBool_Check(value.ptr()) || py::hasattr(value, "__len__"))
        wrong_type(where, value, "a float");
    const double result = PyFloat_AsDouble(value.ptr());
    if (PyErr_Occurred())
        throw py::error_already_set();
    return result;
}

int64_t to_integer(py::handle value, const std::string& where, int64_t low, int64_t high) {
    if (!PyIndex_Check(value.ptr()) || PyBool_Check(value.ptr()) || py::hasattr(value, "__len__"))
        wrong_type(where, value, "an int");
    const auto number = py::reinterpret_steal<py::object>(PyNumber_Index(value.ptr()));
    int overflow = 0;
    const int64_t result =
        number ? PyLong_AsLongLongAndOverflow(number.ptr(), &overflow) : int64_t{0};
    if (PyErr_Occurred())
        throw py::error_already_set();
    if (overflow != 0 || result < low || result > high)
        throw py::value_error(where + " is " + std::string(py::str(number)) + ": must be " +
                              std::to_string(low) + " to " + std::to_string(high));
    return result;
}

bool to_bool(py::handle value, const std::string& where) {
    const std::string type = py::str(py::type::handle_of(value).attr("__name__"));
    // The others are those of NumPy 1 and 2.
    if (!PyBool_Check(value.ptr()) && type != "bool_" && type != "bool")
        wrong_type(where, value, "a bool");
    return PyObject_IsTrue(value.ptr()) == 1;
}

std::string to_text(py::handle value, const std::string& where) {
    if (py::isinstance<py::str>(value)) {
        // Bytes of a file's name that are no UTF-8 come as halves of surrogates, and go back.
        const auto bytes = py::reinterpret_steal<py::bytes>(
            PyUnicode_AsEncodedString(value.ptr(), "utf-8", "surrogateescape"));
        if (!bytes)
            throw py::error_already_set();
        return bytes;
    }
    if (!py::hasattr(value, "__fspath__"))
        wrong_type(where, value, "a str");
    return to_text(value.attr("__fspath__")(), where);
}

std::vector<py::object> to_items(py::handle value, const std::string& where,
                                 const std::string& wanted) {
    const bool text = py::isinstance<py::str>(value) || py::isinstance<py::bytes>(value);
    if (text || !PySequence_Check(value.ptr()) || PyDict_Check(value.ptr()))
        wrong_type(where, value, "a " + wanted);
    std::vector<py::object> items;
    for (const py::handle item : value)
        items.push_back(py::reinterpret_borrow<py::object>(item));
    return items;
}

std::vector<std::pair<std::string, py::object>> to_pairs(py::handle value, const std::string& where,
                                                         const std::string& wanted) {
    if (!py::hasattr(value, "items"))
        wrong_type(where, value, "a " + wanted);
    std::vector<std::pair<std::string, py::object>> pairs;
    for (const py::handle item : value.attr("items")()) {
        const auto pair = item.cast<std::pair<py::object, py::object>>();
        pairs.emplace_back(to_text(pair.first, where + ": a key"), pair.second);
    }
    return pairs;
}

namespace {

struct RegionField {
    const char* name;
    int OIIO::ROI::*member;
};
const RegionField kRegionFields[] = {
    {"xbegin", &OIIO::ROI::xbegin},   {"xend", &OIIO::ROI::xend},
    {"ybegin", &OIIO::ROI::ybegin},   {"yend", &OIIO::ROI::yend},
    {"zbegin", &OIIO::ROI::zbegin},   {"zend", &OIIO::ROI::zend},
    {"chbegin", &OIIO::ROI::chbegin}, {"chend", &OIIO::ROI::chend}};

} // namespace

OIIO::ROI to_region(py::handle value, const std::string& where) {
    if (py::isinstance<OIIO::ROI>(value))
        return value.cast<OIIO::ROI>();
    OIIO::ROI region;
    for (const RegionField& one : kRegionFields) {
        if (!py::hasattr(value, one.name))
            wrong_type(where, value, "an OpenImageIO.ROI");
        region.*one.member = Python<int>::from(value.attr(one.name), where + ": " + one.name);
    }
    return region;
}

py::object region_object(const OIIO::ROI& region) {
    return py::detail::get_type_info(typeid(OIIO::ROI), false) ? py::cast(region)
                                                               : region_tuple(region);
}

py::object region_tuple(const OIIO::ROI& region) {
    py::dict fields;
    for (const RegionField& one : kRegionFields)
        fields[one.name] = region.*one.member;
    return py::module_::import("tonetool").attr("_Region")(**fields);
}

size_t place_of(py::handle value, const std::string& where, const std::vector<std::string>& names) {
    const std::string name = to_text(value, where);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
        throw py::value_error(valid_utf8(where + ": " + unknown_name("name", name, names)));
    return size_t(found - names.begin());
}

template <>
const std::vector<std::string>& names_of<SizePolicy>() {
    static const std::vector<std::string> names = {"match", "resize", "crop"};
    return names;
}

template <>
const std::vector<std::string>& names_of<AlphaPolicy>() {
    static const std::vector<std::string> names = {"ignore", "error"};
    return names;
}

template <>
const std::vector<std::string>& names_of<CalibrationMethod>() {
    static const std::vector<std::string> names = {"manual", "mean", "auto", "camera"};
    return names;
}

} // namespace tonetool::python
