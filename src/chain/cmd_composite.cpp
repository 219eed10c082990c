// Compositing, pasting, contact sheets and deep images.
#include <algorithm>
#include <cstdio>

#include "chain/ops.h"
#include "imagebuf/oiio_compat.h"

namespace tonetool::chain {

namespace {

struct Position {
    int x = 0, y = 0;
};

// From where the images lie.
Position asked_position(const Session& session, const std::string& text) {
    Position position;
    int end = 0;
    if (text != "-" && text != "auto" &&
        (std::sscanf(text.c_str(), "%d%d%n", &position.x, &position.y, &end) != 2 ||
         (!session.compat && size_t(end) < text.size()))) {
        throw CommandError("Invalid offset '" + text + "'" +
                           (session.compat ? "" : " (valid: +X+Y, auto, -)"));
    }
    return position;
}

OIIO::ROI in_plane(OIIO::ROI window, const OIIO::ROI& channels) {
    window.chbegin = channels.chbegin;
    window.chend = channels.chend;
    return window;
}

// The last image is the background, on which the others go, the deepest on top.
bool paste_all(Op& op, const std::vector<const OIIO::ImageBuf*>& images) {
    const Position at = asked_position(op.session, op.call.argument(0));
    const OIIO::ImageBuf& background = *images.back();
    OIIO::ImageSpec spec = background.spec();
    if (!op.flag("mergeroi")) {
        op.dst.copy(background);
    } else {
        OIIO::ROI data = background.roi(), display = background.roi_full();
        for (const OIIO::ImageBuf* image : images) {
            data = OIIO::roi_union(data, image->roi());
            display = OIIO::roi_union(display, image->roi_full());
        }
        spec.set_roi(in_plane(data, background.roi()));
        spec.set_roi_full(in_plane(display, background.roi()));
        op.dst.reset(spec);
        IBA::zero(op.dst);
        IBA::paste(op.dst, 0, 0, 0, 0, background);
    }
    bool done = true;
    for (size_t i = images.size() - 1; done && i-- > 0;) {
        done = IBA::paste(op.dst, at.x, at.y, 0, 0, *images[i]);
    }
    return done;
}

void run_paste(Session& session, const Call& call) {
    OIIO::ImageBuf result;
    Op op{session, call, result, {}};
    std::vector<ImagePtr> images = take_images(session, op.flag("all") ? 0 : 2);
    for (const ImagePtr& image : images) {
        op.src.push_back(&image->part().pixels());
    }
    if (!paste_all(op, op.src) || result.has_error()) {
        throw CommandError(result.geterror());
    }
    session.push(Image::derived(*images.back(), std::move(result)));
}

bool paste_metadata(Op& op) {
    bool done = op.dst.copy(op.b());
    OIIO::ImageSpec& spec = op.dst.specmod();
    spec.extra_attribs = op.a().spec().extra_attribs;
    spec.set_roi_full(in_plane(op.a().roi_full(), op.b().roi()));
    return done;
}

// Images of one size each in rows, with a border of `pad` between them.
struct Sheet {
    int columns = 0, rows = 0, pad = 0, width = 0, height = 0, channels = 0;

