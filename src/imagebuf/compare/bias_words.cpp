// SPDX-License-Identifier: BSD-3-Clause
// What bias_check() and noise_floor() have found, in words and by name.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/options/bias_options.h"
#include "imagebuf/pixels/guard.h"
#include "metrics/bias.h"
#include "metrics/noise_floor.h"
#include "tonetool/bias.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// At least two digits, without an exponent.
std::string plain(double value) {
    const double size = std::abs(value);
    if (!(size >= 100))
        return format("{:.3g}", value);
    const double unit = std::pow(10, std::floor(std::log10(size)) - 1);
    return format("{:.0f}", std::round(value / unit) * unit);
}

std::string times(double factor) {
    return factor < 100 ? format("{:.2g}", factor) : plain(factor);
}

std::string percent(double part) {
    return plain(100 * part) + " %";
}

std::string signed_percent(double part) {
    const double size = 100 * std::abs(part);
    return (part < 0 ? "-" : "+") + (size < 99.5 ? format("{:.2g}", size) : plain(size)) + " %";
}

// "light overall: Y -4.8 %, R -4.1 %"
std::string overall_text(const BiasResult& result) {
    std::string text;
    for (size_t c = 0; c < kBiasChannels; ++c) {
        const BiasGain& gain = result.gain[c];
        if (gain.rejected)
            text += std::string(text.empty() ? "light overall: " : ", ") + kBiasChannelNames[c] +
                    " " + signed_percent(gain.gain);
    }
    return text;
}

// "the light differs in 2 of 40 blocks of 16 pixels, 5 of 8 of 32"
std::string blocks_text(const BiasResult& result, const char* what, int64_t BiasScale::*count) {
    std::string text;
    for (const BiasScale& scale : result.scales) {
        if (scale.*count == 0)
            continue;
        const bool first = text.empty();
        text += format("{}{} of {} {}{}{}", first ? "" : ", ", scale.*count, scale.blocks(),
                       first ? "blocks of " : "of ", scale.block, first ? " pixels" : "");
    }
    return text.empty() ? "" : what + text;
}

std::string place_text(const BiasResult& result) {
    const auto place = ToneAlgo::bias_place(result);
    return place
               ? format("most at {},{}: {}", place->x, place->y, signed_percent(place->difference))
               : "";
}

std::string found_text(const BiasResult& result) {
    std::string text;
    for (const std::string& part :
         {overall_text(result), blocks_text(result, "the light differs in ", &BiasScale::rejected),
          place_text(result), blocks_text(result, "edges differ in ", &BiasScale::structures)})
        if (!part.empty())
            text += (text.empty() ? "" : "; ") + part;
    return text;
}

// What was found although the images are equal.
std::string real_text(const BiasResult& result) {
    const std::string found = found_text(result);
    return found.empty() ? "" : "; differences that are smaller are real: " + found;
}

std::string equal_text(const BiasResult& result) {
    const std::string within = percent(result.options.within);
    switch (result.reason) {
    case BiasReason::Identical:
        return std::string("equal: every pixel") + (result.ignored > 0 ? " that counts" : "") +
               " is the same";
    case BiasReason::Rounding:
        return "equal: no pixel differs by more than the rounding of half floats";
    case BiasReason::DifferencesWithin:
        return "equal within " + within +
               ": of each block of about 64x64 pixels, the mean of the "
               "absolute differences is at most that, in Y, R, G and B; a smaller object may "
               "differ more" +
               real_text(result);
    default:
        return "equal within " + within + ": with " +
               format("{:.6g} %", 100 * (1 - result.options.alpha)) +
               " confidence the mean light of the picture and of each block of about 64x64 pixels "
               "differs by at most that, in Y, R, G and B; a smaller object may differ more" +
               real_text(result);
    }
}

std::string more_text(const BiasResult& result) {
    const std::string within = percent(result.options.within);
    if (!result.more)
        return "; equality within " + within + " is not shown either";
    constexpr double hopeless = 1e6;
    if (!(*result.more < hopeless))
        return "; no number of samples shows equality within " + within +
               ", as there is light where the reference has next to none";
    constexpr double slightly = 1.2;
    return format("; differences above {} in blocks of about 64x64 pixels are excluded, {} more "
                  "samples are needed to show "
                  "equality within {}",
                  percent(result.bound),
                  *result.more < slightly ? "slightly" : "about " + times(*result.more) + " times",
                  within);
}

std::string unknown_text(const BiasResult& result) {
    return result.nonfinite == 0
               ? ""
               : format("; of {} pixel(s), which are NaN or Inf, nothing is known",
                        result.nonfinite);
}

