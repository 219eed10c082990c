// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/probe.h"

#include <filesystem>
#include <fstream>
#include <gmock/gmock.h>
#include <unistd.h>

#include "folder.h"
#include "tonetool/write.h"

namespace tonetool::sequence {
namespace {

using testing::EndsWith;
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

// What readers take without a word, or call a file of another format.
TEST(Probe, SaysWhatReadersDoNotSay) {
    const Folder folder;
    const std::string cut = folder / "cut.dpx", empty = folder / "empty.exr";
    std::string error;
    ASSERT_TRUE(
        write_image(OIIO::ImageBuf(OIIO::ImageSpec(64, 64, 3, OIIO::TypeUInt16)), cut, error))
        << error;
    EXPECT_EQ(probed({cut}).status, Status::Error);
    std::filesystem::resize_file(cut, std::filesystem::file_size(cut) - 4096);
    const Probe half = probed({cut});
    EXPECT_EQ(half.status, Status::Unreadable);
    EXPECT_THAT(half.message, HasSubstr("its header asks for"));

    std::ofstream(empty).close();
    EXPECT_THAT(probed({empty}).message, EndsWith(": it is empty (0 bytes)"));
    if (::geteuid() == 0)
        return; // may read everything
    std::filesystem::permissions(empty, std::filesystem::perms::none);
    EXPECT_THAT(probed({empty}).message, EndsWith("Permission denied"));
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
