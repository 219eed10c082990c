// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/sheet.h"

#include <OpenImageIO/imagebufalgo.h>
#include <gmock/gmock.h>

namespace tonetool::chain {
namespace {

OIIO::ImageBuf flat(int width, int height, float value) {
    OIIO::ImageBuf image(OIIO::ImageSpec(width, height, 1, OIIO::TypeFloat));
    OIIO::ImageBufAlgo::fill(image, {value});
    return image;
}

TEST(Sheet, CellsAreAsLargeAsTheLargestImageNeeds) {
    const OIIO::ImageBuf a = flat(4, 2, 1), b = flat(2, 3, 2), c = flat(1, 1, 3);
    Sheet sheet{2, 2, 1};
    const OIIO::ImageBuf all = mosaic(sheet, {&a, &b, &c});
    EXPECT_EQ(all.roi(), OIIO::ROI(0, 9, 0, 7, 0, 1, 0, 1));
    EXPECT_EQ(all.getchannel(0, 0, 0, 0), 1);
    EXPECT_EQ(all.getchannel(5, 2, 0, 0), 2);
    EXPECT_EQ(all.getchannel(0, 4, 0, 0), 3);
    EXPECT_EQ(all.getchannel(4, 0, 0, 0), 0) << "the pixel between the columns";
    EXPECT_EQ(all.getchannel(5, 4, 0, 0), 0) << "the cell without an image";
}

TEST(Sheet, ImagesAreFittedFirst) {
    const OIIO::ImageBuf a = flat(8, 4, 1);
    Sheet sheet{1, 1};
    sheet.fit = Size{4, 4};
    const OIIO::ImageBuf all = mosaic(sheet, {&a});
    EXPECT_EQ(all.roi(), OIIO::ROI(0, 4, 0, 4, 0, 1, 0, 1));
}

TEST(Pasted, TheDeepestIsOnTopAndTheLastIsTheBackground) {
    const OIIO::ImageBuf a = flat(1, 1, 1), b = flat(2, 2, 2), back = flat(4, 4, 3);
    const OIIO::ImageBuf all = pasted({&a, &b, &back}, 1, 1, false);
    EXPECT_EQ(all.roi(), back.roi());
    EXPECT_EQ(all.getchannel(1, 1, 0, 0), 1);
    EXPECT_EQ(all.getchannel(2, 2, 0, 0), 2);
    EXPECT_EQ(all.getchannel(3, 3, 0, 0), 3);
}

TEST(Pasted, WindowsGrowWhereTheyAreMerged) {
    OIIO::ImageBuf a = flat(2, 2, 1), back = flat(2, 2, 3);
    a.set_origin(3, 0);
    const OIIO::ImageBuf all = pasted({&a, &back}, 0, 0, true);
    EXPECT_EQ(all.roi(), OIIO::ROI(0, 5, 0, 2, 0, 1, 0, 1));
    EXPECT_EQ(all.getchannel(2, 0, 0, 0), 0);
}

} // namespace
} // namespace tonetool::chain