    OIIO::ImageSpec spec() const {
        return {columns * width + (columns - 1) * pad, rows * height + (rows - 1) * pad, channels,
                OIIO::TypeFloat};
    }
};

std::vector<OIIO::ImageBuf> fitted(const Session& session, const Call& call,
                                   const std::vector<ImagePtr>& images) {
    OIIO::ROI window;
    auto fit = call.text("fit");
    auto size = parsed_size(fit.value_or("0x0"));
    if (fit && !size && !session.compat) {
        throw CommandError("fit \"" + *fit + "\" is no size (valid: WxH)");
    }
    std::vector<OIIO::ImageBuf> all;
    for (const ImagePtr& image : images) {
        const OIIO::ImageBuf& pixels = image->part().pixels();
        const OIIO::ROI cell(0, int(size ? size->width : 0), 0, int(size ? size->height : 0), 0, 1,
                             0, pixels.nchannels());
        OIIO::ImageBuf& fitted = all.emplace_back();
        if (cell.npixels() > 0) {
            oiio::fit(fitted, pixels, "", "letterbox", false, cell);
        } else {
            fitted = pixels.copy(OIIO::TypeUnknown);
        }
    }
    return all;
}

OIIO::ImageBuf assembled(Sheet sheet, const std::vector<OIIO::ImageBuf>& images) {
    for (const OIIO::ImageBuf& image : images) {
        sheet.width = std::max(sheet.width, image.spec().full_width);
        sheet.height = std::max(sheet.height, image.spec().full_height);
        sheet.channels = std::max(sheet.channels, image.nchannels());
    }
    OIIO::ImageBuf result(sheet.spec());
    IBA::zero(result);
    for (size_t i = 0; i < images.size(); ++i) {
        const int column = int(i) % sheet.columns, row = int(i) / sheet.columns;
        IBA::paste(result, column * (sheet.width + sheet.pad), row * (sheet.height + sheet.pad), 0,
                   0, images[i]);
    }
    return result;
}

void run_mosaic(Session& session, const Call& call) {
    Sheet sheet;
    auto size = parsed_size(call.argument(0));
    if (!size || size->width < 1 || size->height < 1) {
        throw CommandError("Invalid size '" + call.argument(0) + "'" +
                           (session.compat ? "" : " (valid: COLUMNSxROWS)"));
    }
    sheet.columns = int(size->width);
    sheet.rows = int(size->height);
    OIIO::ImageBuf none;
    sheet.pad = Op{session, call, none, {}}.integer("pad", 0);
    const size_t cells = size_t(sheet.columns) * size_t(sheet.rows);
    std::vector<ImagePtr> images = take_images(session, std::min(cells, session.stack.size()));
    OIIO::ImageBuf result = assembled(sheet, fitted(session, call, images));
    session.push(Image::created("mosaic", std::move(result)));
}

const std::vector<OpRow> rows = {
    {"over", 2, "The first image over the second",
     [](Op& op) { return IBA::over(op.dst, op.a(), op.b()); }},
    {"zover", 2, "The nearer of two images with Z channels over the other",
     [](Op& op) { return IBA::zover(op.dst, op.a(), op.b(), op.flag("zeroisinf")); },
     "zeroisinf=0|1: Z of 0 is infinitely far"},
    {"deepmerge", 2, "Merge two deep images",
     [](Op& op) {
         op.dst = IBA::deep_merge(op.a(), op.b());
         return !op.dst.has_error();
     }},
    {"deepholdout", 2, "Hold out the first deep image by the second",
     [](Op& op) {
         op.dst = IBA::deep_holdout(op.a(), op.b());
         return !op.dst.has_error();
     }},
    {"deepen", 1, "From flat to deep",
     [](Op& op) { return IBA::deepen(op.dst, op.a(), op.number("z", 1)); },
     "z=X: depth where there is no Z channel (1)"},
    {"flatten", 1, "From deep to flat", [](Op& op) { return IBA::flatten(op.dst, op.a()); }},
    {"pastemeta", 2, "The pixels of the second image with the metadata of the first",
     paste_metadata},
};

} // namespace

std::vector<Command> composite_commands() {
    std::vector<Command> all = op_rows(Group::Composite, rows);
    all.push_back(free_row(Group::Composite, "paste +X+Y", 0, any_number,
                           "Paste the first image over the second, there or as it lies (auto, -)",
                           run_paste,
                           "all=0|1: all images of the stack over the last\n"
                           "mergeroi=0|1: a data window that holds both"));
    all.push_back(free_row(Group::Composite, "mosaic WxH", 0, any_number,
                           "Assemble as many images as there are into columns and rows", run_mosaic,
                           "pad=N: pixels between images (0)\n"
                           "fit=WxH: fit each image to this size first"));
    return all;
}

} // namespace tonetool::chain
