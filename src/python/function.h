// SPDX-License-Identifier: BSD-3-Clause
// Functions of the module: positional images, keywords from a table, a docstring with sections.
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "python/images.h"
#include "python/options.h"

namespace tonetool::python {

/// A parameter as the signature, the docstring and the stub show it.
struct Parameter {
    std::string name, type, text;
    std::string initial; ///< empty: it must be given
};

/// A function in words. None of them may be empty.
struct Description {
    std::string name, summary;
    std::vector<Parameter> positional;
    std::string returned, returned_text; ///< type and meaning
    std::string notes;                   ///< shapes, colour, units, NaN, alpha
    std::string errors;                  ///< when tonetool.Error is raised
    std::string source;                  ///< the publication
};

inline Parameter image_parameter(const char* name, const std::string& text) {
    return {name, "Image", text, ""};
}

/// The module while it is made.
class Module {
public:
    explicit Module(py::module_ handle) : m_handle(std::move(handle)) {}

    py::module_& handle() { return m_handle; }

    using Run = std::function<py::object(std::vector<py::object>&, const py::dict&)>;
    void define(const Description& description, const std::vector<Parameter>& keywords, Run run);

    void add_class(const std::string& name, const std::string& text,
                   const std::vector<Parameter>& fields);
    /// A mapping that stands for a struct of options.
    template <class Options>
    void add_mapping(const Table<Options>& table);

    /// The stubs of all that was added.
    std::string stubs() const;
    /// What there is to say of the mappings.
    const std::string& mappings() const { return m_mappings; }
    py::list names() const { return m_names; }

private:
    void add_mapping(const std::string& name, const std::string& text, const std::string& main,
                     const std::vector<Parameter>& fields);

    py::module_ m_handle;
    py::list m_names;
    std::string m_classes, m_functions, m_mappings;
};

template <class Options>
std::vector<Parameter> parameters_of(const Fields<Options>& fields) {
    std::vector<Parameter> parameters;
    for (const Field<Options>& row : fields)
        parameters.push_back({row.name, row.type, row.text, row.initial});
    return parameters;
}

template <class Options>
void Module::add_mapping(const Table<Options>& table) {
    add_mapping(table.name, table.text, table.main, parameters_of(table.fields));
}

/// Adds a function whose keywords are the rows of a table. `run` gets the positional arguments and
/// the options.
template <class Options, class Function>
void define(Module& module, const Description& description, Fields<Options> fields, Function run) {
    const std::string name = description.name;
    module.define(description, parameters_of(fields),
                  [name, fields, run](std::vector<py::object>& positional, const py::dict& words) {
                      Options options;
                      for (const auto& [key, value] : words)
                          set_field(options, fields, name, key.template cast<std::string>(), value);
                      return py::object(run(positional, options));
                  });
}

/// A function without keywords.
template <class Function>
void define(Module& module, const Description& description, Function run) {
    const std::string name = description.name;
    module.define(description, {},
                  [name, run](std::vector<py::object>& positional, const py::dict& words) {
                      for (const auto& word : words)
                          unknown_keyword(name, word.first.cast<std::string>(), {});
                      return py::object(run(positional));
                  });
}

/// A function without arguments that lists names.
void define_names(Module& module, const std::string& name, const std::string& summary,
                  const std::string& source, std::vector<std::string> (*list)());

/// Runs `work`, a function of the library with a destination, without the GIL; its error is raised.
template <class Work>
OIIO::ImageBuf computed(const Work& work) {
    OIIO::ImageBuf image;
    bool done = false;
    {
        const py::gil_scoped_release others_may_run;
        done = work(image);
    }
    if (!done)
        throw Refused(image.geterror());
    return image;
}

/// The same for a function that tells its reason.
template <class Work>
void run_or_raise(const std::string& name, const Work& work) {
    std::string error;
    bool done = false;
    {
        const py::gil_scoped_release others_may_run;
        done = work(error);
    }
    if (!done)
        throw Refused(error.compare(0, name.size(), name) == 0 ? error : name + ": " + error);
}

} // namespace tonetool::python
