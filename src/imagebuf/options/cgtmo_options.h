// SPDX-License-Identifier: BSD-3-Clause
// The fields of CgTmoOptions, but for the pixels and the lights, which are structs of their own.
#pragma once

#include "imagebuf/options/camera_options.h"
#include "imagebuf/options/option.h"
#include "imagebuf/options/tone_options.h"
#include "tonetool/cgtmo.h"
#include "tonetool/tonemap.h"

namespace tonetool {

/// The base, and the G-buffer AOVs that guide its filter.
template <class See>
void describe_base(See&& see) {
    using O = CgTmoOptions;
    see(option("preset", &O::preset,
               "default: a base that keeps edges of light; classic: a log mean with a luminance "
               "term; paper: Eq. 2 and 4 to the letter")
            .one_of({"default", "paper", "classic"})
            .unset("default; filter=none|wls|bilateral: classic"));
    see(option("base", &O::base,
               "edges: keeps edges of light and leaves noise as it is; mean: the filter's mean")
            .one_of({"edges", "mean"})
            .unset("the preset's"));
    see(option("edge", &O::edge, "natural logarithm of luminance beyond which base=edges has edges")
            .within(0.001, 10)
            .unset("0.16"));
    see(option("denoise", &O::denoise, "how much of the noise base=edges does not take for detail")
            .within(0, 100)
            .unset("2"));
    see(option("noise", &O::noise, "variance of the mean of luminance, for base=edges")
            .shown_as("LAYER")
            .unset("measured where surfaces are flat"));
    see(option("steady", &O::steady,
               "steadies the detail of a shot's frames by the frames about each, along its "
               "surfaces"));
    see(option("motion", &O::motion,
               "where surfaces that move were and will be, as Blender's Vector, for steady")
            .shown_as("LAYER")
            .unset("they are as they are in each frame"));
    see(option("domain", &O::domain, "what the base is made of")
            .one_of({"log", "linear"})
            .unset("the preset's"));
    see(option("lumsigma", &O::lumsigma, "sigma of the luminance term in log10; 0: no such term")
            .within(0, 10)
            .unset("0.4; preset=paper, base=edges: 0"));
    see(option("position", &O::position, "world position; none: without")
            .shown_as("LAYER|FILE")
            .unset("found by its name"));
    see(option("normal", &O::normal, "normals; none: without")
            .shown_as("LAYER|FILE")
            .unset("found by its name"));
    see(option("albedo", &O::albedo, "albedo; none: without")
            .shown_as("LAYER|FILE")
            .unset("found by its name"));
    see(option("depth", &O::depth,
               "depth, which tells the background and stands in for positions; none: without")
            .shown_as("LAYER|FILE")
            .unset("found by its name"));
    see(option("fov", &O::fov, "horizontal field of view in degrees, for positions from depth")
            .within(1, 179)
            .in("degrees")
            .shown_as("DEGREES")
            .unset("the image's camera, or 40"));
    see(option("strict", &O::strict,
               "a missing G-buffer AOV, light or panorama that was asked for is an error"));
    see(option("sigma", &O::sigma, "sigma of the window in pixels").within(1, 20).in("pixels"));
    see(option("samples", &O::samples, "samples of the window; 0: all its pixels")
            .within(4, 400)
            .zero_too()
            .unset("80; preset=paper: 0"));
    see(option("normaldist", &O::normaldist,
               "how far apart normals are; euclid: |n - m|^2, dot: 1 - |n m|")
            .one_of({"euclid", "dot"}));
    see(option("footprint", &O::footprint,
               "size of a pixel in the scene: of each pixel, their median, by the camera, or a "
               "number in the unit of the positions")
            .shown_as("pixel|global|camera|X"));
    see(option("filter", &O::filter,
               "how the base is made; bilateral: by luminance alone; wls: weighted least squares")
            .one_of({"guided", "bilateral", "wls", "none"}));
    see(option("wlsalpha", &O::wlsalpha, "sensitivity of filter=wls to edges")
            .within(0, 4)
            .unset("1.2"));
    see(option("wlslambda", &O::wlslambda, "smoothness of the base of filter=wls")
            .within(0, 100)
            .unset("0.125"));
}

/// The luminances that the curve follows from, and the result.
template <class See>
void describe_curve(See&& see) {
    using O = CgTmoOptions;
    see(option("count", &O::count, count_text()).one_of(count_names()).unset("the preset's"));
    see(option("method", &O::method,
               "where the adaptation luminance comes from; measured: as lwa says, camera: what a "
               "camera of these settings is exposed for")
            .one_of({"measured", "camera"}));
    describe(CameraOptions(), see);
    see(option("lwa", &O::lwa,
               "adaptation luminance: geometric, harmonic, arithmetic or median of the panorama "
               "(of the image without one), cells: of the means of cells of the image, or a number")
            .shown_as("NAME|X")
            .unset("cells; preset=paper, classic: geometric"));
    see(option("env", &O::env,
               "latitude-longitude panorama at the camera, in the image's unit, for lwa")
            .shown_as("FILE")
            .unset("the image"));
    see(option("weight", &O::weight, "how the panorama's pixels count")
            .one_of({"solidangle", "none"}));
    see(option("lmax", &O::lmax, "luminance that becomes white")
            .positive()
            .unset("as maximum says"));
    see(option("maximum", &O::maximum,
               "where lmax comes from: the lights in the image, their groups, the panorama, the "
               "image; first: the first there is, auto: a table of lights or the image")
            .one_of({"auto", "lights", "groups", "env", "image", "first"})
            .unset("auto; preset=paper, classic: first"));
    see(option("maxpercentile", "max_percentile", &O::max_percentile,
               "percentile of the luminances of groups and image that counts as their largest")
            .within(50, 100)
            .unset("99.99; preset=paper, classic: 100"));
    see(option("bias", &O::bias, "bias of Drago's curve").within(0.01, 1));
    see(option("ldmax", &O::ldmax, "luminance of the display's white in cd/m2")
            .within(1, 10000)
            .in("cd/m2"));
    see(option("saturation", &O::saturation, "exponent s of C' = (C / L)^s Ld").within(0, 4));
    see(option("encode", &O::encode, "how the result is encoded")
            .shown_as(OIIO::Strutil::join(ToneAlgo::display_encodings(), "|")));
    see(option("clamp", &O::clamp, "clamp the result to 0 to 1"));
    see(option("clip", &O::clip, clip_text()).one_of(clip_names()).unset("the preset's"));
    see(option("show", &O::show,
               "the tone-mapped image, or what its linear luminance is the product of; share: how "
               "much of a difference base=edges has")
            .one_of({"picture", "base", "detail", "share"}));
}

template <class See>
void describe(const CgTmoOptions&, See&& see) {
    describe_base(see);
    describe_curve(see);
}

} // namespace tonetool
