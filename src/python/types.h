// SPDX-License-Identifier: BSD-3-Clause
// How values of options and results look in Python: one conversion and one spelling per C++ type.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include "imagebuf/pixels/utf8.h"
#include "tonetool/pixels.h"
#include "tonetool/tonemap.h"

namespace tonetool::python {

namespace py = pybind11;

/// What the library refuses: becomes tonetool.Error.
struct Refused : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/// A str; U+FFFD for bytes that are no UTF-8.
inline py::str to_str(const std::string& text) {
    return py::str(valid_utf8(text));
}

/// `WHERE is VALUE (type): must be WANTED` as a TypeError.
[[noreturn]] void wrong_type(const std::string& where, py::handle value, const std::string& wanted);

double to_double(py::handle value, const std::string& where);
int64_t to_integer(py::handle value, const std::string& where, int64_t low, int64_t high);
bool to_bool(py::handle value, const std::string& where);
/// A str or an os.PathLike.
std::string to_text(py::handle value, const std::string& where);
/// The items of a sequence that is not a str.
std::vector<py::object> to_items(py::handle value, const std::string& where,
                                 const std::string& wanted);
/// The items of a mapping whose keys are str.
std::vector<std::pair<std::string, py::object>> to_pairs(py::handle value, const std::string& where,
                                                         const std::string& wanted);

/// Of T: `from` checks and converts a value; `wanted` and `given` are the annotations of parameters
/// and of results; `to` is the way back. A T without a specialization is a class of results that
/// was added before.
template <class T, class = void>
struct Python {
    static std::string wanted() { return given(); }
    static std::string given() { return py::str(py::type::of<T>().attr("__name__")); }
    static T from(py::handle v, const std::string& where) {
        if (!py::isinstance<T>(v))
            wrong_type(where, v, "a " + given());
        return v.cast<T>();
    }
    static py::object to(const T& v) { return py::cast(v); }
};

template <>
struct Python<double> {
    static std::string wanted() { return "float"; }
    static std::string given() { return "float"; }
    static double from(py::handle v, const std::string& where) { return to_double(v, where); }
    static py::object to(double v) { return py::float_(v); }
};

template <>
struct Python<float> : Python<double> {
    static float from(py::handle v, const std::string& where) { return float(to_double(v, where)); }
};

template <class T>
struct PythonInteger {
    static std::string wanted() { return "int"; }
    static std::string given() { return "int"; }
    static T from(py::handle v, const std::string& where) {
        using Limits = std::numeric_limits<T>;
        return T(to_integer(v, where, int64_t(Limits::min()), int64_t(Limits::max())));
    }
    static py::object to(T v) { return py::int_(v); }
};
template <>
struct Python<int> : PythonInteger<int> {};
template <>
struct Python<int64_t> : PythonInteger<int64_t> {};
template <>
struct Python<int16_t> : PythonInteger<int16_t> {};
template <>
struct Python<uint16_t> : PythonInteger<uint16_t> {};
template <>
struct Python<uint32_t> : PythonInteger<uint32_t> {};
template <>
struct Python<uint8_t> : PythonInteger<uint8_t> {};
template <>
struct Python<uint64_t> {
    static std::string wanted() { return "int"; }
    static uint64_t from(py::handle v, const std::string& where) {
        return uint64_t(to_integer(v, where, 0, INT64_MAX));
    }
    static py::object to(uint64_t v) { return py::int_(v); }
};

template <>
struct Python<bool> {
    static std::string wanted() { return "bool"; }
    static std::string given() { return "bool"; }
    static bool from(py::handle v, const std::string& where) { return to_bool(v, where); }
    static py::object to(bool v) { return py::bool_(v); }
};

template <>
struct Python<std::string> {
    static std::string wanted() { return "str"; }
    static std::string given() { return "str"; }
    static std::string from(py::handle v, const std::string& where) { return to_text(v, where); }
    static py::object to(const std::string& v) { return to_str(v); }
};

template <class T>
struct Python<std::optional<T>> {
    static std::string wanted() { return Python<T>::wanted() + " | None"; }
    static std::string given() { return Python<T>::given() + " | None"; }
    static std::optional<T> from(py::handle v, const std::string& where) {
        return v.is_none() ? std::nullopt : std::optional<T>(Python<T>::from(v, where));
    }
    static py::object to(const std::optional<T>& v) {
        return v ? Python<T>::to(*v) : py::object(py::none());
    }
};

template <class Items>
py::object list_of(const Items& items) {
    py::list list;
    for (const auto& item : items)
        list.append(Python<std::decay_t<decltype(item)>>::to(item));
    return py::object(std::move(list));
}

template <class T>
struct Python<std::vector<T>> {
    static std::string wanted() { return "Sequence[" + Python<T>::wanted() + "]"; }
    static std::string given() { return "list[" + Python<T>::given() + "]"; }
    static std::vector<T> from(py::handle v, const std::string& where) {
        std::vector<T> items;
        for (const py::object& item : to_items(v, where, wanted()))
            items.push_back(
                Python<T>::from(item, where + "[" + std::to_string(items.size()) + "]"));
        return items;
    }
    static py::object to(const std::vector<T>& v) { return list_of(v); }
};

template <class T, size_t N>
struct Python<std::array<T, N>> {
    static std::string given() { return "list[" + Python<T>::given() + "]"; }
    static std::array<T, N> from(py::handle v, const std::string& where) {
        const std::vector<T> items = Python<std::vector<T>>::from(v, where);
        if (items.size() != N)
            throw py::value_error(where + " has " + std::to_string(items.size()) +
                                  " items: must be " + std::to_string(N));
        std::array<T, N> array{};
        std::copy(items.begin(), items.end(), array.begin());
        return array;
    }
    static py::object to(const std::array<T, N>& v) { return list_of(v); }
};

/// Of numbers, or of lists of them.
template <class T>
struct PythonNumbers {
    using Map = std::map<std::string, T>;
    static std::string wanted() { return "Mapping[str, " + Python<T>::wanted() + "]"; }
    static std::string given() { return "dict[str, " + Python<T>::given() + "]"; }
    static Map from(py::handle v, const std::string& where) {
        Map map;
        for (const auto& [key, value] : to_pairs(v, where, wanted()))
            map[key] = Python<T>::from(value, where + "[\"" + key + "\"]");
        return map;
    }
    static py::object to(const Map& v) {
        py::dict dict;
        for (const auto& [key, value] : v)
            dict[to_str(key)] = Python<T>::to(value);
        return py::object(std::move(dict));
    }
};
template <>
struct Python<std::map<std::string, double>> : PythonNumbers<double> {};
template <>
struct Python<std::map<std::string, std::vector<double>>> : PythonNumbers<std::vector<double>> {};

/// In the order of the pairs.
template <class T>
struct PythonPairs {
    using Pairs = std::vector<std::pair<std::string, T>>;
    static py::object to(const Pairs& v) {
        py::dict dict;
        for (const auto& [key, value] : v)
            dict[to_str(key)] = Python<T>::to(value);
        return py::object(std::move(dict));
    }
};

template <>
struct Python<std::vector<std::pair<std::string, double>>> : PythonPairs<double> {
    static std::string given() { return "dict[str, float]"; }
    static Pairs from(py::handle v, const std::string& where) {
        Pairs pairs;
        for (const auto& [key, value] : to_pairs(v, where, "Mapping[str, float]"))
            pairs.emplace_back(key, to_double(value, where + "[\"" + key + "\"]"));
        return pairs;
    }
};

template <>
struct Python<std::vector<std::pair<std::string, std::string>>> : PythonPairs<std::string> {
    static std::string wanted() { return "Mapping[str, str]"; }
    static std::string given() { return "dict[str, str]"; }
    static Pairs from(py::handle v, const std::string& where) {
        Pairs pairs;
        for (const auto& [key, value] : to_pairs(v, where, wanted()))
            pairs.emplace_back(key, to_text(value, where + "[\"" + key + "\"]"));
        return pairs;
    }
};

template <>
struct Python<std::map<std::string, std::string>> {
    static std::string given() { return "dict[str, str]"; }
    static std::map<std::string, std::string> from(py::handle v, const std::string& where) {
        std::map<std::string, std::string> map;
        for (const auto& [key, value] : to_pairs(v, where, "Mapping[str, str]"))
            map[key] = to_text(value, where + "[\"" + key + "\"]");
        return map;
    }
    static py::object to(const std::map<std::string, std::string>& v) {
        py::dict dict;
        for (const auto& [key, value] : v)
            dict[to_str(key)] = Python<std::decay_t<decltype(value)>>::to(value);
        return py::object(std::move(dict));
    }
};

/// Of an OpenImageIO.ROI, of another OpenImageIO's, or of anything that has its fields.
OIIO::ROI to_region(py::handle value, const std::string& where);
/// An OpenImageIO.ROI, or where that module is missing a tuple with its fields.
py::object region_object(const OIIO::ROI& region);
/// The tuple, which can be pickled.
py::object region_tuple(const OIIO::ROI& region);

template <>
struct Python<OIIO::ROI> {
    static std::string wanted() { return "ROI | None"; }
    static std::string given() { return "ROI"; }
    static OIIO::ROI from(py::handle v, const std::string& where) {
        return v.is_none() ? OIIO::ROI() : to_region(v, where);
    }
    static py::object to(const OIIO::ROI& v) {
        return v.defined() ? region_object(v) : py::object(py::none());
    }
};

/// Names of an enumeration's values, in their order.
template <class E>
const std::vector<std::string>& names_of();
template <>
const std::vector<std::string>& names_of<SizePolicy>();
template <>
const std::vector<std::string>& names_of<AlphaPolicy>();
template <>
const std::vector<std::string>& names_of<CalibrationMethod>();

/// The place of a name; a ValueError that lists them.
size_t place_of(py::handle value, const std::string& where, const std::vector<std::string>& names);

template <class E>
struct Python<E, std::enable_if_t<std::is_enum_v<E>>> {
    static std::string wanted() {
        std::string text;
        for (const std::string& name : names_of<E>())
            text += (text.empty() ? "Literal[\"" : ", \"") + name + "\"";
        return text + "]";
    }
    static E from(py::handle v, const std::string& where) {
        return E(place_of(v, where, names_of<E>()));
    }
    static py::object to(E v) { return py::str(names_of<E>().at(size_t(v))); }
};

} // namespace tonetool::python
