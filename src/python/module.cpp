// SPDX-License-Identifier: BSD-3-Clause
// The module of Python. It is called tonetool._tonetool; its package, tonetool, shows all of it.
#include "python/families.h"
#include "python/images.h"
#include "tonetool/tonetool.h"

namespace tonetool::python {

namespace {

void add_error(py::module_& handle) {
    static py::exception<Refused> error(handle, "Error", PyExc_RuntimeError);
    error.attr("__doc__") = "What the library refuses, in its words: an image it cannot read or\n"
                            "use, a value out of range, an output that cannot be written.";
    static py::exception<Refused> failed(handle, "CheckFailed", error.ptr());
    failed.attr("__doc__") = "A check of chain() that did not pass; `result` has what is left.";
    py::register_exception_translator([](std::exception_ptr raised) {
        try {
            if (raised)
                std::rethrow_exception(raised);
        } catch (const Refused& refused) {
            PyErr_SetString(error.ptr(), valid_utf8(refused.what()).c_str());
        }
    });
}

void add_everything(Module& module) {
    add_pixels(module);
    add_compare(module);
    add_flip(module);
    add_evaluate(module);
    add_bias(module);
    add_errors(module);
    add_tmqi(module);
    add_shot(module);
    add_tonemap(module);
    add_bloom(module);
    add_curves(module);
    add_cgtmo(module);
    add_lights(module);
    add_luminance(module);
    add_display(module);
    add_lut(module);
    add_qc(module);
    add_against(module);
    add_attribute(module);
    add_write(module);
    add_chain(module);
}

} // namespace

PYBIND11_MODULE(_tonetool, handle) {
    find_openimageio();
    // Classes and functions belong to the package.
    handle.attr("__name__") = "tonetool";
    add_error(handle);
    Module module(handle);
    add_everything(module);
    handle.attr("__version__") = version();
    handle.attr("__all__") = module.names();
    handle.attr("_mappings") = module.mappings();
    handle.attr("_stubs") = module.stubs();
    handle.attr("__name__") = "tonetool._tonetool";
}

} // namespace tonetool::python
