// SPDX-License-Identifier: BSD-3-Clause
// The light groups of a pair, each exchanged between its images.
#include <cmath>

#include "imagebuf/attribute/attribute_tables.h"
#include "imagebuf/compare/flip_run.h"
#include "kernels/curve.h"
#include "metrics/light_ratio.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;

FlipPlan plan_of(const AttributeOptions& options) {
    HdrFlipOptions used = options;
    used.want_exposure_map = used.want_exposures = false;
    used.quantities.clear();
    used.alpha = AlphaPolicy::Ignore;
    used.size = SizePolicy::Match;
    used.memory = 0;
    FlipPlan plan;
    if (options.metric == "hdrflip") {
        plan = plan_hdr(used);
    } else if (options.metric == "ldrflip") {
        plan = plan_ldr(used);
    } else {
        const metrics::ErrorMetric& metric = *metrics::find_error_metric(options.metric);
        ErrorOptions errors;
        static_cast<PairOptions&>(errors) = used;
        errors.start_exposure = options.start_exposure;
        errors.stop_exposure = options.stop_exposure;
        errors.num_exposures = options.num_exposures;
        plan = plan_errors(errors, {metric.kind, options.eps}, metric.has(metrics::kExposures));
    }
    plan.common.pixels = {"", "rec709"}; // what AttributeInput has made of them
    return plan;
}

ImageBuf image_around(const OIIO::ROI& region, const float* rgb) {
    OIIO::ImageSpec spec(region.width(), region.height(), 3, OIIO::TypeFloat);
    spec.x = spec.full_x = region.xbegin;
    spec.y = spec.full_y = region.ybegin;
    return ImageBuf(spec, const_cast<float*>(rgb)); // only read
}

// Light groups, and behind the last of them the rest, so that they add up to the picture.
size_t part_count(const AttributeInput& input) {
    return input.groups().empty() ? 0 : input.groups().size() + 1;
}

// Adds to values [begin, end) of a picture a group of a side, times a factor.
void add_light(const std::vector<float>& light, double factor, size_t begin, size_t end,
               double* to) {
    for (size_t at = begin; at < end && !light.empty(); ++at)
        to[at - begin] += factor * double(light[at]);
}

// The same of any part.
void add_part(const AttributeInput& input, size_t part, size_t side, double factor, size_t begin,
              size_t end, double* to) {
    if (part < input.groups().size())
        return add_light(input.groups()[part].light[side], factor, begin, end, to);
    add_light(input.picture()[side], factor, begin, end, to);
    for (const AttributeInput::Group& group : input.groups())
        add_light(group.light[side], -factor, begin, end, to);
}

metrics::LightRatio ratio_of(const AttributeInput::Group& group, size_t pixels) {
    const auto luminance = [&](size_t side, size_t pixel) {
        const std::vector<float>& light = group.light[side];
        double y = 0;
        for (size_t c = 0; c < 3 && !light.empty(); ++c)
            y += kernels::kLuminance[c] * double(light[3 * pixel + c]);
        return y;
    };
    metrics::LightRatio ratio;
    for (size_t p = 0; p < pixels; ++p)
        ratio.add(luminance(0, p), luminance(1, p));
    return ratio;
}

double light_of(const AttributeInput& input) {
    const std::vector<float>& picture = input.picture()[0];
    double sum = 0;
    for (size_t at = 0; at < picture.size(); ++at)
        if (std::isfinite(picture[at]) && input.counts(at / 3))
            sum += double(kernels::kLuminance[at % 3]) * double(picture[at]);
    return sum;
}

} // namespace

void exchange_lights(const AttributeInput& input, size_t side, const std::vector<size_t>& groups,
                     std::vector<float>& rgb) {
    const std::vector<float>& from = input.picture()[side];
    rgb.resize(from.size());
    constexpr size_t step = 3 * 1024;
    std::array<double, step> values{};
    for (size_t begin = 0; begin < from.size(); begin += step) {
        const size_t end = std::min(begin + step, from.size());
        std::copy(from.begin() + ptrdiff_t(begin), from.begin() + ptrdiff_t(end), values.begin());
        for (const size_t part : groups) {
            add_part(input, part, 1 - side, 1, begin, end, values.data());
            add_part(input, part, side, -1, begin, end, values.data());
        }
        for (size_t at = begin; at < end; ++at)
            rgb[at] = float(values[at - begin]);
    }
}

