// Colour spaces, looks and views of the OpenColorIO configuration, and ICC profiles.
#include <OpenImageIO/color.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>

#include "chain/ops.h"
#include "imagebuf/oiio_compat.h"
#include "include/tonetool/write.h"

namespace tonetool::chain {

namespace {

// "" and "current": what the image says it is in.
std::string space_of(const Op& op, const std::string& name) {
    const bool current = name.empty() || name == "current";
    return current ? std::string(op.a().spec().get_string_attribute("oiio:ColorSpace", "Linear"))
                   : name;
}

bool convert(Op& op, const std::string& from, const std::string& to) {
    bool done = IBA::colorconvert(op.dst, op.a(), space_of(op, from), space_of(op, to),
                                  op.flag("unpremult"), op.text("key"), op.text("value"),
                                  &color_config(op.session));
    if (!done && !op.flag("strict", true)) {
        op.session.warning("colorconvert", op.dst.geterror());
        done = op.dst.copy(op.a());
    }
    return done;
}

bool look(Op& op) {
    return IBA::ociolook(op.dst, op.a(), op.call.argument(0), space_of(op, op.text("from")),
                         space_of(op, op.text("to")), op.flag("unpremult"), op.flag("inverse"),
                         op.text("key"), op.text("value"), &color_config(op.session));
}

void check_view(Session& session, const std::string& display, const std::string& view) {
    const OIIO::ColorConfig& config = color_config(session);
    if (!config.error() && config.getNumDisplays() > 0) {
        check_choice("display", display, config.getDisplayNames());
        check_choice("view", view, config.getViewNames(display));
    }
}

bool display(Op& op) {
    const std::string& name = op.call.argument(0);
    const std::string& view = op.call.argument(1);
    if (!op.session.compat) {
        check_view(op.session, name, view);
    }
    if (op.call.has("looks") && !op.session.compat && !oiio::display_takes_looks) {
        throw CommandError("looks= has no effect with OpenImageIO " OIIO_VERSION_STRING
                           " (valid: --ociolook before --ociodisplay)");
    }
    return IBA::ociodisplay(op.dst, op.a(), name, view, space_of(op, op.text("from")),
                            op.text("looks"), op.flag("unpremult"), op.text("key"),
                            op.text("value"), &color_config(op.session));
}

bool matrix(Op& op) {
    Floats m = op.list("MATRIXVALS", op.call.argument(0));
    if (m.size() == 9) {
        m = {m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, 0, 0, 0, 1};
    }
    if (m.size() != 16) {
        throw CommandError("expected 9 or 16 comma-separated floats to form a matrix", "", true);
    }
    float values[4][4];
    for (size_t i = 0; i < 16; ++i) {
        (op.flag("transpose") ? values[i % 4][i / 4] : values[i / 4][i % 4]) = m[i];
    }
    return IBA::colormatrixtransform(op.dst, op.a(), values, op.flag("unpremult"));
}

void read_profile(OIIO::ImageSpec& spec, const Call& call, Session&) {
    const std::string& file = call.argument(0);
    std::string bytes;
    if (!OIIO::Filesystem::exists(file)) {
        throw CommandError("ICC profile file " + file + " does not exist");
    }
    if (!OIIO::Filesystem::read_text_file(file, bytes) || bytes.empty()) {
        throw CommandError("ICC profile file " + file + " could not be read");
    }
    spec.attribute("ICCProfile", OIIO::TypeDesc(OIIO::TypeDesc::UINT8, int(bytes.size())),
                   bytes.data());
}

void write_profile(Session& session, const Call& call) {
    session.push(call.images.front());
    const OIIO::ImageSpec& spec = call.images.front()->part().header();
    const OIIO::ParamValue* profile = spec.find_attribute("ICCProfile");
    if (!profile) {
        throw CommandError("No ICC profile found in image.");
    }
    const std::string bytes(static_cast<const char*>(profile->data()), size_t(profile->datasize()));
    std::string why;
    if (!write_bytes(bytes, call.argument(0), why)) {
        throw CommandError(why);
    }
    session.produced = true;
}

const std::string alpha = "unpremult=0|1: unpremultiply before, premultiply after\n";
const std::string context = "key=NAME: key of the configuration's context\n"
                            "value=NAME: its value\n" +
                            alpha;
const std::string lenient = "strict=0|1: 0: a space that is not there is only a warning";

const std::vector<OpRow> rows = {
    {"tocolorspace COLORSPACE", 1, "Convert from the image's colour space to another",
     [](Op& op) { return convert(op, "", op.call.argument(0)); }, context + lenient},
    {"colorconvert SRC DST", 1, "Convert from one colour space to another",
     [](Op& op) { return convert(op, op.call.argument(0), op.call.argument(1)); },
     context + lenient},
    {"ociolook LOOK", 1, "Apply a look", look,
     context + "from=COLORSPACE: of the image (the one that it is in)\n"
               "to=COLORSPACE: of the result (the one that the image is in)\n"
               "inverse=0|1: undo the look"},
    {"ociodisplay DISPLAY VIEW", 1, "Show as a view of a display does", display,
     context + "from=COLORSPACE: of the image (the one that it is in)\n"
               "looks=NAMES: instead of those of the view"},
    {"ociofiletransform FILENAME", 1, "Apply the transform of a file (a LUT)",
     [](Op& op) {
         return IBA::ociofiletransform(op.dst, op.a(), op.call.argument(0), op.flag("unpremult"),
                                       op.flag("inverse"), &color_config(op.session));
     },
     alpha + "inverse=0|1: undo the transform"},
    {"ccmatrix MATRIXVALS", 1, "Multiply the colour by a matrix of 9 or 16 numbers", matrix,
     alpha + "transpose=0|1: the numbers go down the columns"},
};

} // namespace

std::vector<Command> ocio_commands() {
    std::vector<Command> all = op_rows(Group::Color, rows);
    append(all, header_rows(Group::Color, {{"iccread FILENAME", "Take the ICC profile from a file",
                                            read_profile}}));
    all.push_back(free_row(Group::Write, "iccwrite FILENAME", 1, 1,
                           "Write the ICC profile to a file", write_profile));
    return all;
}

} // namespace tonetool::chain
