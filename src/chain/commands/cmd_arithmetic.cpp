// SPDX-License-Identifier: BSD-3-Clause
// Arithmetic on pixel values, with constants and with other images.
#include <limits>

#include "chain/commands/commands.h"
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

constexpr float kLargest = std::numeric_limits<float>::max();

bool invert(Op& op) {
    OIIO::ROI roi = op.a().roi();
    roi.chend = std::min(3, roi.chend);
    roi.chbegin = op.integer("chbegin", roi.chbegin);
    roi.chend = op.integer("chend", roi.chend);
    return op.dst.copy(op.a()) && IBA::invert(op.dst, op.dst, roi);
}

bool noise(Op& op) {
    return op.dst.copy(op.a()) && add_noise(op, false);
}

bool contrast(Op& op) {
    const auto given = [&](const char* key, float otherwise) {
        return op.call.has(key) ? op.list(key, op.text(key)) : Floats{otherwise};
    };
    const Floats low = given("min", 0), high = given("max", 1);
    bool done = IBA::contrast_remap(op.dst, op.a(), given("black", 0), given("white", 1), low, high,
                                    given("scontrast", 1), given("sthresh", 0.5F));
    if (op.call.has("gamma"))
        op.session.warning(op.call.text(), "gamma= has no effect, as in oiiotool (--powc has)");
    return done && (!op.flag("clamp") || IBA::clamp(op.dst, op.dst, low, high));
}

bool clamp(Op& op) {
    return IBA::clamp(op.dst, op.a(), op.values("min", -kLargest), op.values("max", kLargest),
                      op.flag("clampalpha"));
}

const Modifiers kLuma = {{"luma", "0|1", "on luminance instead of each channel"}};
const Modifiers kLimits = {{"min", "VALUES", "lowest value, one or one per channel"},
                           {"max", "VALUES", "highest value, one or one per channel"}};

const Rows kArithmeticRows = {
    on_pixels("addc|cadd VALUES", 1, "Add a constant (0.5) or one per channel (1,1.25,0.5)",
              of_constants<IBA::add, 0>)
        .keeps_header(),
    on_pixels("subc|csub VALUES", 1, "Subtract a constant or one per channel",
              of_constants<IBA::sub, 0>)
        .keeps_header(),
    on_pixels("mulc|cmul VALUES", 1, "Multiply by a constant or one per channel",
              of_constants<IBA::mul, 1>)
        .keeps_header(),
    on_pixels("divc VALUES", 1, "Divide by a constant or one per channel",
              of_constants<IBA::div, 1>)
        .keeps_header(),
    on_pixels("absdiffc VALUES", 1, "Absolute difference to a constant or one per channel",
              of_constants<IBA::absdiff, 0>)
        .keeps_header(),
    on_pixels("powc|cpow VALUES", 1, "Raise to a power or one per channel",
              [](Op& op) { return IBA::pow(op.dst, op.a(), op.constants(1)); })
        .keeps_header(),
    on_pixels("maxc VALUES", 1, "The larger of the values and a constant or one per channel",
              of_constants<IBA::max, 0>)
        .keeps_header(),
    on_pixels("minc VALUES", 1, "The smaller of the values and a constant or one per channel",
              of_constants<IBA::min, 0>)
        .keeps_header(),
    on_pixels("add", 2, "Add two images", of_two<IBA::add>),
    on_pixels("sub", 2, "Subtract the second image from the first", of_two<IBA::sub>),
    on_pixels("mul", 2, "Multiply two images", of_two<IBA::mul>),
    on_pixels("div", 2, "Divide the first image by the second", of_two<IBA::div>),
    on_pixels("mad", 3, "Multiply two images and add a third",
              [](Op& op) { return IBA::mad(op.dst, op.a(), op.b(), op.c()); }),
    on_pixels("absdiff", 2, "Absolute difference of two images", of_two<IBA::absdiff>),
    on_pixels("max", 2, "The larger value of two images, pixel by pixel", of_two<IBA::max>),
    on_pixels("min", 2, "The smaller value of two images, pixel by pixel", of_two<IBA::min>),
    on_pixels("abs", 1, "Absolute value", of_one<IBA::abs>).keeps_header(),
    on_pixels("invert", 1, "Subtract the colour from 1", invert)
        .modifier("chbegin", "N", "first channel (0)")
        .modifier("chend", "N", "one past the last channel (3)")
        .keeps_header(),
    on_pixels("maxchan", 1, "The largest of the channels of each pixel", of_one<IBA::maxchan>),
    on_pixels("minchan", 1, "The smallest of the channels of each pixel", of_one<IBA::minchan>),
    on_pixels("chsum", 1, "Sum of the channels",
              [](Op& op) { return IBA::channel_sum(op.dst, op.a(), op.values("weight", 1)); })
        .modifier("weight", "VALUES", "weight of each channel (1)"),
    on_pixels("clamp", 1, "Clamp the values", clamp, Scope::Levels)
        .modifiers(kLimits)
        .modifier("clampalpha", "0|1", "alpha to 0..1")
        .operation("")
        .keeps_header(),
    on_pixels("contrast", 1, "Remap black to min and white to max, with a contrast curve", contrast)
        .modifiers(kLimits)
        .modifier("black", "VALUES", "what becomes min (0)")
        .modifier("white", "VALUES", "what becomes max (1)")
        .modifier("sthresh", "VALUES", "middle of the curve (0.5)")
        .modifier("scontrast", "VALUES", "its slope (1: none)")
        .modifier("gamma", "VALUES", "has no effect")
        .modifier("clamp", "0|1", "clamp to min..max"),
    on_pixels("saturate SCALE", 1, "Scale the saturation (0: grey)",
              [](Op& op) { return IBA::saturate(op.dst, op.a(), op.number(0)); })
        .keeps_header(),
    on_pixels("rangecompress", 1, "Compress values beyond 1 by a logarithm",
              [](Op& op) { return IBA::rangecompress(op.dst, op.a(), op.flag("luma")); })
        .modifiers(kLuma),
    on_pixels("rangeexpand", 1, "Undo --rangecompress",
              [](Op& op) { return IBA::rangeexpand(op.dst, op.a(), op.flag("luma")); })
        .modifiers(kLuma),
    on_pixels("noise", 1, "Add noise", noise)
        .modifiers(noise_modifiers())
        .modifier("nchannels", "N", "channels that get noise"),
    on_pixels("premult", 1, "Multiply the colour by alpha", of_one<IBA::premult>),
    on_pixels("unpremult", 1, "Divide the colour by alpha", of_one<IBA::unpremult>),
    on_pixels("repremult", 1, "Multiply the colour by alpha, but keep it where alpha is 0",
              of_one<IBA::repremult>),
};

} // namespace

