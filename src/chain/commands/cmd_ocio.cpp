// SPDX-License-Identifier: BSD-3-Clause
// Colour spaces, looks and views of the OpenColorIO configuration, and ICC profiles.
#include <Imath/ImathMatrix.h>
#include <OpenImageIO/color.h>

#include "chain/commands/commands.h"
#include "chain/images/attributes.h"
#include "chain/session/ops.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "tonetool/color_tags.h"

namespace tonetool::chain {

namespace {

// "" and "current": the colour space in the image's header.
std::string space_of(const Op& op, const std::string& name) {
    const bool current = name.empty() || name == "current";
    return current ? std::string(op.a().spec().get_string_attribute("oiio:ColorSpace", "Linear"))
                   : name;
}

// The source's profile and gamma do not describe the converted pixels. oiiotool keeps them.
bool converted(Op& op, bool done) {
    if (done && !op.session.settings.compat)
        drop_profile(op.dst.specmod());
    return done;
}

bool convert(Op& op, const std::string& from, const std::string& to) {
    bool done = IBA::colorconvert(op.dst, op.a(), space_of(op, from), space_of(op, to),
                                  op.flag("unpremult"), op.text("key"), op.text("value"),
                                  &color_config(op.session));
    if (!done && !op.flag("strict", true)) {
        op.session.warning("colorconvert", op.dst.geterror());
        return op.dst.copy(op.a());
    }
    return converted(op, done);
}

bool look(Op& op) {
    return converted(op, IBA::ociolook(op.dst, op.a(), op.call.argument(0),
                                       space_of(op, op.text("from")), space_of(op, op.text("to")),
                                       op.flag("unpremult"), op.flag("inverse"), op.text("key"),
                                       op.text("value"), &color_config(op.session)));
}

void check_view(Session& session, const std::string& display, const std::string& view) {
    const OIIO::ColorConfig& config = color_config(session);
    if (!config.has_error() && config.getNumDisplays() > 0) {
        check_choice("display", display, config.getDisplayNames());
        check_choice("view", view, config.getViewNames(display));
    }
}

bool display(Op& op) {
    const std::string& name = op.call.argument(0);
    const std::string& view = op.call.argument(1);
    if (!op.session.settings.compat)
        check_view(op.session, name, view);
    if (op.call.has("looks") && !oiio::kDisplayTakesLooks) {
        op.session.warning(op.call.text(),
                           "looks= has no effect with OpenImageIO " OIIO_VERSION_STRING
                           " (--ociolook before --ociodisplay applies a look)");
    }
    return converted(op,
                     oiio::ociodisplay(op.dst, op.a(), name, view, space_of(op, op.text("from")),
                                       op.text("looks"), op.flag("unpremult"), op.text("key"),
                                       op.text("value"), color_config(op.session)));
}

bool matrix(Op& op) {
    Floats m = op.list("MATRIXVALS", op.call.argument(0));
    if (m.size() == 9)
        m = {m[0], m[1], m[2], 0, m[3], m[4], m[5], 0, m[6], m[7], m[8], 0, 0, 0, 0, 1};
    if (m.size() != 16)
        throw CommandError("expected 9 or 16 comma-separated floats to form a matrix", "", true);
    Imath::M44f matrix(m[0], m[1], m[2], m[3], m[4], m[5], m[6], m[7], m[8], m[9], m[10], m[11],
                       m[12], m[13], m[14], m[15]);
    if (op.flag("transpose"))
        matrix.transpose();
    if (op.flag("invert") || op.flag("inverse")) {
        if (matrix.determinant() == 0 && !op.session.settings.compat)
            throw CommandError("\"" + op.call.argument(0) + "\" has no inverse matrix");
        matrix.invert();
    }
    return IBA::colormatrixtransform(op.dst, op.a(), matrix, op.flag("unpremult"));
}

void read_profile(OIIO::ImageSpec& spec, const Call& call, Session&) {
    read_icc_profile(spec, call.argument(0));
}

void write_profile(Session& session, const Call& call) {
    session.stack.push(call.images.front());
    if (session.settings.compat || !session.settings.dry_run)
        write_icc_profile(call.images.front()->part().header(), call.argument(0));
    session.outcome.produced = true;
}

const Modifiers kAlpha = {{"unpremult", "0|1", "unpremultiply before, premultiply after"}};
const Modifiers kContext = concatenated(
    {{{"key", "NAME", "key of the configuration's context"}, {"value", "NAME", "its value"}},
     kAlpha});
const Modifiers kConversion =
    concatenated({kContext, {{"strict", "0|1", "0: a space that is not there is only a warning"}}});

const Rows kOcioRows = {
    on_pixels("tocolorspace COLORSPACE", 1, "Convert from the image's colour space to another",
              [](Op& op) { return convert(op, "", op.call.argument(0)); })
        .modifiers(kConversion)
        .operation("colorconvert"),
    on_pixels("colorconvert SRC DST", 1, "Convert from one colour space to another",
              [](Op& op) { return convert(op, op.call.argument(0), op.call.argument(1)); })
        .modifiers(kConversion)
        .operation("colorconvert")
        .keeps_header(),
    on_pixels("ociolook LOOK", 1, "Apply a look", look)
        .modifiers(kContext)
        .modifier("from", "COLORSPACE", "of the image (the one that it is in)")
        .modifier("to", "COLORSPACE", "of the result (the one that the image is in)")
        .modifier("inverse", "0|1", "undo the look")
        .keeps_header(),
    on_pixels("ociodisplay DISPLAY VIEW", 1, "Show as a view of a display does", display)
        .modifiers(kContext)
        .modifier("from", "COLORSPACE", "of the image (the one that it is in)")
        .modifier("looks", "NAMES", "instead of those of the view")
        .keeps_header(),
    on_pixels("ociofiletransform FILENAME", 1, "Apply the transform of a file (a LUT)",
              [](Op& op) {
                  return converted(op,
                                   IBA::ociofiletransform(op.dst, op.a(), op.call.argument(0),
                                                          op.flag("unpremult"), op.flag("inverse"),
                                                          &color_config(op.session)));
              })
        .modifiers(kAlpha)
        .modifier("inverse", "0|1", "undo the transform"),
    on_pixels("ccmatrix MATRIXVALS", 1, "Multiply the colour by a matrix of 9 or 16 numbers",
              matrix)
        .modifiers(kAlpha)
        .modifier("transpose", "0|1", "the numbers go down the columns")
        .modifier("invert", "0|1", "by the inverse of the matrix")
        .modifier("inverse", "0|1", "the same")
        .keeps_header(),
    on_headers("iccread FILENAME", "Take the ICC profile from a file", read_profile),
    command("iccwrite FILENAME", "Write the ICC profile to a file", write_profile)
        .in(Group::Write)
        .images(1, 1),
};

} // namespace

Rows ocio_commands() {
    return kOcioRows;
}

} // namespace tonetool::chain
