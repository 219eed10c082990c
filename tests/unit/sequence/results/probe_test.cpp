// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/probe.h"

#include <gmock/gmock.h>

namespace tonetool::sequence {
namespace {

using testing::HasSubstr;

std::string image(const std::string& name) {
    return std::string(TESTIMAGES_DIR) + "/" + name;
}

TEST(Probe, SaysWhatIsWrongWithFiles) {
    EXPECT_EQ(probed({image("plain.exr"), image("gone.exr")}).status, Status::Missing);
    EXPECT_EQ(probed({image("plain.exr"), image("truncated.exr")}).status, Status::Unreadable);
    EXPECT_EQ(probed({image("not_an_image.exr")}).status, Status::Unreadable);
    EXPECT_EQ(probed({image("plain.exr"), image("one_pixel.exr")}).status, Status::SizeMismatch);
    EXPECT_EQ(probed({image("plain.exr"), image("rgba.exr")}).status, Status::Error);
    EXPECT_EQ(probed({image("deep.exr")}).status, Status::Error);
    EXPECT_THAT(probed({image("truncated.exr")}).message, HasSubstr("truncated.exr\""));
}

TEST(Settle, AnErrorIsNeverAPassWhateverWasMeasured) {
    FrameResult frame;
    Measurement measured;
    measured.thresholds = {Threshold{"mean", 0, false, 1.0, {}}};
    frame.measurements = {measured};
    settle(frame, "no space left", {image("plain.exr")});
    EXPECT_EQ(frame.status, Status::Error);
    EXPECT_EQ(frame.message, "no space left");
    settle(frame, "cannot read", {image("truncated.exr")});
    EXPECT_EQ(frame.status, Status::Unreadable);
    settle(frame, "", {});
    EXPECT_EQ(frame.status, Status::Passed);
}

TEST(Settle, AWarningKeepsFromPassing) {
    FrameResult frame;
    Measurement measured;
    measured.thresholds = {Threshold{"mean", 0, false, 1.0, {}}};
    frame.measurements = {measured};
    frame.warnings = {"3 pixels are not finite"};
    settle(frame, "", {});
    EXPECT_EQ(frame.status, Status::Warning);
    EXPECT_EQ(frame.message, "3 pixels are not finite");
}

} // namespace
} // namespace tonetool::sequence
