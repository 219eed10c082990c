// SPDX-License-Identifier: BSD-3-Clause
// Options as keywords: one table per struct, from which the checks, the signatures, the docstrings
// and the stubs are made.
#pragma once

#include <cctype>
#include <functional>
#include <string>
#include <vector>

#include "imagebuf/options/option.h"
#include "python/types.h"

namespace tonetool::python {

/// A keyword: a field of a struct of options.
template <class Options>
struct Field {
    std::string name, type, initial, text; ///< initial: its default as Python writes it
    std::function<void(Options&, py::handle, const std::string& where)> set;
};

template <class Options>
using Fields = std::vector<Field<Options>>;

/// A row of a table. `Options` may be derived from the struct that has the member.
template <class Options, class Owner, class T>
Field<Options> field(const char* name, T Owner::*member, const char* text) {
    return {name, Python<T>::wanted(), py::repr(Python<T>::to(Options().*member)), text,
            [member](Options& options, py::handle value, const std::string& where) {
                options.*member = Python<T>::from(value, where);
            }};
}

/// "Sigma of the window in pixels, 1 to 20.": what help() says of an option.
template <class Owner, class T>
std::string keyword_text(const Option<Owner, T>& row) {
    std::string text = row.meaning();
    text[0] = char(std::toupper(static_cast<unsigned char>(text[0])));
    if (!row.list.empty())
        text += ": \"" + OIIO::Strutil::join(row.list, "\", \"") + "\"";
    text += ".";
    if (!row.otherwise.empty())
        text +=
            std::string(Option<Owner, T>::kOptional ? " None: " : " \"\": ") + row.otherwise + ".";
    return text;
}

/// The keywords of a described struct, from which `Options` may be derived.
template <class Options, class Described>
Fields<Options> described() {
    Fields<Options> fields;
    describe(Described(), [&](const auto& row) {
        fields.push_back(field<Options>(row.keyword, row.member, keyword_text(row).c_str()));
    });
    return fields;
}

/// The name of a keyword that is not in the table, as a TypeError.
[[noreturn]] void unknown_keyword(const std::string& where, const std::string& name,
                                  const std::vector<std::string>& valid);

template <class Options>
void set_field(Options& options, const Fields<Options>& fields, const std::string& where,
               const std::string& name, py::handle value) {
    std::vector<std::string> names;
    for (const Field<Options>& row : fields) {
        if (row.name == name)
            return row.set(options, value, where + ": " + name);
        names.push_back(row.name);
    }
    unknown_keyword(where, name, names);
}

/// A struct of options inside another: a mapping of its fields, or the value of its main field.
template <class Options>
struct Table {
    std::string name, main, text;
    Fields<Options> fields;
};

/// The table of a struct.
template <class Options>
const Table<Options>& table_of();
template <>
const Table<PixelOptions>& table_of<PixelOptions>();
template <>
const Table<CurveOptions>& table_of<CurveOptions>();
template <>
const Table<ViewOptions>& table_of<ViewOptions>();
template <>
const Table<CalibrationOptions>& table_of<CalibrationOptions>();

template <class Options>
struct PythonStruct {
    static std::string wanted() { return table_of<Options>().name + " | str | None"; }
    static Options from(py::handle value, const std::string& where) {
        Options options;
        const Table<Options>& table = table_of<Options>();
        if (py::isinstance<py::str>(value)) {
            set_field(options, table.fields, where, table.main, value);
        } else if (!value.is_none()) {
            const std::string mapping = "str (" + table.main + ") or a mapping of " + table.name;
            for (const auto& [name, item] : to_pairs(value, where, mapping))
                set_field(options, table.fields, where, name, item);
        }
        return options;
    }
    static py::object to(const Options&) { return py::none(); }
};

template <>
struct Python<PixelOptions> : PythonStruct<PixelOptions> {};
template <>
struct Python<CurveOptions> : PythonStruct<CurveOptions> {};
template <>
struct Python<ViewOptions> : PythonStruct<ViewOptions> {};
template <>
struct Python<CalibrationOptions> : PythonStruct<CalibrationOptions> {};

template <>
struct Python<std::optional<ViewOptions>> {
    using View = std::optional<ViewOptions>;
    static std::string wanted() { return Python<ViewOptions>::wanted(); }
    static View from(py::handle v, const std::string& where) {
        return v.is_none() ? View() : View(Python<ViewOptions>::from(v, where));
    }
    static py::object to(const View&) { return py::none(); }
};

/// The options of a function, and where and on how many threads it runs.
template <class Options>
struct On : Options {
    OIIO::ROI roi;
    int nthreads = 0;
};

template <class O>
Field<O> roi_field() {
    return field<O>("roi", &O::roi, "Only these pixels of the result; None: all.");
}
template <class O>
Field<O> threads_field() {
    return field<O>("nthreads", &O::nthreads,
                    "Threads; 0: OpenImageIO's. The result has the same bits.");
}

/// Adds the rows of one list to another's.
template <class Options>
Fields<Options> joined(std::initializer_list<Fields<Options>> parts) {
    Fields<Options> all;
    for (const Fields<Options>& part : parts)
        all.insert(all.end(), part.begin(), part.end());
    return all;
}

} // namespace tonetool::python
