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

std::string percent(double part) {
    return format("{:.3g} %", 100 * part);
}

// The largest of what was found although the images are equal: a gain, else a number of blocks.
std::string real_text(const BiasResult& result) {
    if (ToneAlgo::bias_evidence(result).empty())
        return "";
    double largest = 0;
    for (const BiasGain& gain : result.gain)
        if (gain.rejected && std::abs(gain.gain) > std::abs(largest))
            largest = gain.gain;
    return largest != 0 ? format("; a difference of {:+.2g} % is real", 100 * largest)
                        : "; smaller differences are real (" +
                              OIIO::Strutil::join(ToneAlgo::bias_evidence(result), "; ") + ")";
}

std::string equal_text(const BiasResult& result) {
    const std::string within = percent(result.options.within);
    switch (result.reason) {
    case BiasReason::Identical:
        return "equal: every pixel is the same";
    case BiasReason::Rounding:
        return "equal: no pixel differs by more than the rounding of half floats";
    case BiasReason::DifferencesWithin:
        return "equal within " + within +
               ": of each block of about 64x64 pixels, the mean of the "
               "absolute differences is at most that, in Y, R, G and B; a smaller object may "
               "differ more" +
               real_text(result);
    default:
        return "equal within " + within + ": with " + percent(1 - result.options.alpha) +
               " confidence the mean light of the picture and of each block of about 64x64 pixels "
               "differs by at most that, in Y, R, G and B; a smaller object may differ more" +
               real_text(result);
    }
}

// Two digits, without an exponent.
std::string times_text(double factor) {
    const double unit = std::pow(10, std::floor(std::log10(factor)) - 1);
    return unit < 1 ? format("{:.2g}", factor) : format("{:.0f}", std::round(factor / unit) * unit);
}

// "the light is 4.8 % lower overall": of the channel that shows it best.
std::string overall_text(const BiasResult& result) {
    std::string channels;
    const BiasGain* clearest = nullptr;
    for (size_t c = 0; c < kBiasChannels; ++c) {
        const BiasGain& gain = result.gain[c];
        if (!gain.rejected)
            continue;
        channels += std::string(channels.empty() ? "" : " ") + kBiasChannelNames[c];
        if (!clearest || std::abs(gain.z) > std::abs(clearest->z))
            clearest = &gain;
    }
    if (!clearest)
        return "";
    return format("the light is {:.2g} % {} overall ({})", 100 * std::abs(clearest->gain),
                  clearest->gain < 0 ? "lower" : "higher", channels);
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

std::string different_text(const BiasResult& result) {
    std::string text;
    for (const std::string& part :
         {overall_text(result), blocks_text(result, "the light differs in ", &BiasScale::rejected),
          blocks_text(result, "edges differ in ", &BiasScale::structures)})
        if (!part.empty())
            text += (text.empty() ? "" : "; ") + part;
    return text;
}

std::string more_text(const BiasResult& result) {
    const std::string within = percent(result.options.within);
    if (!result.more)
        return "; equality within " + within + " is not shown either";
    if (!std::isfinite(*result.more))
        return "; no number of samples shows equality within " + within +
               ", as there is light where the reference has none";
    constexpr double slightly = 1.2;
    return format("; differences above {} are excluded, {} more samples are needed to show "
                  "equality within {}",
                  percent(result.bound),
                  *result.more < slightly ? "slightly"
                                          : "about " + times_text(*result.more) + " times",
                  within);
}

std::string undecided_text(const BiasResult& result) {
    const std::string name = ToneAlgo::bias_verdict_name(result.verdict);
    switch (result.reason) {
    case BiasReason::TooSmall:
        return name + format(": the image has {} pixel(s), which are too few (at least 4096)",
                             int64_t(result.width) * result.height);
    case BiasReason::NonFinite:
        return name + format(": of {} pixel(s), which are NaN or Inf, nothing is known; nothing "
                             "else keeps the images from being equal",
                             result.nonfinite);
    case BiasReason::Correlated:
        return name + ": neighbouring pixels are correlated (denoised or filtered?): give "
                      "undenoised renders";
    default:
        return name + ": no difference beyond the noise" + more_text(result);
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

std::vector<std::string> bias_evidence(const BiasResult& result) {
    return metrics::bias_evidence(result);
}

std::string bias_sentence(const BiasResult& result) {
    switch (result.verdict) {
    case BiasVerdict::Equal:
        return equal_text(result);
    case BiasVerdict::Different:
        return "different: " + different_text(result);
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
