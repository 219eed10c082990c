// SPDX-License-Identifier: BSD-3-Clause
#include "python/compare.h"

#include "python/families.h"

namespace tonetool::python {

namespace {

void add_pool(Module& module) {
    using S = FlipPool;
    ResultClass<S> result(module, "FlipPool", "Pooled values of an error map.");
    result.field("mean", &S::mean, "Mean of the pixels.")
        .field("weighted_q1", &S::weighted_q1, "A quarter of the error mass lies below it.")
        .field("weighted_median", &S::weighted_median, "Half of the error mass lies below it.")
        .field("weighted_q3", &S::weighted_q3, "Three quarters of the error mass lie below it.")
        .field("p50", &S::p50, "Nearest-rank percentile of the pixels.")
        .field("p95", &S::p95, "Nearest-rank percentile of the pixels.")
        .field("p99", &S::p99, "Nearest-rank percentile of the pixels.")
        .field("p999", &S::p999, "Percentile 99.9 of the pixels.")
        .field("min", &S::min, "Smallest value.")
        .field("max", &S::max, "Largest value.")
        .field("min_x", &S::min_x, "Column of the first smallest value.")
        .field("min_y", &S::min_y, "Row of the first smallest value.")
        .field("max_x", &S::max_x, "Column of the first largest value.")
        .field("max_y", &S::max_y, "Row of the first largest value.")
        .field("histogram", &S::histogram, "Pixels in 100 equal buckets over 0 to 1.")
        .field("pixels", &S::pixels, "Number of pixels.")
        .field("further", &S::further, "What quantities= asked for beside these.")
        .finish();
}

} // namespace

Mask Python<Mask>::from(py::handle v, const std::string& where) {
    if (v.is_none())
        return {};
    auto image = py::reinterpret_borrow<py::object>(v);
    if (!py::isinstance<OIIO::ImageBuf>(v) && !py::isinstance<py::array>(v) &&
        (py::isinstance<py::str>(v) || py::hasattr(v, "__fspath__")))
        return {to_text(v, where), nullptr};
    if (py::isinstance<py::array>(v) && py::array(image).dtype().kind() == 'b')
        image = image.attr("astype")("uint8") * py::int_(UINT8_MAX);
    const auto kept = std::make_shared<InputImage>(image, where, Channels::Named);
    return {"", std::shared_ptr<const OIIO::ImageBuf>(kept, &kept->buf())};
}

void add_compare(Module& module) {
    add_pool(module);
    using S = FlipSide;
    ResultClass<S> result(module, "FlipSide", "How one image was read and what was found in it.");
    visit_side(visitor(result));
    result.finish();
}

} // namespace tonetool::python
