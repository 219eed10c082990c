// SPDX-License-Identifier: BSD-3-Clause
// Commands that write textures.
#include <OpenImageIO/imagebufalgo.h>

#include "chain/commands/commands.h"
#include "chain/session/io.h"
#include "chain/session/ops.h"
#include "tonetool/texture.h"

namespace tonetool::chain {

namespace {

// One setting of make_texture and the modifiers that set it; the first modifier that is given
// counts.
struct Setting {
    const char* name;
    Strings keys;
    char kind;        ///< i, f or s
    double otherwise; ///< default of i and f; s is not set without a modifier
};

const std::vector<Setting>& settings_of_textures() {
    static const std::vector<Setting> all = {
        {"maketx:resize", {"resize"}, 'i', 0},
        {"maketx:nomipmap", {"nomipmap"}, 'i', 0},
        {"maketx:updatemode", {"updatemode"}, 'i', 0},
        {"maketx:constant_color_detect", {"constant_color_detect"}, 'i', 0},
        {"maketx:monochrome_detect", {"monochrome_detect"}, 'i', 0},
        {"maketx:opaque_detect", {"opaque_detect"}, 'i', 0},
        {"maketx:compute_average", {"compute_average"}, 'i', 1},
        {"maketx:unpremult", {"unpremult"}, 'i', 0},
        {"maketx:incolorspace", {"incolorspace"}, 's', 0},
        {"maketx:outcolorspace", {"outcolorspace"}, 's', 0},
        {"maketx:highlightcomp", {"highlightcomp", "hicomp"}, 'i', 0},
        {"maketx:sharpen", {"sharpen"}, 'f', 0},
        {"maketx:filtername", {"filtername", "filter"}, 's', 0},
        {"maketx:fileformatname", {"fileformatname"}, 's', 0},
        {"maketx:prman_metadata", {"prman_metadata"}, 'i', 0},
        {"maketx:prman_options", {"prman_options", "prman"}, 'i', 0},
        {"maketx:oiio_options", {"oiio_options", "oiio"}, 'i', 0},
        {"maketx:bumpformat", {"bumpformat"}, 's', 0},
        {"maketx:uvslopes_scale", {"uvslopes_scale"}, 'f', 0},
        {"handed", {"handed"}, 's', 0},
        {"maketx:cdf", {"cdf"}, 'i', 0},
        {"maketx:cdfbits", {"cdfbits"}, 'i', 8},
        {"maketx:cdfsigma", {"cdfsigma"}, 'f', 1.0 / 6},
    };
    return all;
}

void add_setting(OIIO::ImageSpec& config, const Call& call, const Setting& setting) {
    std::string key = setting.keys.back();
    for (auto each = setting.keys.rbegin(); each != setting.keys.rend(); ++each)
        key = call.has(*each) ? *each : key;
    if (setting.kind == 'i') {
        config.attribute(setting.name,
                         call.integer(key, kAnyInteger).value_or(int(setting.otherwise)));
    } else if (setting.kind == 'f') {
        config.attribute(setting.name,
                         float(call.number(key, kAnyNumberAtAll).value_or(setting.otherwise)));
    } else if (auto value = call.text(key)) {
        config.attribute(setting.name, *value);
    }
}

void set_tiles(OIIO::ImageSpec& config, Session& session, const Call& call,
               const OutputSettings& output) {
    const bool ignored = session.settings.compat && call.text("tile");
    if (ignored) {
        session.warning(call.text(),
                        "tile= has no effect on textures, as in oiiotool (--tile has)");
    }
    const OutputSettings& asked = ignored ? session.settings.output : output;
    config.tile_width = asked.tile_width > 0 ? asked.tile_width : 64;
    config.tile_height = asked.tile_width > 0 ? asked.tile_height : 64;
    config.tile_depth = 1;
}

void set_layout(OIIO::ImageSpec& config, const OutputSettings& output) {
    if (output.type && output.type->bits > 0)
        config.attribute("oiio:BitsPerSample", output.type->bits);
    if (!output.compression.empty())
        config.attribute("compression", output.compression);
    if (output.quality > 0)
        config.attribute("CompressionQuality", output.quality);
    if (!output.planarconfig.empty() && output.planarconfig != "default")
        config.attribute("planarconfig", output.planarconfig);
}

// The mode of make_texture.
OIIO::ImageSpec texture_config(Session& session, const Call& call, const Image& image,
                               const OutputSettings& output) {
    OIIO::ImageSpec config;
    for (const Setting& setting : settings_of_textures())
        add_setting(config, call, setting);
    const auto fov = call.number("fovcot", kAnyNumberAtAll);
    if (fov && session.settings.compat)
        session.warning(call.text(), "fovcot= has no effect, as in oiiotool");
    else if (fov)
        config.attribute("fovcot", float(*fov));
    const std::string wrap = call.text("wrap").value_or("black");
    config.attribute("wrapmodes",
                     call.text("swrap").value_or(wrap) + "," + call.text("twrap").value_or(wrap));
    config.attribute("maketx:bumpformat", call.text("bumpformat").value_or("auto"));
    // Without these 3.1 finds no slopes.
    config.attribute("maketx:slopefilter", "sobel");
    config.attribute("maketx:bumprange", "auto");
    config.attribute("maketx:colorconfig", session.settings.color_config);
    set_tiles(config, session, call, output);
    set_layout(config, output);
    config.set_format(output.type
                          ? output.type->type
                          : session.stack.types.of(image.part(), session.settings.compat).type);
    if (output.history) {
        // Readers trust the average colour and the hash in the header only from a program of this
        // name.
        config.attribute("Software",
                         "OpenImageIO " OIIO_VERSION_STRING " : " + session.command_line);
        config.attribute("maketx:full_command_line", session.command_line);
    }
    return config;
}

void save_texture(Session& session, const Call& call, const Image& image,
                  const std::string& filename, const OutputSettings& settings) {
    namespace IBA = OIIO::ImageBufAlgo;
    const std::string label = call.row().label();
    const auto mode = label == "oenv"    ? IBA::MakeTxEnvLatl
                      : label == "obump" ? IBA::MakeTxBumpWithSlopes
                                         : IBA::MakeTxTexture;
    std::string why;
    OIIO::ImageBuf cropped;
    const OIIO::ImageBuf& pixels =
        texture_pixels(image.part().pixels(), filename, settings, session.settings.compat, cropped);
    session.stack.keep_pixels_of(filename);
    if (!write_texture(mode, pixels, filename, texture_config(session, call, image, settings), why))
        throw CommandError("Could not make texture: " + why, call.text());
}

// -otex and its like.
void run_texture(Session& session, const Call& call) {
    write_to_files(session, call, save_texture);
}

Modifiers texture_modifiers() {
    return {{"wrap", "MODE", "black, clamp, periodic, mirror"},
            {"swrap", "MODE", "wrap mode in x"},
            {"twrap", "MODE", "wrap mode in y"},
            {"resize", "0|1", "resize to a power of 2"},
            {"nomipmap", "0|1", "write the top level only"},
            {"updatemode", "0|1", "write only if the texture would change"},
            {"constant_color_detect", "0|1", "write one tile if all pixels are the same"},
            {"monochrome_detect", "0|1", "write one channel if all are the same"},
            {"opaque_detect", "0|1", "leave out an alpha that is 1 everywhere"},
            {"incolorspace", "NAME", "colour space of the image"},
            {"outcolorspace", "NAME", "colour space of the texture"},
            {"highlightcomp", "0|1", "soften highlights before filtering"},
            {"hicomp", "0|1", "the same"},
            {"sharpen", "X", "sharpen each level"},
            {"filter", "NAME", "filter of the MIP levels"},
            {"filtername", "NAME", "the same"},
            {"prman_options", "0|1", "settings of RenderMan"},
            {"prman", "0|1", "the same"},
            {"prman_metadata", "0|1", "metadata of RenderMan"},
            {"oiio_options", "0|1", "settings of OpenImageIO"},
            {"oiio", "0|1", "the same"},
            {"compute_average", "0|1", "metadata of the average colour (1)"},
            {"handed", "left|right|none", "handedness of a displacement or normal map"},
            {"cdf", "0|1", "store the distribution of values in the metadata"},
            {"cdfbits", "N", "size of the distribution (8)"},
            {"cdfsigma", "X", "its deviation (1/6)"},
            {"fovcot", "X", "field of view"},
            {"bumpformat", "height|normal|auto", "content of a bump map"},
            {"uvslopes_scale", "X", "scale of its slopes"}};
}

Row texture_row(const char* usage, const char* help) {
    return command(usage, help, run_texture)
        .images(0, kAnyNumber)
        .modifiers(output_modifiers(), texture_modifiers());
}

} // namespace

Rows texture_commands() {
    return {texture_row("otex FILENAME", "Write the current image as a texture"),
            texture_row("oenv FILENAME", "Write it as an environment map"),
            texture_row("obump FILENAME", "Write a bump map with its slopes")};
}

} // namespace tonetool::chain
