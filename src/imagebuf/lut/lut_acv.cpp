// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lut/lut_acv.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/pixels/colorimetry.h"
#include "metrics/refusal.h"
#include "tonemap/curves.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

constexpr size_t kMostPoints = 16;
constexpr int kLastCode = 255;

void put16(std::string& bytes, int value) {
    bytes += char(value >> 8);
    bytes += char(value & 255);
}

void put_curve(std::string& bytes, const AcvPoints& points) {
    put16(bytes, int(points.size()));
    for (const auto& [input, output] : points) {
        put16(bytes, output);
        put16(bytes, input);
    }
}

// Second derivatives at the points of a natural cubic spline, by elimination.
std::vector<double> bends_of(const AcvPoints& points) {
    const size_t n = points.size();
    std::vector<double> bends(n, 0.0), share(n, 0.0);
    for (size_t i = 1; i + 1 < n; ++i) {
        const double before = points[i].first - points[i - 1].first;
        const double behind = points[i + 1].first - points[i].first;
        const double turn = (points[i + 1].second - points[i].second) / behind -
                            (points[i].second - points[i - 1].second) / before;
        const double pivot = 2 * (before + behind) - before * share[i - 1];
        share[i] = behind / pivot;
        bends[i] = (6 * turn - before * bends[i - 1]) / pivot;
    }
    for (size_t i = n - 1; i-- > 1;)
        bends[i] -= share[i] * bends[i + 1];
    return bends;
}

double worst_of(const AcvCodes& a, const AcvCodes& b) {
    double worst = 0;
    for (size_t i = 0; i < a.size(); ++i)
        worst = std::max(worst, std::abs(a[i] - b[i]));
    return worst;
}

// The code value that is no point yet and is missed most.
int missed_most(const AcvPoints& points, const AcvCodes& codes, const AcvCodes& spline) {
    int worst = -1;
    double most = -1;
    for (int i = 0; i <= kLastCode; ++i) {
        const double off = std::abs(codes[size_t(i)] - spline[size_t(i)]);
        const bool there = std::any_of(points.begin(), points.end(),
                                       [&](const auto& point) { return point.first == i; });
        if (!there && off > most) {
            most = off;
            worst = i;
        }
    }
    return worst;
}

AcvCodes codes_of(const LutSource& source, int channel, double white) {
    AcvCodes codes;
    for (size_t i = 0; i < codes.size(); ++i) {
        const double light = white * srgb_to_linear(double(i) / kLastCode);
        codes[i] = kLastCode * source.encoded(source.inner(channel, light));
    }
    return codes;
}

// The scene light of the last code value.
double white_of(const LutOptions& options, const LutSource& source) {
    const auto& parameters = source.curve().parameters;
    const auto own = parameters.find("white");
    if (options.white == 0)
        return own == parameters.end() ? 1 : own->second;
    if (!(options.white >= tonemap::kLeastWhite && options.white <= tonemap::kMostWhite))
        throw Refusal(format("white is {}: must be {} to {}", options.white, tonemap::kLeastWhite,
                             tonemap::kMostWhite));
    return options.white;
}

void check_source(const LutOptions& options, const LutSource& source) {
    if (options.view || source.curve().on == "color")
        throw Refusal(source.name() + ": an .acv file has a curve per channel, but this mixes the "
                                      "channels; valid: .cube, .spi3d, .clf, .ctf");
    const LutOptions usual;
    if (options.shaper != usual.shaper || options.size != usual.size || options.min != usual.min ||
        options.max != usual.max)
        throw Refusal("shaper, min, max and size do not apply to .acv, whose input is code values");
}

void measure_acv(const AcvCodes& codes, const AcvPoints& points, LutSummary& summary) {
    const AcvCodes spline = acv_spline(points);
    summary.max_error = std::max(summary.max_error, worst_of(codes, spline) / kLastCode);
    for (size_t i = 0; i < codes.size(); ++i)
        summary.mean_error += std::abs(codes[i] - spline[i]) / kLastCode;
    summary.samples += int64_t(codes.size());
}

} // namespace

std::string acv_bytes(const AcvPoints& composite, const std::array<AcvPoints, 3>& channels) {
    constexpr int version = 4, count = 5;
    std::string bytes;
    put16(bytes, version);
    put16(bytes, count);
    put_curve(bytes, composite);
    for (const AcvPoints& points : channels)
        put_curve(bytes, points);
    put_curve(bytes, {{0, 0}, {kLastCode, kLastCode}});
    return bytes;
}

AcvCodes acv_spline(const AcvPoints& points) {
    const std::vector<double> bends = bends_of(points);
    AcvCodes codes;
    for (size_t i = 0; i + 1 < points.size(); ++i) {
        const double from = points[i].first, run = points[i + 1].first - from;
        for (int x = points[i].first; x <= points[i + 1].first; ++x) {
            const double b = (x - from) / run, a = 1 - b;
            const double y =
                a * points[i].second + b * points[i + 1].second +
                ((a * a * a - a) * bends[i] + (b * b * b - b) * bends[i + 1]) * run * run / 6;
            codes[size_t(x)] = std::clamp(y, 0.0, double(kLastCode));
        }
    }
    return codes;
}

// Where it is missed most, a point is added; of all these the closest.
AcvPoints acv_points(const AcvCodes& codes) {
    const auto point = [&](int x) { return std::pair(x, int(std::lround(codes[size_t(x)]))); };
    AcvPoints points = {point(0), point(kLastCode)}, best = points;
    AcvCodes spline = acv_spline(points);
    double least = worst_of(codes, spline);
    while (points.size() < kMostPoints) {
        const auto added = point(missed_most(points, codes, spline));
        points.insert(std::lower_bound(points.begin(), points.end(), added), added);
        spline = acv_spline(points);
        if (const double off = worst_of(codes, spline); off < least) {
            least = off;
            best = points;
        }
    }
    return best;
}

std::string make_acv(const LutOptions& options, const LutSource& source, LutSummary& summary) {
    check_source(options, source);
    const double white = white_of(options, source);
    std::array<AcvPoints, 3> points;
    std::array<AcvCodes, 3> codes;
    for (size_t c = 0; c < 3; ++c) {
        codes[c] = codes_of(source, int(c), white);
        points[c] = acv_points(codes[c]);
    }
    const bool alike = codes[0] == codes[1] && codes[0] == codes[2];
    for (size_t c = 0; c < (alike ? 1u : 3u); ++c)
        measure_acv(codes[c], points[c], summary);
    summary.mean_error /= double(summary.samples);
    summary.grey_max_error = summary.max_error;
    summary.high = white;
    summary.structure = format("{} points", points[0].size());
    summary.input = format("code values of sRGB, 255 of light {:g}", white);
    const AcvPoints same = {{0, 0}, {kLastCode, kLastCode}};
    return alike ? acv_bytes(points[0], {same, same, same}) : acv_bytes(same, points);
}

} // namespace tonetool
