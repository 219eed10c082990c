// SPDX-License-Identifier: BSD-3-Clause
// Other errors and scores of a test image against a reference.
#include "chain/commands/attribute_args.h"
#include "chain/commands/comparing.h"
#include "chain/commands/frame_pictures.h"
#include "metrics/errors.h"

namespace tonetool::chain {

namespace {

Limits read_errormap(Session& session, const Call& call, ErrorOptions& options) {
    options = error_options(session, call);
    const metrics::ErrorMetric& metric = *metrics::find_error_metric(options.metric);
    return limits_of(session, call, error_measures(metric), options.quantities);
}

void check_errormap(Session& session, const Call& call) {
    ErrorOptions options;
    (void)read_errormap(session, call, options);
    (void)attribute_options(call, options);
}

void run_errormap(Session& session, const Call& call) {
    ErrorOptions options;
    const Limits limits = read_errormap(session, call, options);
    const metrics::ErrorMetric& metric = *metrics::find_error_metric(options.metric);
    std::vector<ErrorSummary> summaries(size_t(test_count(call)));
    auto [views, maps] = compare_tests(
        session, call, same_look(call, test_count(call) > 1),
        [&](Maps& to, auto& reference, auto& tests) {
            for (size_t i = 0; i < tests.size(); ++i) {
                if (!ToneAlgo::error_map(to[i], reference, *tests[i], options, &summaries[i])) {
                    std::swap(to[0], to[i]); // the one whose error is told
                    return false;
                }
            }
            return true;
        });
    for (size_t i = 0; i < maps.size(); ++i) {
        const ErrorSummary& summary = summaries[i];
        tell_summary(session, call, summary, limits, i);
        const auto measured = [&](const std::string& quantity) {
            return ToneAlgo::flip_quantity(summary.pool, quantity).value_or(summary.value);
        };
        judge(session, call, limits, measured,
              sequence::Position{summary.pool.max_x, summary.pool.max_y}, i, summary.ignored);
        attribute_error(session, call, attribute_options(call, options), maps[i], i);
        sequence::PictureRequest request = pair_request(views, i);
        request.look.pixels = options.pixels;
        request.look.size = options.size;
        request.exposures = summary.exposures;
        (metric.has(metrics::kBounded) ? request.error : request.unbounded) = &maps[i];
        show(session, call, std::move(request));
        push_map(session, call, std::move(maps[i]));
    }
}

Measures tmqi_measures() {
    return {ToneAlgo::tmqi_quantities(), false};
}

void check_tmqi(Session& session, const Call& call) {
    Strings none;
    (void)limits_of(session, call, tmqi_measures(), none);
}

void run_tmqi(Session& session, const Call& call) {
    TmqiOptions options{pixel_options(call), pixel_options(call, "ldr"), call.flag("crop", false),
                        session.settings.memory};
    Strings none;
    const Limits limits = limits_of(session, call, tmqi_measures(), none);
    TmqiSummary summary;
    auto [views, maps] = compare_tests(
        session, call, {options.hdr, options.ldr, false}, [&](Maps& to, auto& hdr, auto& tests) {
            return ToneAlgo::tmqi(to[0], hdr, *tests[0], options, &summary);
        });
    tell_summary(session, call, summary, limits);
    const auto measured = [&](const std::string& quantity) {
        return ToneAlgo::tmqi_quantity(summary.score, quantity).value();
    };
    judge(session, call, limits, measured, {});
    push_map(session, call, std::move(maps[0]));
}

// ---- rows

Row tmqi_row() {
    return command("tmqi", "TMQI of a tone-mapped picture: HDR image, picture -> structure map",
                   run_tmqi)
        .checked(check_tmqi)
        .images(2, 1)
        .modifier("layer", "NAME", "layer of the HDR image whose R,G,B are used")
        .modifier("from", "SPACE", "colour space of the HDR image")
        .modifier("ldrlayer", "NAME", "layer of the picture")
        .modifier("ldrfrom", "SPACE", "colour space of the picture (sRGB for integers)")
        .modifier("crop", "0|1", "compare only where the display windows meet")
        .modifiers(threshold_modifiers(tmqi_measures(), "at least X (0 to 1; higher is better)"))
        .frequent("fail,warn,layer,ldrlayer");
}

} // namespace

Rows metric_commands() {
    return {command("errormap", "An error by pixel: reference, test -> error map", run_errormap)
                .checked(check_errormap)
                .images(2, 1)
                .images_of(compared_pops, test_count)
                .modifiers(error_modifiers(), attribute_modifiers())
                .modifier("tests", "K", "compare K tests with the one reference below them")
                .frequent("metric,fail,warn,layer,from"),
            tmqi_row()};
}

} // namespace tonetool::chain