std::vector<double> ErrorMeter::run(const std::vector<Maker>& tests, std::vector<ImageBuf>& maps) {
    FlipPlan plan = plan_of(m_options);
    plan.common.mask = mask_of(m_input.ignored(), m_input.region());
    plan.common.ignore.clear();
    const OIIO::ROI& region = m_input.region();
    const ImageBuf reference = image_around(region, m_input.picture()[0].data());
    std::vector<std::vector<float>> pixels(tests.size());
    std::vector<ImageBuf> images;
    std::vector<const ImageBuf*> pointers;
    images.reserve(tests.size()); // they stay where they are
    for (size_t t = 0; t < tests.size(); ++t) {
        tests[t](pixels[t]);
        images.push_back(image_around(region, pixels[t].data()));
        pointers.push_back(&images.back());
    }
    std::vector<ImageBuf> dst(tests.size());
    std::vector<ImageBuf*> to;
    for (ImageBuf& one : dst)
        to.push_back(&one);
    std::vector<FlipResult> results;
    run_flip(plan, reference, pointers, to, {}, m_nthreads, maps, results);
    std::vector<double> means;
    for (const FlipResult& result : results)
        means.push_back(result.summary.pool.mean);
    return means;
}

std::vector<double> ErrorMeter::means(const std::vector<Maker>& tests) {
    constexpr uint64_t usual = uint64_t(2) << 30;
    constexpr uint64_t bytes = 12 + 13 + 4; // of a pixel of a test: as made, as planes, its map
    const uint64_t memory = m_options.memory > 0 ? m_options.memory : usual + m_held;
    const uint64_t most = (memory - std::min(memory, m_held)) / (bytes * m_input.pixels());
    const size_t step = size_t(std::clamp<uint64_t>(most, 1, std::max<size_t>(tests.size(), 1)));
    std::vector<double> means;
    for (size_t t = 0; t < tests.size(); t += step) {
        std::vector<ImageBuf> maps;
        const auto first = tests.begin() + ptrdiff_t(t);
        const std::vector<double> some =
            run({first, first + ptrdiff_t(std::min(step, tests.size() - t))}, maps);
        means.insert(means.end(), some.begin(), some.end());
    }
    return means;
}

std::vector<float> ErrorMeter::map() {
    std::vector<ImageBuf> maps;
    run({[&](std::vector<float>& rgb) { rgb = m_input.picture()[1]; }}, maps);
    std::vector<float> error(m_input.pixels());
    if (!maps.front().get_pixels(m_input.region(), OIIO::TypeFloat, error.data()))
        throw Refusal(maps.front().geterror());
    return error;
}

ExchangedLights attribute_lights(const AttributeInput& input, ErrorMeter& meter, double mean,
                                 bool alone) {
    ExchangedLights table;
    table.test = input.picture()[1];
    const size_t parts = part_count(input), groups = input.groups().size();
    std::vector<ErrorMeter::Maker> tests;
    for (const size_t side : {size_t(1), size_t(0)})
        for (size_t part = 0; part < parts && (side == 1 || alone); ++part)
            tests.emplace_back([&input, side, part](std::vector<float>& rgb) {
                exchange_lights(input, side, {part}, rgb);
            });
    const std::vector<double> means = meter.means(tests);
    const double whole = light_of(input);
    std::vector<size_t> found;
    for (size_t part = 0; part < parts; ++part) {
        AttributedLight& light = table.lights.emplace_back();
        light.name = part < groups ? input.groups()[part].name : kLightRest;
        light.mean_replaced = means[part];
        light.explains = mean > 0 ? (mean - light.mean_replaced) / mean : 0;
        if (alone)
            light.mean_alone = means[parts + part];
        if (part == groups)
            continue;
        const metrics::LightRatio ratio = ratio_of(input.groups()[part], input.pixels());
        if (ratio.reference() > 0) {
            light.gain = ratio.gain();
            light.gain_error = ratio.error();
        }
        light.finding = ratio.finding(whole);
        if (!light.finding.empty())
            found.push_back(part);
    }
    exchange_lights(input, 1, found, table.test);
    std::sort(table.lights.begin(), table.lights.end(),
              [](const AttributedLight& a, const AttributedLight& b) {
                  return a.explains != b.explains ? a.explains > b.explains : a.name < b.name;
              });
    findings_first(table.lights);
    return table;
}

} // namespace tonetool
