// SPDX-License-Identifier: BSD-3-Clause
#include "python/function.h"

#include <OpenImageIO/strutil.h>
#include <pybind11/eval.h>

#include "imagebuf/pixels/names.h"

namespace tonetool::python {

namespace {

using OIIO::Strutil::fmt::format;

constexpr size_t kLineWidth = 88;

// Paragraphs (split at \n), each broken into lines and indented.
std::string wrapped(const std::string& text, size_t indent) {
    std::string result;
    for (const std::string& paragraph : OIIO::Strutil::splits(text, "\n")) {
        std::string line(indent, ' ');
        for (const std::string& word : OIIO::Strutil::splits(paragraph)) {
            if (line.size() > indent && line.size() + 1 + word.size() > kLineWidth) {
                result += line + "\n";
                line.assign(indent, ' ');
            }
            line += (line.size() > indent ? " " : "") + word;
        }
        result += line + "\n";
    }
    return result;
}

std::string section(const std::string& title, const std::string& body) {
    return body.empty() ? "" : "\n" + title + "\n" + std::string(title.size(), '-') + "\n" + body;
}

std::string entry(const Parameter& p) {
    return p.name + " : " + p.type + (p.initial.empty() ? "" : ", default " + p.initial) + "\n" +
           wrapped(p.text, 4);
}

// As inspect.signature reads it.
std::string signature_text(const std::string& name, const std::vector<Parameter>& positional,
                           const std::vector<Parameter>& keywords) {
    std::string text;
    const auto add = [&text](const std::string& word) {
        text += (text.empty() ? "" : ", ") + word;
    };
    const auto spelt = [](const Parameter& p) {
        return p.name + (p.initial.empty() ? "" : "=" + p.initial);
    };
    for (const Parameter& p : positional)
        add(spelt(p));
    if (!keywords.empty())
        add("*");
    for (const Parameter& p : keywords)
        add(spelt(p));
    return name + "(" + text + ")";
}

std::string docstring(const Description& d, const std::vector<Parameter>& keywords) {
    std::string parameters;
    for (const Parameter& p : d.positional)
        parameters += entry(p);
    for (const Parameter& p : keywords)
        parameters += entry(p);
    std::string raises =
        "TypeError\n" + wrapped("An argument of a wrong type, an unknown keyword.", 4);
    raises +=
        "ValueError\n" + wrapped("An array of a wrong shape, or of numbers that are not taken.", 4);
    raises += "tonetool.Error\n" + wrapped(d.errors, 4);
    return signature_text(d.name, d.positional, keywords) + "\n--\n\n" + wrapped(d.summary, 0) +
           section("Parameters", parameters) +
           section("Returns", d.returned + "\n" + wrapped(d.returned_text, 4)) +
           section("Raises", raises) + section("Notes", wrapped(d.notes, 0)) +
           section("References", wrapped(d.source, 0));
}

std::string stub_of(const Description& d, const std::vector<Parameter>& keywords) {
    std::string text = "def " + d.name + "(";
    const auto add = [&text](const Parameter& p) {
        text += "\n    " + p.name + ": " + p.type + (p.initial.empty() ? "" : " = ...") + ",";
    };
    for (const Parameter& p : d.positional)
        add(p);
    if (!keywords.empty())
        text += "\n    *,";
    for (const Parameter& p : keywords)
        add(p);
    const bool none = d.positional.empty() && keywords.empty();
    return text + (none ? "" : "\n") + ") -> " + d.returned + ": ...\n";
}

// The positional arguments in their places, taken from `words` where they were given by name.
std::vector<py::object> bound(const std::string& function, const std::vector<Parameter>& positional,
                              const py::args& args, const py::dict& words) {
    if (args.size() > positional.size())
        throw py::type_error(format("{}: {} positional arguments: takes {}{}", function,
                                    args.size(), positional.size(),
                                    positional.empty() ? "" : ", then keywords"));
    std::vector<py::object> values;
    for (size_t i = 0; i < positional.size(); ++i) {
        const py::str name(positional[i].name);
        const bool named = words.contains(name);
        if (named && i < args.size())
            throw py::type_error(function + ": " + positional[i].name + " is given twice");
        if (!named && i >= args.size() && positional[i].initial.empty())
            throw py::type_error(function + ": " + positional[i].name + " is missing");
        values.push_back(i < args.size() ? py::object(args[i])
                         : named         ? words.attr("pop")(name)
                                         : py::eval(positional[i].initial));
    }
    return values;
}

} // namespace

void unknown_keyword(const std::string& where, const std::string& name,
                     const std::vector<std::string>& valid) {
    throw py::type_error(valid_utf8(where + ": " + unknown_name("keyword", name, valid)));
}

void Module::define(const Description& description, const std::vector<Parameter>& keywords,
                    Run run) {
    py::options options;
    options.disable_function_signatures();
    const std::string doc = docstring(description, keywords);
    const std::string name = description.name;
    const auto call = [name, positional = description.positional,
                       run = std::move(run)](const py::args& args, const py::kwargs& kwargs) {
        const py::dict words = kwargs.attr("copy")();
        std::vector<py::object> values = bound(name, positional, args, words);
        return run(values, words);
    };
    m_handle.def(name.c_str(), call, doc.c_str());
    m_functions += "\n" + stub_of(description, keywords);
    m_names.append(name);
}

void define_names(Module& module, const std::string& name, const std::string& summary,
                  const std::string& source, std::vector<std::string> (*list)()) {
    const Description description = {
        name,     summary, {}, "list[str]", "Names.", "The list is that of the library in use.",
        "Never.", source};
    define(module, description, [list](std::vector<py::object>&) {
        return Python<std::vector<std::string>>::to(list());
    });
}

void Module::add_class(const std::string& name, const std::string& text,
                       const std::vector<Parameter>& fields) {
    m_classes += "\nclass " + name + ":\n    \"\"\"" + text + "\"\"\"\n\n";
    for (const Parameter& p : fields)
        m_classes += "    @property\n    def " + p.name + "(self) -> " + p.type + ": ...\n";
    m_names.append(name);
}

void Module::add_mapping(const std::string& name, const std::string& text, const std::string& main,
                         const std::vector<Parameter>& fields) {
    m_classes += "\n" + name + " = TypedDict(\n    \"" + name + "\",\n    {\n";
    m_mappings += "\n" + name + ": " + text + "; a str is its `" + main + "`.\n";
    for (const Parameter& p : fields) {
        m_classes += "        \"" + p.name + "\": " + p.type + ",\n";
        m_mappings +=
            "    " + p.name + " : " + p.type + ", default " + p.initial + "\n" + wrapped(p.text, 8);
    }
    m_classes += "    },\n    total=False,\n)\n";
}

std::string Module::stubs() const {
    return "# Made from the module by src/scripts/write_stubs.py: do not edit.\n"
           "import os\n"
           "from collections.abc import Mapping, Sequence\n"
           "from typing import Literal, TypedDict, Union\n\n"
           "import numpy as np\n"
           "from numpy.typing import NDArray\n"
           "from OpenImageIO import ROI, ImageBuf\n\n"
           "# Image and the mappings of options are for annotations: the module does not have "
           "them.\n"
           "Image = Union[\n    ImageBuf,\n    NDArray[np.float32],\n    NDArray[np.float16],\n    "
           "NDArray[np.float64],\n    NDArray[np.uint8],\n    NDArray[np.uint16],\n]\n\n"
           "__version__: str\n\n"
           "class Error(RuntimeError): ...\n\n"
           "class CheckFailed(Error):\n    result: ChainResult\n" +
           m_classes + m_functions;
}

} // namespace tonetool::python