std::string undecided_text(const BiasResult& result) {
    const std::string name = ToneAlgo::bias_verdict_name(result.verdict);
    switch (result.reason) {
    case BiasReason::TooSmall:
        return name + format(": the image has {} pixel(s){} (at least 4096)",
                             int64_t(result.width) * result.height - result.ignored,
                             result.ignored > 0 ? " that count, which are too few or too scattered"
                                                : ", which are too few");
    case BiasReason::NonFinite:
        return name + format(": of {} pixel(s), which are NaN or Inf, nothing is known; nothing "
                             "else keeps the images from being equal",
                             result.nonfinite);
    case BiasReason::Correlated:
        return name + ": neighbouring pixels are correlated (denoised or filtered?): give "
                      "undenoised renders";
    default:
        return name + ": no difference beyond the noise" + more_text(result) + unknown_text(result);
    }
}

} // namespace

namespace ToneAlgo {

std::string bias_verdict_name(BiasVerdict verdict) {
    switch (verdict) {
    case BiasVerdict::Different:
        return "different";
    case BiasVerdict::Equal:
        return "equal";
    case BiasVerdict::NotEnoughSamples:
        break;
    }
    return "not enough samples";
}

std::string bias_reason_name(BiasReason reason) {
    static const char* const names[] = {
        "evidence",          "identical",          "rounding",
        "means within",      "differences within", "image too small",
        "non-finite pixels", "correlated pixels",  "undecided"};
    return names[size_t(reason)];
}

std::optional<BiasPlace> bias_place(const BiasResult& result) {
    std::optional<BiasPlace> worst;
    for (const BiasScale& scale : result.scales) {
        for (size_t at = 0; at < size_t(scale.blocks()) && scale.rejected > 0; ++at) {
            const BiasScale::Channel* channel = metrics::rejected_channel(scale, at);
            if (!channel)
                continue;
            const double base = std::max(channel->level[at], result.dark);
            const double difference = base > 0 ? channel->mean[at] / base : 0;
            if (worst && std::abs(difference) <= std::abs(worst->difference))
                continue;
            const size_t row = at / size_t(scale.columns()), column = at % size_t(scale.columns());
            worst = {result.x + (scale.x[column] + scale.x[column + 1]) / 2,
                     result.y + (scale.y[row] + scale.y[row + 1]) / 2, difference};
        }
        if (worst)
            break; // the finest blocks that differ
    }
    return worst;
}

std::vector<std::string> bias_evidence(const BiasResult& result) {
    return metrics::bias_evidence(result);
}

std::string bias_sentence(const BiasResult& result) {
    switch (result.verdict) {
    case BiasVerdict::Equal:
        return equal_text(result);
    case BiasVerdict::Different:
        return "different: " + found_text(result) + unknown_text(result);
    case BiasVerdict::NotEnoughSamples:
        break;
    }
    return undecided_text(result);
}

std::vector<std::pair<std::string, double>> bias_numbers(const BiasResult& r) {
    std::vector<std::pair<std::string, double>> numbers;
    const auto add = [&](const std::string& name, double value) {
        numbers.emplace_back(name, value);
    };
    add("bound", r.bound);
    add("shown", r.shown);
    add("references", r.references);
    add("tests", r.tests);
    add("nonfinite", double(r.nonfinite));
    if (!r.judged)
        return numbers;
    if (r.more)
        add("more", *r.more);
    add("absolute", r.absolute);
    add("asymmetry", r.asymmetry);
    add("unlike", r.unlike);
    add("correlation", r.correlation);
    add("correlated", r.correlated ? 1 : 0);
    add("untested", double(r.untested));
    add("block-tests", double(r.tested));
    for (size_t c = 0; c < kBiasChannels; ++c) {
        const std::string channel = std::string(".") + kBiasChannelNames[c];
        const BiasGain& gain = r.gain[c];
        add("gain" + channel, gain.gain);
        add("gain-se" + channel, gain.se);
        add("z" + channel, gain.z);
        add("p" + channel, gain.p);
        add("energy" + channel, gain.energy);
        add("energy-se" + channel, gain.energy_se);
        add("rare" + channel, r.rare[c]);
    }
    return numbers;
}

bool noise_floor(NoiseFloor& floor, const std::vector<double>& values,
                 const NoiseFloorOptions& options, std::string& error) {
    return contained(error, [&] {
        check_options(options);
        floor = metrics::noise_floor(values, options);
    });
}

std::string noise_floor_method(const NoiseFloor& floor) {
    switch (floor.method) {
    case NoiseFloorMethod::OrderStatistic:
        return format("order statistic {} of {}", floor.rank, floor.values);
    case NoiseFloorMethod::Lognormal:
        return format("lognormal, k {:.4f}", floor.k);
    case NoiseFloorMethod::Normal:
        break;
    }
    return format("normal, k {:.4f}", floor.k);
}

} // namespace ToneAlgo
} // namespace tonetool
