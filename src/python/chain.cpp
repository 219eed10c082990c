// SPDX-License-Identifier: BSD-3-Clause
// A command line on images.
#include "runs/runs.h"

#include "imagebuf/pixels/oiio_compat.h"
#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

struct ChainOptions {
    bool read_only = false;
};

struct ChainObject {
    std::vector<py::object> images;
    std::vector<std::string> names, warnings;
    std::string out;
    int status = 0;
};

std::vector<std::string> words_of(const py::object& command) {
    const std::string where = "chain: command";
    if (!py::isinstance<py::str>(command))
        return Python<std::vector<std::string>>::from(command, where);
    return Python<std::vector<std::string>>::from(
        py::module_::import("shlex").attr("split")(command), where);
}

// Images that share their pixels with those given, which live as long as the call.
OIIO::ImageBuf shared(const OIIO::ImageBuf& image) {
    const bool plain = image.localpixels() && !image.deep() && !oiio::is_unread_file(image);
    return plain ? oiio::view_with_spec(image, image.spec()) : image;
}

struct Given {
    std::vector<std::unique_ptr<InputImage>> images;
    std::vector<OIIO::ImageBuf> stack;
    bool arrays = false; ///< all of them
};

Given given_images(const py::object& objects) {
    Given given;
    if (objects.is_none())
        return given;
    for (const py::object& object : to_items(objects, "chain: images", "Sequence[Image]")) {
        const std::string where = "chain: images[" + std::to_string(given.images.size()) + "]";
        given.images.push_back(std::make_unique<InputImage>(object, where));
        check_read(given.images.back()->buf(), where);
        given.stack.push_back(shared(given.images.back()->buf()));
        given.arrays =
            (given.arrays || given.images.size() == 1) && given.images.back()->is_array();
    }
    return given;
}

ChainObject object_of(runs::Evaluation&& found, bool arrays) {
    ChainObject object;
    for (runs::Left& left : found.stack) {
        object.names.push_back(left.name);
        object.images.push_back(to_python(std::move(left.subimages.at(0)), {arrays, false}));
    }
    object.out = std::move(found.out);
    object.warnings = std::move(found.warnings);
    object.status = found.status;
    return object;
}

[[noreturn]] void raise_check_failed(const std::string& why, ChainObject&& object) {
    const py::object type = py::module_::import("tonetool").attr("CheckFailed");
    const py::object error = type(to_str("chain: " + why));
    error.attr("result") = py::cast(std::move(object));
    PyErr_SetObject(type.ptr(), error.ptr());
    throw py::error_already_set();
}

py::object run_chain(std::vector<py::object>& arguments, const ChainOptions& options) {
    const std::vector<std::string> words = words_of(arguments[0]);
    Given given = given_images(arguments[1]);
    chain::Policy policy;
    policy.read_only = options.read_only;
    runs::Evaluation found;
    {
        const py::gil_scoped_release others_may_run;
        found = runs::evaluate(words, std::move(given.stack), policy);
    }
    const std::string why = found.error.empty() ? "warnings" : found.error;
    if (found.status == 1 && found.stack.empty())
        throw Refused("chain: " + why);
    ChainObject object = object_of(std::move(found), given.arrays);
    if (object.status != 0)
        raise_check_failed(why, std::move(object));
    return py::cast(std::move(object));
}

void add_result(Module& module) {
    using C = ChainObject;
    ResultClass<C>(module, "ChainResult", "What a command line has left.")
        .images("images", &C::images, "The stack, the top is the last; of each its first subimage.")
        .field("names", &C::names, "Of each its file, or what it was made from.")
        .field("out", &C::out, "What was printed.")
        .field("warnings", &C::warnings, "One each.")
        .field("status", &C::status, "That of the program: 0, or 2 or 3 in CheckFailed.result.")
        .finish();
}

} // namespace

void add_chain(Module& module) {
    add_result(module);
    using O = ChainOptions;
    define(
        module,
        Description{"chain",
                    "Run a command line of the program on images.",
                    {{"command", "str | Sequence[str]",
                      "As in a shell, without the program's name; or its words.", ""},
                     {"images", "Sequence[Image] | None", "The stack it begins with, the top last.",
                      "None"}},
                    "ChainResult",
                    "The images that are left, and what was printed.",
                    "Shapes: arrays or ImageBufs; what is left is arrays if all images given "
                    "are (one channel: height x width), else ImageBufs.\n"
                    "Units, colour, alpha, NaN: as each command says; tonetool --help COMMAND.\n"
                    "A threshold (fail=, --fail) that is exceeded, and with --warnings-exit a "
                    "warning, raises tonetool.CheckFailed, a tonetool.Error, with what is left in "
                    "its `result`.",
                    "Any error of the command line.",
                    "The language is that of oiiotool."},
        Fields<O>{field<O>("read_only", &O::read_only,
                           "Commands that write files or change settings are errors.")},
        run_chain);
}

} // namespace tonetool::python