bool add_noise(Op& op, bool to_blank) {
    const float middle = to_blank ? 0.5F : 0;
    const struct {
        const char *type, *first, *second;
        float first_value, second_value;
    } kinds[] = {{"gaussian", "mean", "stddev", middle, 0.1F},
                 {"uniform", "min", "max", middle, to_blank ? 1 : 0.1F},
                 {"white", "min", "max", middle, to_blank ? 1 : 0.1F},
                 {"blue", "min", "max", middle, to_blank ? 1 : 0.1F},
                 {"salt", "value", "portion", 0, to_blank ? 0.1F : 0.01F}};
    const std::string type = op.text("type", "gaussian");
    OIIO::ROI roi = op.dst.roi();
    if (!to_blank)
        roi.chend = std::min(roi.chend, op.integer("nchannels", roi.chend));
    for (const auto& kind : kinds) {
        if (type == kind.type) {
            return IBA::noise(op.dst, type, op.number(kind.first, kind.first_value),
                              op.number(kind.second, kind.second_value), op.flag("mono"),
                              op.integer("seed", 0), roi);
        }
    }
    throw CommandError(
        "Unknown noise type \"" + type + "\"" +
        (op.session.settings.compat ? "" : " (valid: gaussian, uniform, white, blue, salt)"));
}

Modifiers noise_modifiers() {
    return {{"type", "gaussian|uniform|white|blue|salt", "kind (gaussian)"},
            {"mean", "X", "of gaussian noise (0)"},
            {"stddev", "X", "of gaussian noise (0.1)"},
            {"min", "X", "of uniform noise (0)"},
            {"max", "X", "of uniform noise (0.1)"},
            {"value", "X", "of salt noise (0)"},
            {"portion", "X", "of pixels with salt (0.01)"},
            {"mono", "0|1", "the same in all channels"},
            {"seed", "N", "seed (0)"}};
}

Rows arithmetic_commands() {
    return kArithmeticRows;
}

} // namespace tonetool::chain
