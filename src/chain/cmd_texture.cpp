// Commands that write textures.
#include <OpenImageIO/imagebufalgo.h>
#include <map>

#include "chain/ops.h"
#include "include/tonetool/texture.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// What make_texture is to do: its options have the names of the modifiers, but for these.
OIIO::ImageSpec texture_config(const Session& session, const Call& call) {
    static const std::map<std::string, std::string> others = {
        {"filter", "filtername"}, {"prman", "prman_options"}, {"oiio", "oiio_options"}};
    OIIO::ImageSpec config;
    for (const Modifier& modifier : call.row().modifiers) {
        auto value = call.text(modifier.key);
        auto other = others.find(modifier.key);
        const std::string name = "maketx:" + (other == others.end() ? modifier.key : other->second);
        if (modifier.hint == "0|1") {
            config.attribute(name, int(call.flag(modifier.key, false)));
        } else if (modifier.hint == "X" &&
                   (modifier.key != "fovcot" || (value && !session.compat))) {
            config.attribute(modifier.key == "fovcot" ? modifier.key : name,
                             float(call.number(modifier.key, any_number_at_all).value_or(0)));
        } else if (modifier.hint != "X" && value) {
            config.attribute(name, *value);
        }
    }
    const std::string wrap = call.text("wrap").value_or("black");
    config.attribute("wrapmodes",
                     call.text("swrap").value_or(wrap) + "," + call.text("twrap").value_or(wrap));
    config.attribute("maketx:bumpformat", call.text("bumpformat").value_or("auto"));
    config.attribute("maketx:compute_average", 1);
    config.attribute("maketx:colorconfig", session.color_config);
    const OutputSettings& output = session.output;
    config.set_format(output.type ? output.type->type
                                  : session.types.of(call.images[0]->part(), session.compat).type);
    config.tile_width = output.tile_width > 0 ? output.tile_width : 64;
    config.tile_height = output.tile_width > 0 ? output.tile_height : 64;
    config.tile_depth = 1;
    if (!output.compression.empty()) {
        config.attribute("compression", output.compression);
    }
    if (output.history) {
        // By that name readers trust the average and the hash that are in it.
        config.attribute("Software",
                         "OpenImageIO " OIIO_VERSION_STRING " : " + session.command_line);
        config.attribute("maketx:full_command_line", session.command_line);
    }
    return config;
}

// -otex and its like.
void run_texture(Session& session, const Call& call) {
    namespace IBA = OIIO::ImageBufAlgo;
    session.claim(call.argument(0));
    const std::string label = call.row().label();
    const auto mode = label == "oenv"    ? IBA::MakeTxEnvLatl
                      : label == "obump" ? IBA::MakeTxBumpWithSlopes
                                         : IBA::MakeTxTexture;
    std::string why;
    const OIIO::ImageBuf& pixels = call.images[0]->part().pixels();
    if (!write_texture(mode, pixels, call.argument(0), texture_config(session, call), why)) {
        throw CommandError("Could not make texture: " + why, call.text());
    }
    session.wrote = call.images[0]->written = true;
    session.push(call.images[0]);
}

} // namespace

std::vector<Command> texture_commands() {
    const std::string options =
        "wrap=MODE: black, clamp, periodic, mirror\nswrap=MODE: in x\ntwrap=MODE: in y\n"
        "resize=0|1: to a power of 2\nnomipmap=0|1: the top level only\n"
        "updatemode=0|1: only if the texture would change\n"
        "constant_color_detect=0|1: one tile where all pixels are the same\n"
        "monochrome_detect=0|1: one channel where all are the same\n"
        "opaque_detect=0|1: without an alpha that is 1 everywhere\n"
        "unpremult=0|1: divide by alpha for the colour conversion\n"
        "incolorspace=NAME: colour space of the image\noutcolorspace=NAME: of the texture\n"
        "highlightcomp=0|1: soften highlights before filtering\n"
        "sharpen=X: each level\nfilter=NAME: of the levels\n"
        "prman=0|1: settings of RenderMan\noiio=0|1: settings of OpenImageIO\n"
        "fovcot=X: field of view\nfileformatname=NAME: of the texture\n"
        "bumpformat=height|normal|auto: of a bump map\nuvslopes_scale=X: of its slopes";
    std::vector<Command> rows;
    for (const char* usage : {"otex FILENAME", "oenv FILENAME", "obump FILENAME"}) {
        rows.push_back(free_row(Group::Write, usage, 1, 1,
                                usage[1] == 't'   ? "Write the current image as a texture"
                                : usage[1] == 'e' ? "Write it as an environment map"
                                                  : "Write a bump map with its slopes",
                                run_texture, options));
    }
    return rows;
}

} // namespace tonetool::chain
