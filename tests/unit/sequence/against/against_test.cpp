// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/against/against.h"

#include <algorithm>
#include <gmock/gmock.h>

#include "sequence/verdict/fault_lines.h"

namespace tonetool::sequence {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Window = AgainstRecord::Window;

AgainstRecord record_of(const Window& approved, const Window& window) {
    AgainstRecord record;
    record.approved_data = approved;
    record.data = window;
    return record;
}

constexpr Window kWindow = {0, 0, 640, 360};

AgainstRecord clean() {
    return record_of(kWindow, kWindow);
}

AgainstRecord with(const std::string& kind, const std::string& quantity, double value) {
    AgainstRecord record = clean();
    record.layers.push_back({"Layer", kind, {{quantity, value}}, 3, 4});
    return record;
}

std::vector<std::string> codes_of(const AgainstRecord& record) {
    std::vector<std::string> codes;
    for (const Fault& fault : against_faults(record))
        codes.push_back(std::string(severity_name(fault.severity)) + " " + fault.code);
    return codes;
}

FrameResult result_of(int number, const AgainstRecord& record) {
    FrameResult result;
    result.frame = number;
    result.status = Status::Passed;
    result.against = to_json(record);
    return result;
}

std::vector<FrameResult> shot_of(const std::vector<AgainstRecord>& records) {
    std::vector<FrameResult> frames;
    for (const AgainstRecord& record : records)
        frames.push_back(result_of(int(frames.size()) + 1, record));
    return frames;
}

std::vector<std::string> codes_of(std::vector<FrameResult> frames) {
    judge_against(frames);
    std::vector<std::string> codes;
    for (const FrameResult& frame : frames)
        for (const Fault& fault : frame.faults)
            codes.push_back(std::to_string(frame.frame) + " " + severity_name(fault.severity) +
                            " " + fault.code);
    return codes;
}

TEST(Against, EachQuantityHasItsLimits) {
    for (const AgainstQuantity& quantity : against_quantities()) {
        SCOPED_TRACE(quantity.code);
        const std::string kind = quantity.kind.empty() ? "color" : quantity.kind;
        const double limit = clean().limits.threshold(quantity.code);
        const double warning = quantity.warning_share * limit;
        const auto found = [&](double value) {
            return codes_of(with(kind, quantity.quantity, value));
        };
        EXPECT_THAT(found(0), IsEmpty());
        EXPECT_THAT(found(0.999 * warning), IsEmpty());
        EXPECT_THAT(found(1.001 * warning), ElementsAre("warning " + quantity.code));
        EXPECT_THAT(found(0.999 * limit), ElementsAre("warning " + quantity.code));
        EXPECT_THAT(found(1.001 * limit), ElementsAre("error " + quantity.code));
    }
    EXPECT_THAT(codes_of(with("group", "gain", -0.5)), ElementsAre("error group"));
    EXPECT_THAT(codes_of(with("data", "off", 1)), ElementsAre("info data"));
    EXPECT_THAT(codes_of(with("data", "off", 0)), IsEmpty());
}

TEST(Against, OfOneLayerTheWorstIsToldAndItsAlpha) {
    AgainstRecord record = with("color", "gain", -0.2);
    record.layers[0].quantities["blocks"] = 1;
    record.layers[0].quantities["alpha_off"] = 0.5;
    EXPECT_THAT(codes_of(record), ElementsAre("error color", "error alphaoff"));
    EXPECT_THAT(against_faults(record)[0].sentence, HasSubstr("0.2 stops darker than approved"));
    EXPECT_THAT(against_faults(record)[0].sentence, HasSubstr("most at (3, 4)"));
    EXPECT_EQ(against_faults(record)[0].position, (Position{3, 4}));
    record.layers[0].quantities["gain"] = 0.1; // a warning beside an error
    EXPECT_THAT(codes_of(record), ElementsAre("error colorblocks", "error alphaoff"));
    record.limits.set("colorblocks", "off");
    EXPECT_THAT(codes_of(record), ElementsAre("error alphaoff", "warning color"));
    record.limits.set("color", "0.05,info");
    EXPECT_THAT(codes_of(record), ElementsAre("error alphaoff", "info color"));
}

TEST(Against, DataWindowsThatFollowThePicture) {
    const Window small = {100, 100, 200, 100};
    const auto grown = [](Window window, int by) {
        return Window{window[0] - by, window[1] - by, window[2] + 2 * by, window[3] + 2 * by};
    };
    // With one window in the approved version, any other is a fault.
    EXPECT_THAT(codes_of(shot_of({clean(), record_of(kWindow, grown(kWindow, 1))})),
                ElementsAre("2 error datawindow"));
    // Cropped frame by frame: the new one may be larger, or smaller by two pixels.
    for (const int by : {40, 1, 0, -2})
        EXPECT_THAT(codes_of(shot_of({clean(), record_of(small, grown(small, by))})), IsEmpty());
    EXPECT_THAT(codes_of(shot_of({clean(), record_of(small, grown(small, -3))})),
                ElementsAre("2 warning datawindow"));
    for (size_t side = 0; side < 2; ++side) {
        Window moved = small;
        moved[side] += 3;
        EXPECT_THAT(codes_of(shot_of({clean(), record_of(small, moved)})),
                    ElementsAre("2 warning datawindow"));
        moved[side] -= 6;
        EXPECT_THAT(codes_of(shot_of({clean(), record_of(small, moved)})),
                    ElementsAre("2 warning datawindow"));
    }
    // A frame that is not there has no window.
    AgainstRecord none;
    none.approved = false;
    EXPECT_THAT(codes_of(shot_of({clean(), none, record_of(kWindow, grown(kWindow, 1))})),
                ElementsAre("2 error noapproved", "3 error datawindow"));
    // At an end the new version is longer, unless other frames are on the disk.
    EXPECT_THAT(codes_of(shot_of({clean(), clean(), none})), ElementsAre("3 info noapproved"));
    none.between = true;
    EXPECT_THAT(codes_of(shot_of({clean(), clean(), none})), ElementsAre("3 error noapproved"));
}

TEST(Against, AFileOfAnotherSizeIsToldByItsWindowsAlone) {
    AgainstRecord record = with("depth", "off", 1);
    record.differences = {{"displaywindow", "", "other", Severity::Error}};
    EXPECT_THAT(codes_of(record), ElementsAre("error displaywindow", "error depth"));
    record.data = {0, 0, 320, 180};
    EXPECT_THAT(codes_of(record), ElementsAre("error displaywindow", "error datawindow"));
    record.limits.set("displaywindow", "off");
    EXPECT_THAT(codes_of(record), ElementsAre("error datawindow", "error depth"));
}

TEST(Against, TheMomentOfAnotherApprovedFrame) {
    const auto shot = [](int shown, int at) {
        std::vector<AgainstRecord> records;
        for (int number = 1; number <= 8; ++number) {
            AgainstRecord record = with("depth", "off", number == at ? 0.5 : 0);
            record.approved_moment = "moment " + std::to_string(number);
            record.moment =
                number == at ? "moment " + std::to_string(shown) : record.approved_moment;
            records.push_back(record);
        }
        std::vector<FrameResult> frames = shot_of(records);
        judge_against(frames);
        return frames[size_t(at) - 1].faults.at(0).sentence;
    };
    EXPECT_THAT(shot(3, 4), HasSubstr("; it is the moment of approved frame 3"));
    EXPECT_THAT(shot(6, 4), HasSubstr("; it is the moment of approved frame 6"));
    EXPECT_THAT(shot(1, 4), testing::Not(HasSubstr("moment of approved"))); // three frames away
    EXPECT_THAT(shot(9, 4), testing::Not(HasSubstr("moment of approved")));
}

TEST(Against, WhatNoRuleJudgesDoesNotPass) {
    AgainstRecord off = with("color", "gain", 2), told = with("data", "off", 0.5);
    for (const char* code : {"color", "colorblocks", "nonfinite"})
        off.limits.set(code, "off");
    AgainstRecord judged = with("color", "gain", 0), longer = judged;
    longer.approved = false;
    std::vector<FrameResult> frames =
        shot_of({judged, clean(), off, told, with("data", "alpha_mean", 0), longer});
    judge_against(frames);
    EXPECT_EQ(frames[0].status, Status::Passed);
    for (size_t i = 1; i < frames.size(); ++i) {
        EXPECT_EQ(frames[i].status, Status::Measured) << i;
        EXPECT_FALSE(frames[i].message.empty()) << i;
    }
    told.limits.set("data", "warning");
    frames = shot_of({told});
    judge_against(frames);
    EXPECT_EQ(frames[0].status, Status::Warning);
}

TEST(Against, FramesWithTheSameDifferenceAreOneLine) {
    std::vector<AgainstRecord> records(9, with("normal", "median", 0));
    for (const size_t i : {2U, 3U, 4U})
        records[i] = with("normal", "median", i == 3 ? 9 : 5);
    records[6] = with("normal", "median", 1); // a warning
    for (const size_t i : {7U, 8U})
        records[i].differences.push_back({"header", "", "fps is 25", Severity::Error});
    ShotResult shot;
    shot.frames = shot_of(records);
    judge_against(shot.frames);
    EXPECT_EQ(faults_text(shot),
              "against: frames 3 to 5: error normal: layer Layer is 9 degrees off the approved one "
              "(median), most at (3, 4) (frame 4)\n"
              "against: frame 7: warning normal: layer Layer is 1 degrees off the approved one "
              "(median), most at (3, 4)\n"
              "against: frames 8 to 9: error header: fps is 25\n");
    EXPECT_EQ(shot.frames[0].status, Status::Passed);
    EXPECT_EQ(shot.frames[2].status, Status::Failed);
    EXPECT_EQ(shot.frames[6].status, Status::Warning);
}

TEST(Against, ViewsAreJudgedByThemselvesAndAgain) {
    std::vector<FrameResult> frames = shot_of({clean(), with("id", "mismatch", 0.5)});
    for (FrameResult& frame : frames)
        frame.view = "left";
    FrameResult right = result_of(1, record_of({5, 5, 9, 9}, {4, 4, 9, 9}));
    right.view = "right";
    frames.push_back(right);
    const auto once = codes_of(frames);
    EXPECT_THAT(once, ElementsAre("2 error id", "1 error datawindow"));
    judge_against(frames);
    EXPECT_EQ(codes_of(frames), once);
}

TEST(Against, ARecordIsReadBackAndWhatIsNoneIsRefused) {
    AgainstRecord record = with("depth", "off", 0.1234567890123456789);
    record.layers.push_back({"a \"b\"", "normal", {{"median", 1e-300}, {"one", 0.25}}, -3, 7});
    record.approved_moment = "c0ffee";
    record.limits.set("depth", "0.5,warning");
    record.differences = {{"layermissing", "Extra", "it is missing", Severity::Error}};
    const std::string text = to_json(record);
    EXPECT_EQ(to_json(against_from_json(text)), text);
    EXPECT_EQ(against_from_json(text).layers[0].quantities, record.layers[0].quantities);
    AgainstRecord none;
    none.approved = false;
    EXPECT_EQ(to_json(against_from_json(to_json(none))), to_json(none));
    const auto refused = [&](const std::string& what, const std::string& by) {
        std::string changed = text;
        const size_t at = changed.find(what);
        ASSERT_NE(at, std::string::npos) << what;
        changed.replace(at, what.size(), by);
        EXPECT_THROW(against_from_json(changed), std::runtime_error) << changed;
    };
    refused("\"layermissing\"", "\"layermising\"");
    refused("\"error\"", "\"loud\"");
    refused("\"depth\":\"0.5,warning\"", "\"depht\":\"1\"");
    refused("0.5,warning", "0.5,0.6");
    refused("\"one\":0.25", "\"one\":\"much\"");
    refused("[-3,7]", "[-3]");
    refused("\"approved\":true", "\"approved\":1");
    EXPECT_THROW(against_from_json(""), std::runtime_error);
    EXPECT_THROW(against_from_json("{}"), std::runtime_error);
    EXPECT_THROW(against_from_json("[1]"), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
