// SPDX-License-Identifier: BSD-3-Clause
// Results as objects with named fields, from one table per struct.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "imagebuf/options/summary_fields.h"
#include "python/function.h"

namespace tonetool::python {

/// `NAME(field=value, ...)`, one field a line where that is long; images by their size.
std::string repr_of(const std::string& name, const py::object& result,
                    const std::vector<std::string>& fields);

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
        return add({name, Python<T>::given(), text, ""},
                   [member](const Result& r) { return Python<T>::to(r.*member); });
    }

    /// An object of Python, of this type.
    template <class Owner>
    ResultClass& object(const char* name, py::object Owner::*member, const char* type,
                        const char* text) {
        return add({name, type, text, ""}, [member](const Result& r) { return r.*member; });
    }

    template <class Owner>
    ResultClass& images(const char* name, std::vector<py::object> Owner::*member,
                        const char* text) {
        return add({name, "list[Image]", text, ""}, [member](const Result& r) {
            py::list list;
            for (const py::object& image : r.*member)
                list.append(image);
            return py::object(std::move(list));
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
        m_module.add_class(m_name, m_text, m_fields);
    }

private:
    template <class Get>
    ResultClass& add(Parameter p, Get get) {
        py::options options;
        options.disable_function_signatures();
        const std::string doc = p.type + ": " + p.text;
        m_class.def_property_readonly(p.name.c_str(), get, doc.c_str());
        m_fields.push_back(std::move(p));
        return *this;
    }

    Module& m_module;
    std::string m_name, m_text;
    py::class_<Result> m_class;
    std::vector<Parameter> m_fields;
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
