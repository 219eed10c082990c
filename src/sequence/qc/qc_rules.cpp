// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/qc/qc_rules.h"

#include "tonetool/lights.h"

namespace tonetool::sequence {

const FaultRules& qc_rules() {
    constexpr Severity error = Severity::Error, warning = Severity::Warning, info = Severity::Info;
    static const FaultRules rules = {
        {"missing", error, {}, "", "frames that do not exist"},
        {"black", error, 0.0, "largest value", "the image is black"},
        {"constant", error, {}, "", "the image is one colour"},
        {"missinglayer", error, {}, "", "a layer that other frames have is missing"},
        {"blacklayer", error, {}, "", "a layer is black, but not in the frame before or after"},
        {"nan", error, 0.0, "pixels", "NaN, in any layer"},
        {"inf", error, 0.0, "pixels", "infinite values, in any layer but depths"},
        {"lightsum", error, LightIndexSummary::kMostDifference, "share of the light",
         "light groups that do not add up to the beauty"},
        {"channels", error, {}, "", "channels differ from those of other frames"},
        {"displaywindow", error, {}, "", "the display window differs from other frames'"},
        {"hole", error, 0.0, "pixels",
         "a block of one exact value that is not in the frames around it"},
        {"frozen", error, 3.0, "frames", "more frames than these show one moment"},
        {"stalebucket", error, {}, "", "a rectangle of pixels that are those of another frame"},
        {"repeat", error, {}, "", "the moment of an earlier frame again, after others"},
        {"firefly", warning, 50.0, "times the neighbourhood",
         "lone bright pixels that are neither in their neighbourhood nor in other frames"},
        {"flicker", warning, 0.2, "stops", "frames that differ from both of their neighbours"},
        {"light", warning, 0.06, "stops",
         "frames that are brighter or darker than those around them; at four times of it a step "
         "that lasts"},
        {"duplicate",
         warning,
         {},
         "",
         "a moment that is shown twice (not in a still, not on twos)"},
        {"nearduplicate", warning, 0.1, "of the change around it",
         "a frozen frame: nothing moves, although it does before and after"},
        {"negative", warning, 0.0, "below 0", "negative values in the beauty or its light groups"},
        {"alpha", warning, 0.0, "pixels", "alpha outside [0, 1] by more than 0.001"},
        {"alphaempty", error, 0.9, "share of the non-black pixels",
         "alpha is 0 where the beauty is not black, which hides it"},
        {"tint", warning, 0.06, "stops", "the same of red and blue over green; a step at twice"},
        {"saturation", warning, 0.02, "of 1", "the same of the saturation; a step at four times"},
        {"noise", warning, 0.35, "octaves", "the same of the noise; a step at 1.4 times"},
        {"sharpness", warning, 0.25, "octaves",
         "the same of the contrast of neighbours over that of 2 x 2 pixels; a step at 1.4 times"},
        {"blur", warning, 0.2, "octaves",
         "the same of the contrast across over that down; a step at 1.5 times"},
        {"alphalevel", warning, 0.02, "of 1", "the same of the mean alpha; a step at 2.5 times"},
        {"layerlight", warning, 0.25, "stops",
         "the same of a light group or another layer of light; a step at 1.2 times"},
        {"oddframe", warning, {}, "", "a frame whose geometry is not between those around it"},
        {"order", warning, {}, "", "two frames whose places were exchanged"},
        {"skip", warning, {}, "", "a step of the motion that is a multiple of those around it"},
        {"pop", warning, {}, "", "a part of a fixed picture that changes once, for good"},
        {"cutatend", warning, {}, "", "the first or the last frame is of another camera"},
        {"hotpixel", warning, 10.0, "times the neighbourhood",
         "pixels that are lone and bright in most frames, whatever is in front of them"},
        {"datawindow",
         warning,
         {},
         "",
         "the data window differs in a shot where it is otherwise fixed"},
        {"type", warning, {}, "", "channels have another data type than in other frames"},
        {"compression", warning, {}, "", "the compression differs from other frames'"},
        {"metadata", warning, {}, "", "attributes differ that are the same in other frames"},
        {"proxy", warning, {}, "", "each pixel is there twice: a smaller picture was enlarged"},
        {"bands", warning, 300.0, "different values",
         "the picture has fewer different values than a render, as after 8 bits"},
        {"clip", warning, 0.0005, "share of the pixels",
         "pixels with one channel at exactly 1 and another not, or with one at 65504"},
        {"magenta", warning, 0.0005, "share of the albedo", "a texture that was not found"},
        {"fewframes", info, {}, "", "there are too few frames for the rules that compare them"},
        {"bars", info, {}, "", "a bar of one value along a border in all frames"},
    };
    return rules;
}

} // namespace tonetool::sequence
