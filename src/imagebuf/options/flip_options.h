// SPDX-License-Identifier: BSD-3-Clause
// The fields of FlipOptions, HdrFlipOptions and ErrorOptions that are numbers,
// names or switches; pixels, curve and view are structs of their own.
#pragma once

#include "flip/exposures.h"
#include "flip/filters.h"
#include "imagebuf/options/option.h"
#include "metrics/errors.h"
#include "tonetool/errors.h"
#include "tonetool/flip.h"

namespace tonetool {

inline constexpr Range kPpdRange{flip::kMinPixelsPerDegree, flip::kMaxPixelsPerDegree};
inline constexpr Range kPeakRange{1, 10000}; ///< of a display, in cd/m2
/// How the result of a view can be encoded.
inline const std::vector<std::string> kViewEncodings = {"srgb", "rec1886", "gamma2.2", "gamma2.6",
                                                        "linear"};
inline constexpr Range kStopsRange{flip::kMinStops, flip::kMaxStops};

/// The screen: of LDR-FLIP and HDR-FLIP.
template <class See>
void describe(const FlipOptions&, See&& see) {
    using O = FlipOptions;
    see(option("ppd", &O::ppd, "pixels per degree of visual angle")
            .within(kPpdRange.low, kPpdRange.high)
            .in("pixels per degree")
            .unset("of the three numbers below"));
    see(option("distance", &O::distance, "viewing distance in metres")
            .within(1e-6, 1e6)
            .in("metres")
            .shown_as("METRES"));
    see(option("width", &O::width, "width of the screen in metres")
            .within(1e-6, 1e6)
            .in("metres")
            .shown_as("METRES"));
    see(option("pixels", "pixels_across", &O::pixels_across, "width of the screen in pixels")
            .within(1, 1e7)
            .in("pixels")
            .shown_as("N"));
}

/// start_exposure, stop_exposure and num_exposures of any struct that has them.
template <class Options, class See>
void describe_exposures(See&& see, const std::string& start, const std::string& stop,
                        const std::string& number) {
    see(option("startExposure", "start_exposure", &Options::start_exposure,
               "first exposure in stops")
            .within(kStopsRange.low, kStopsRange.high)
            .in("stops")
            .shown_as("STOPS")
            .unset(start));
    see(option("stopExposure", "stop_exposure", &Options::stop_exposure, "last exposure in stops")
            .within(kStopsRange.low, kStopsRange.high)
            .in("stops")
            .shown_as("STOPS")
            .unset(stop));
    see(option("numExposures", "num_exposures", &Options::num_exposures, "number of exposures")
            .within(1, flip::kMaxExposures)
            .unset(number));
}

/// How the images are shown, and at which exposures: of HDR-FLIP alone.
template <class See>
void describe(const HdrFlipOptions&, See&& see) {
    using O = HdrFlipOptions;
    see(option("encoding", &O::encoding,
               "how the view's result is encoded, where its display does not say so")
            .one_of(kViewEncodings)
            .unset("the display's"));
    see(option("peak", &O::peak,
               "luminance in cd/m2 that counts as the display's white; HDR displays need it")
            .within(kPeakRange.low, kPeakRange.high)
            .in("cd/m2")
            .unset("of SDR displays"));
    see(option("exact", &O::exact,
               "the view by OpenColorIO itself for each pixel instead of a table baked from it"));
    describe_exposures<O>(see, "from the reference's maximum, paper Eq. 2",
                          "from the reference's median, paper Eq. 3", "max(2, ceil(last - first))");
    see(option("maxluminance", "max_luminance", &O::max_luminance,
               "maximum luminance that the first exposure is made from")
            .positive()
            .unset("the reference's"));
    see(option("medianluminance", "median_luminance", &O::median_luminance,
               "median luminance that the last exposure is made from")
            .positive()
            .unset("the reference's"));
}

/// Names of the error metrics that have an option, or another trait.
inline std::vector<std::string> metrics_that_have(metrics::ErrorTrait trait) {
    std::vector<std::string> names;
    for (const metrics::ErrorMetric& metric : metrics::kErrorMetrics)
        if (metric.has(trait))
            names.emplace_back(metric.name);
    return names;
}

template <class See>
void describe(const ErrorOptions&, See&& see) {
    using O = ErrorOptions;
    const auto of = [](metrics::ErrorTrait trait) {
        return "of " + OIIO::Strutil::join(metrics_that_have(trait), ", ");
    };
    const std::string exposures = of(metrics::kExposures) + " alone; as hdrflip";
    see(option("metric", &O::metric, "error metric").one_of(ToneAlgo::error_metrics()));
    // Beyond these the squares leave what a double tells apart.
    see(option("eps", &O::eps, "epsilon " + of(metrics::kEps)).within(1e-12, 1e12));
    see(option("peak", &O::peak, "peak " + of(metrics::kPeak) + " in linear light")
            .within(1e-12, 1e12));
    describe_exposures<O>(see, exposures, exposures, exposures);
}

} // namespace tonetool
