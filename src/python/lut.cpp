// SPDX-License-Identifier: BSD-3-Clause
// Tone curves and views as look-up tables.
#include "tonetool/lut.h"

#include "imagebuf/options/tone_options.h"
#include "python/families.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

const std::string kLutSource =
    "The formats: Adobe's Cube LUT Specification 1.0, Sony Imageworks' .spi1d "
    "and .spi3d, S-2014-006 (CLF); OpenColorIO 2 (CTF); Adobe Photoshop File Formats "
    "Specification (ACV).";

Fields<LutOptions> lut_fields() {
    return joined<LutOptions>(
        {{field<LutOptions>("curve", &LutOptions::curve, "Tone curve; None: aces."),
          field<LutOptions>("view", &LutOptions::view,
                            "A view of an OpenColorIO configuration instead of the curve.")},
         described<LutOptions, LutOptions>(),
         {field<LutOptions>("white", &LutOptions::white,
                            "Of .acv: the scene light of the code value 255; 0: the curve's "
                            "white, or 1.")}});
}

py::object run_lut(std::vector<py::object>& arguments, const LutOptions& options) {
    const std::string filename = to_text(arguments[0], "export_lut: filename");
    LutSummary summary;
    run_or_raise("export_lut", [&](std::string& error) {
        return ToneAlgo::export_lut(filename, options, &summary, error);
    });
    return py::cast(summary);
}

} // namespace

void add_lut(Module& module) {
    using S = LutSummary;
    ResultClass<S>(module, "LutSummary",
                   "What was written, and how far from the exact curve it is.")
        .field("format", &S::format, "\"cube\", \"spi1d\", \"spi3d\", \"clf\", \"ctf\", \"acv\".")
        .field("structure", &S::structure, "As \"1D 4096\" or \"3D 33\".")
        .field("input", &S::input, "What the file expects: space and shaper.")
        .field("low", &S::low, "Scene light that the table begins at.")
        .field("high", &S::high, "Scene light that the table ends at.")
        .field("max_error", &S::max_error, "Largest difference to the exact result, code values.")
        .field("mean_error", &S::mean_error, "Mean difference.")
        .field("grey_max_error", &S::grey_max_error, "Largest difference of greys.")
        .field("samples", &S::samples, "That were compared.")
        .field("remarks", &S::remarks, "What the format does not hold.")
        .finish();
    define(
        module,
        Description{"export_lut",
                    "Write a tone curve or a view as a look-up table; the format is that of the "
                    "extension.",
                    {{"filename", "str | os.PathLike[str]",
                      ".cube, .spi1d, .spi3d, .clf, .ctf or .acv.", ""}},
                    "LutSummary",
                    "What was written, with its measured error.",
                    "Shapes: a table per channel, or a cube. Units: input is scene light in linear "
                    "Rec.709, shaped to 0 to 1 for .cube, .spi1d and .spi3d; the result is the "
                    "display's. NaN does not occur.\nWritten beside the target and renamed.",
                    "An unknown name, a value out of range, a format that cannot hold the curve, a "
                    "file that cannot be written.",
                    kLutSource},
        lut_fields(), run_lut);
    define_names(module, "lut_shapers", "Names of the shapers of export_lut().", kLutSource,
                 ToneAlgo::lut_shapers);
    define_names(module, "lut_formats", "Names of the formats of export_lut().", kLutSource,
                 ToneAlgo::lut_formats);
}

} // namespace tonetool::python
