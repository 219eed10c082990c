// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/sheet.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>

#include "imagebuf/pixels/oiio_compat.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

namespace IBA = OIIO::ImageBufAlgo;

OIIO::ROI in_plane(OIIO::ROI window, const OIIO::ROI& channels) {
    window.chbegin = channels.chbegin;
    window.chend = channels.chend;
    return window;
}

OIIO::ImageBuf background_of_all(const Pictures& images) {
    const OIIO::ImageBuf& background = *images.back();
    OIIO::ROI data = background.roi(), display = background.roi_full();
    for (const OIIO::ImageBuf* image : images) {
        data = OIIO::roi_union(data, image->roi());
        display = OIIO::roi_union(display, image->roi_full());
    }
    OIIO::ImageSpec spec = background.spec();
    spec.set_roi(in_plane(data, background.roi()));
    spec.set_roi_full(in_plane(display, background.roi()));
    OIIO::ImageBuf result(spec);
    IBA::zero(result);
    IBA::paste(result, 0, 0, 0, 0, background);
    return result;
}

std::vector<OIIO::ImageBuf> fitted(const Pictures& images, const Size& size) {
    std::vector<OIIO::ImageBuf> all;
    for (const OIIO::ImageBuf* pixels : images) {
        const OIIO::ROI cell(0, int(size.width), 0, int(size.height), 0, 1, 0, pixels->nchannels());
        OIIO::ImageBuf& image = all.emplace_back();
        if (cell.npixels() > 0)
            oiio::fit(image, *pixels, "", "letterbox", false, cell);
        else
            image = pixels->copy(OIIO::TypeUnknown);
    }
    return all;
}

} // namespace

OIIO::ImageBuf pasted(const Pictures& images, int x, int y, bool merge) {
    OIIO::ImageBuf result =
        merge ? background_of_all(images) : images.back()->copy(OIIO::TypeUnknown);
    bool done = !result.has_error();
    for (size_t i = images.size() - 1; done && i-- > 0;)
        done = IBA::paste(result, x, y, 0, 0, *images[i]);
    if (!done)
        throw CommandError(result.geterror());
    return result;
}

OIIO::ImageBuf mosaic(const Sheet& sheet, const Pictures& images) {
    const std::vector<OIIO::ImageBuf> cells = fitted(images, sheet.fit.value_or(Size{0, 0}));
    int width = 0, height = 0, channels = 0;
    for (const OIIO::ImageBuf& image : cells) {
        width = std::max(width, image.spec().full_width);
        height = std::max(height, image.spec().full_height);
        channels = std::max(channels, image.nchannels());
    }
    OIIO::ImageBuf result(OIIO::ImageSpec(sheet.columns * width + (sheet.columns - 1) * sheet.pad,
                                          sheet.rows * height + (sheet.rows - 1) * sheet.pad,
                                          channels, OIIO::TypeFloat));
    IBA::zero(result);
    for (size_t i = 0; i < cells.size(); ++i) {
        const int column = int(i) % sheet.columns, row = int(i) / sheet.columns;
        IBA::paste(result, column * (width + sheet.pad), row * (height + sheet.pad), 0, 0,
                   cells[i]);
    }
    return result;
}

} // namespace tonetool::chain
