// SPDX-License-Identifier: BSD-3-Clause
// Results as objects with named fields, from one table per struct.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "imagebuf/options/summary_fields.h"
#include "python/function.h"

namespace tonetool::python {

/// `NAME(field=value, ...)`, in lines where that is long; images by their size, long lists and
/// texts by their beginning.
std::string repr_of(const std::string& name, const py::object& result,
                    const std::vector<std::string>& fields);

/// Whether two values of results are the same; NaN is the same as NaN.
bool same_value(const py::handle& one, const py::handle& other);

/// A field as pickle keeps it: an ImageBuf, or one in a list, by its header and pixels; a ROI by
/// its numbers.
py::object packed_images(const py::object& value);
/// The way back; an array where ImageBuf is unknown.
py::object unpacked_images(const py::object& value);

/// Adds a class of results, whose fields cannot be set.
template <class Result>
class ResultClass {
public:
    ResultClass(Module& module, const std::string& name, const std::string& text)
        : m_module(module),
          m_name(name),
          m_text(text),
          m_class(module.handle(), name.c_str(), text.c_str()) {}
    ResultClass(const ResultClass&) = delete;
    ResultClass& operator=(const ResultClass&) = delete;

    template <class Owner, class T>
    ResultClass& field(const char* name, T Owner::*member, const char* text) {
        return add(
            {name, Python<T>::given(), text, ""},
            [member](const Result& r) { return Python<T>::to(r.*member); },
            [member](Result& r, const py::object& value, const std::string& where) {
                r.*member = Python<T>::from(value, where);
            });
    }

    /// An object of Python, of this type.
    template <class Owner>
    ResultClass& object(const char* name, py::object Owner::*member, const char* type,
                        const char* text) {
        return add(
            {name, type, text, ""},
            [member](const Result& r) { return r.*member ? r.*member : py::object(py::none()); },
            [member](Result& r, const py::object& value, const std::string&) {
                r.*member = unpacked_images(value);
            });
    }

    template <class Owner>
    ResultClass& images(const char* name, std::vector<py::object> Owner::*member,
                        const char* text) {
        return add(
            {name, "list[Image]", text, ""},
            [member](const Result& r) {
                py::list list;
                for (const py::object& image : r.*member)
                    list.append(image);
                return py::object(std::move(list));
            },
            [member](Result& r, const py::object& value, const std::string& where) {
                r.*member = to_items(unpacked_images(value), where, "list");
            });
    }

    /// The class is complete.
    void finish() {
        std::vector<std::string> names;
        for (const Parameter& p : m_fields)
            names.push_back(p.name);
        m_class.def("__repr__", [name = m_name, names](const py::object& self) {
            return repr_of(name, self, names);
        });
        add_comparison(names);
        add_pickle();
        m_module.add_class(m_name, m_text, m_fields);
    }

private:
    using Set = std::function<void(Result&, const py::object&, const std::string& where)>;

    template <class Get>
    ResultClass& add(Parameter p, Get get, Set set) {
        py::options options;
        options.disable_function_signatures();
        const std::string doc = p.type + ": " + p.text;
        m_class.def_property_readonly(p.name.c_str(), get, doc.c_str());
        m_rows.push_back({p.name, [get](const Result& r) { return py::object(get(r)); }, set});
        m_fields.push_back(std::move(p));
        return *this;
    }

    void add_comparison(const std::vector<std::string>& names) {
        m_class.def("__eq__", [names](const py::object& self, const py::object& other) {
            if (!py::isinstance<Result>(other))
                return py::reinterpret_borrow<py::object>(Py_NotImplemented);
            for (const std::string& field : names)
                if (!same_value(self.attr(field.c_str()), other.attr(field.c_str())))
                    return py::object(py::bool_(false));
            return py::object(py::bool_(true));
        });
    }

    // copy and pickle: a dictionary of the fields. What an older version did not have keeps its
    // default.
    void add_pickle() {
        m_class.def(py::pickle(
            [rows = m_rows](const Result& r) {
                py::dict state;
                for (const Row& row : rows)
                    state[row.name.c_str()] = packed_images(row.get(r));
                return state;
            },
            [rows = m_rows, name = m_name](const py::dict& state) {
                Result r;
                for (const Row& row : rows)
                    if (state.contains(row.name.c_str()))
                        row.set(r, state[row.name.c_str()], name + ": " + row.name);
                return r;
            }));
    }

    struct Row {
        std::string name;
        std::function<py::object(const Result&)> get;
        Set set;
    };

    Module& m_module;
    std::string m_name, m_text;
    py::class_<Result> m_class;
    std::vector<Parameter> m_fields;
    std::vector<Row> m_rows;
};

/// For summary_fields.h: adds the fields that it is shown.
template <class Result>
auto visitor(ResultClass<Result>& result) {
    return [&result](const SummaryField& f, auto member) { result.field(f.name, member, f.text); };
}

/// What a function returns beside an image.
template <class Summary>
struct Imaged {
    py::object image;
    Summary summary;
};

} // namespace tonetool::python
