// The local tone mapper of rendered images.
#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/light_args.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

CgTmoOptions options_of(const Call& call) {
    CgTmoOptions options;
    options.pixels = pixel_options(call);
    // Names are checked by the library, which knows what is valid.
    const std::pair<const char*, std::string*> texts[] = {{"preset", &options.preset},
                                                          {"domain", &options.domain},
                                                          {"position", &options.position},
                                                          {"normal", &options.normal},
                                                          {"albedo", &options.albedo},
                                                          {"depth", &options.depth},
                                                          {"normaldist", &options.normaldist},
                                                          {"footprint", &options.footprint},
                                                          {"filter", &options.filter},
                                                          {"lwa", &options.lwa},
                                                          {"encode", &options.encode},
                                                          {"env", &options.env},
                                                          {"weight", &options.weight},
                                                          {"maximum", &options.maximum},
                                                          {"show", &options.show}};
    for (const auto& [key, text] : texts)
        *text = call.text(key).value_or(*text);
    options.lumsigma = call.number("lumsigma", {0, 10});
    options.fov = call.number("fov", {1, 179});
    options.lmax = call.number("lmax", {1e-30, 1e30});
    options.max_percentile = call.number("maxpercentile", {50, 100}).value_or(100);
    options.lights = light_options(call);
    options.lights.layer = call.text("lightindex").value_or("");
    options.sigma = call.number("sigma", {1, 20}).value_or(options.sigma);
    options.samples = call.integer("samples", {0, 400}).value_or(options.samples);
    options.wlsalpha = call.number("wlsalpha", {0, 4});
    options.wlslambda = call.number("wlslambda", {0, 100});
    options.bias = call.number("bias", {0.01, 1}).value_or(options.bias);
    options.ldmax = call.number("ldmax", {1, 10000}).value_or(options.ldmax);
    options.saturation = call.number("saturation", {0, 4}).value_or(options.saturation);
    options.strict = call.flag("strict", false);
    options.clamp = call.flag("clamp", true);
    return options;
}

void report_summary(Session& session, const std::string& label, const CgTmoSummary& found) {
    auto line = [&](const char* name, const std::string& value) {
        session.report(label + ": " + name + " " + value);
    };
    line("layer", found.layer.empty() ? "R,G,B" : found.layer);
    line("position", found.position.empty() ? "none" : found.position);
    line("normal", found.normal.empty() ? "none" : found.normal);
    line("albedo", found.albedo.empty() ? "none" : found.albedo);
    if (session.verbose)
        for (const std::string& note : found.notes)
            line("note", note);
    line("samples", std::to_string(found.samples));
    line("background", std::to_string(found.background));
    line("footprint", format_number(found.footprint));
    line("light-index", found.light_index.empty() ? "none" : found.light_index);
    line("adaptation", format_number(found.adaptation));
    line("adaptation-from", found.adaptation_from);
    line("maximum", format_number(found.maximum));
    line("maximum-from",
         found.maximum_from + (found.maximum_light.empty() ? "" : " " + found.maximum_light));
}

void run_cgtmo(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    const std::string label = call.row().label();
    CgTmoOptions options = options_of(call);
    OIIO::ImageBuf source = color_source(session, call, image, options.pixels);
    CgTmoSummary found;
    OIIO::ImageBuf result;
    if (!ToneAlgo::cg_tmo(result, source, options, &found))
        throw CommandError(result.geterror());
    report_summary(session, label, found);
    for (const std::string& warning : found.warnings)
        session.warning(label, image.name() + ": " + warning);
    session.push(Image::derived(image, std::move(result)));
}

std::vector<Modifier> cgtmo_modifiers() {
    return concatenated(
        {{{"preset", "default|paper", "log base with a luminance term, or Eq. 2 to the letter"},
          {"domain", "log|linear", "of the base (the preset's)"},
          {"lumsigma", "X", "of the luminance term in log10, 0: none (0.4; paper 0)"},
          {"position", "LAYER|FILE", "world position; none: without (found by its name)"},
          {"normal", "LAYER|FILE", "normal (found)"},
          {"albedo", "LAYER|FILE", "albedo (found)"},
          {"depth", "LAYER|FILE", "depth, which tells the sky (found)"},
          {"fov", "DEGREES", "horizontal field of view, for position from depth (40)"},
          {"strict", "0|1", "a missing guide, light or panorama is an error (0)"},
          {"sigma", "X", "of the window in pixels, 1 to 20 (8)"},
          {"samples", "N", "of the window, 4 to 400; 0: all (80)"},
          {"normaldist", "euclid|dot", "how normals differ (euclid)"},
          {"footprint", "pixel|global|camera|X", "of a pixel in the scene (pixel)"},
          {"filter", "guided|bilateral|wls|none",
           "bilateral: luminance alone; wls: weighted least squares of it (guided)"},
          {"wlsalpha", "X", "sensitivity of filter=wls to edges, 0 to 4 (1.2)"},
          {"wlslambda", "X", "smoothness of filter=wls, 0 to 100 (0.125)"},
          {"lwa", "NAME|X",
           "adaptation luminance: geometric, harmonic, arithmetic, median (geometric)"},
          {"env", "FILE", "latitude-longitude panorama at the camera, for lwa (the image)"},
          {"weight", "solidangle|none", "of the panorama's pixels (solidangle)"},
          {"lmax", "X", "luminance that becomes white (as maximum says)"},
          {"maximum", "auto|lights|groups|env|image",
           "lmax of the lights in the picture, their groups, the panorama, the image (the first "
           "there is)"},
          {"maxpercentile", "X", "of groups and image, instead of their largest (100)"},
          {"lightindex", "LAYER|FILE",
           "index of each pixel's light; groups: by the groups (found)"}},
         light_modifiers(),
         {{"bias", "X", "of Drago's curve (0.85)"},
          {"ldmax", "X", "cd/m2 of the display (100)"},
          {"saturation", "X", "0 to 4 (1)"},
          {"encode", join(ToneAlgo::display_encodings(), "|"), "of the result (srgb)"},
          {"clamp", "0|1", "the result to 0 to 1 (1)"},
          {"show", "picture|base|detail", "linear luminance is base times detail (picture)"}},
         pixel_modifiers()});
}

} // namespace

std::vector<Command> cgtmo_commands() {
    return {{{{"cgtmo"}, {}, 1, 1, Group::Color},
             cgtmo_modifiers(),
             "HDR to a display locally, guided by the render's position, normal and albedo",
             run_cgtmo}};
}

} // namespace tonetool::chain
