// SPDX-License-Identifier: BSD-3-Clause
// Filters: neighbourhoods, kernels, Fourier transforms and repairs.
#include "chain/commands/commands.h"
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

Size asked_size(const Op& op) {
    const std::string& text = op.call.argument(0);
    auto size = parsed_size(text);
    if (!size)
        throw CommandError("Unknown size " + text +
                           (op.session.settings.compat ? "" : " (valid: WxH)"));
    return *size;
}

using Windowed = bool (*)(OIIO::ImageBuf&, const OIIO::ImageBuf&, int, int, OIIO::ROI, int);

template <Windowed Filter>
bool windowed(Op& op) {
    const Size size = asked_size(op);
    return Filter(op.dst, op.a(), int(size.width), int(size.height), {}, 0);
}

bool blur(Op& op) {
    const Size size = asked_size(op);
    OIIO::ImageBuf kernel =
        IBA::make_kernel(op.text("kernel", "gaussian"), size.width, size.height, 1.0F, true);
    if (kernel.has_error())
        throw CommandError(kernel.geterror(), "", true);
    return IBA::convolve(op.dst, op.a(), kernel);
}

bool unsharp(Op& op) {
    return IBA::unsharp_mask(op.dst, op.a(), op.text("kernel", "gaussian"), op.number("width", 3),
                             op.number("contrast", 1), op.number("threshold", 0));
}

bool fixnan(Op& op) {
    const std::string& strategy = op.call.argument(0);
    auto mode = strategy == "black"   ? IBA::NONFINITE_BLACK
                : strategy == "error" ? IBA::NONFINITE_ERROR
                                      : IBA::NONFINITE_BOX3;
    if (strategy == "none" && !op.session.settings.compat) {
        mode = IBA::NONFINITE_NONE;
    } else if (strategy != "black" && strategy != "box3" && strategy != "error") {
        const std::string why = "\"" + strategy +
                                "\" not recognized. Valid choices: black, box3, "
                                "error";
        if (!op.session.settings.compat)
            throw CommandError(why);
        op.session.warning(op.call.text(), why);
    }
    return IBA::fixNonFinite(op.dst, op.a(), mode);
}

const Rows kFilterRows = {
    on_pixels("convolve", 2, "Convolve the first image with the second, a kernel",
              [](Op& op) { return IBA::convolve(op.dst, op.a(), op.b()); }),
    on_pixels("blur WxH", 1, "Blur", blur).modifier("kernel", "NAME", "kernel (gaussian)"),
    on_pixels("median WxH", 1, "Median of the neighbourhood", windowed<IBA::median_filter>),
    on_pixels("dilate WxH", 1, "Maximum of the neighbourhood", windowed<IBA::dilate>),
    on_pixels("erode WxH", 1, "Minimum of the neighbourhood", windowed<IBA::erode>),
    on_pixels("unsharp", 1, "Sharpen by an unsharp mask", unsharp)
        .modifier("kernel", "NAME", "kernel of the blur (gaussian)")
        .modifier("width", "X", "its width (3)")
        .modifier("contrast", "X", "strength (1)")
        .modifier("threshold", "X", "leave smaller differences as they are (0)"),
    on_pixels("laplacian", 1, "Laplacian", of_one<IBA::laplacian>),
    on_pixels("fft", 1, "Fourier transform", of_one<IBA::fft>),
    on_pixels("ifft", 1, "Inverse Fourier transform", of_one<IBA::ifft>),
    on_pixels("polar", 1, "From real and imaginary to amplitude and phase",
              of_one<IBA::complex_to_polar>),
    on_pixels("unpolar", 1, "From amplitude and phase to real and imaginary",
              of_one<IBA::polar_to_complex>),
    on_pixels("fixnan STRATEGY", 1, "Replace NaN and infinity: none, black, box3 or error", fixnan,
              Scope::Levels)
        .operation(""),
    on_pixels("fillholes", 1, "Fill pixels whose alpha is not 1 from their neighbourhood",
              of_one<IBA::fillholes_pushpull>)
        .operation(""),
};

} // namespace

Rows filter_commands() {
    return kFilterRows;
}

} // namespace tonetool::chain
