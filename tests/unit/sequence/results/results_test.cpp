// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/results.h"

#include <cmath>
#include <gmock/gmock.h>
#include <stdexcept>

#include "sequence/qc/qc_json.h"
#include "sequence/results/results_json.h"

namespace tonetool::sequence {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

Measurement measured(double value, std::optional<double> fail) {
    Measurement one;
    one.command = "hdrflip";
    one.reference = "ref.exr";
    one.test = "test.exr";
    one.thresholds = {Threshold{"p99", value, false, fail, {}}};
    one.quantities = {{"mean", value / 3}, {"p99", value}};
    one.histogram.assign(100, 0); // five pixels of which the sum is that of the sixth
    if (std::isfinite(value)) {
        one.histogram[size_t(value / 5 * 100)] = 5;
        one.histogram[size_t(value * 100)] += 1;
    } else {
        one.histogram[0] = 6;
    }
    one.worst = Position{4, -5};
    one.pixels = 6;
    one.exposures = {-1.25, 1.0 / 3};
    one.parameters = {{"ppd", 67.0206}};
    one.settings = {{"tonemapper", "aces"}};
    one.warnings = {"2 pixels are not finite"};
    return one;
}

FrameResult frame(int number, double value, std::optional<double> fail = 0.5) {
    FrameResult result;
    result.frame = number;
    result.status = Status::Passed;
    result.measurements = {measured(value, fail)};
    judge(result);
    return result;
}

FrameResult missing(int number) {
    FrameResult result;
    result.frame = number;
    result.status = Status::Missing;
    result.message = "no file \"a\"";
    judge(result);
    return result;
}

ShotResult shot(std::vector<FrameResult> frames) {
    ShotResult result;
    result.check = {"a.#.exr", "--hdrflip:fail=p99=0.5"};
    result.frames = std::move(frames);
    conclude(result);
    return result;
}

TEST(Judge, AValueAtItsThresholdPassesAndAboveFails) {
    EXPECT_EQ(frame(1, 0.5).status, Status::Passed);
    EXPECT_EQ(frame(1, 0.50001).status, Status::Failed);
    EXPECT_THAT(frame(1, 0.75).message, HasSubstr("hdrflip: p99 0.75 > 0.5"));
}

TEST(Judge, AValueThatIsNoNumberFails) {
    EXPECT_EQ(frame(1, std::nan("")).status, Status::Failed);
}

TEST(Judge, AllThresholdsMustHold) {
    const auto judged = [](std::vector<Threshold> thresholds) {
        FrameResult result = frame(1, 0.1);
        result.measurements.at(0).thresholds = std::move(thresholds);
        judge(result);
        return result;
    };
    const Threshold mean{"mean", 0.1, false, 0.2, {}}, p99{"p99", 0.6, false, 0.5, {}},
        warned{"max", 0.9, false, {}, 0.8}, psnr{"psnr", 20, true, 30.0, {}};
    EXPECT_EQ(judged({mean}).status, Status::Passed);
    EXPECT_EQ(judged({mean, p99}).status, Status::Failed);
    EXPECT_EQ(judged({p99, mean}).message, "hdrflip: p99 0.6 > 0.5");
    EXPECT_EQ(judged({p99, psnr}).message, "hdrflip: p99 0.6 > 0.5, psnr 20 < 30");
    EXPECT_EQ(judged({mean, warned}).status, Status::Warning);
    EXPECT_EQ(judged({warned, p99}).message, "hdrflip: p99 0.6 > 0.5");
    EXPECT_GT(badness(judged({mean, psnr})), badness(judged({mean, p99})));
    const FrameResult both = judged({mean, p99});
    EXPECT_EQ(frame_from_json(to_json(both)).measurements.at(0).thresholds.size(), 2u);
}

TEST(Judge, AThresholdOfAnOlderPartIsRead) {
    std::string text = to_json(frame(1, 0.6));
    const auto at = text.find("\"thresholds\"");
    ASSERT_NE(at, std::string::npos);
    const auto begin = text.find('{', at), end = text.find('}', begin) + 1;
    const std::string one = text.substr(begin, end - begin);
    text = text.substr(0, at) + "\"threshold\": " + one + text.substr(text.find(']', end) + 1);
    FrameResult result = frame_from_json(text);
    judge(result);
    EXPECT_EQ(result.status, Status::Failed);
}

TEST(Judge, WithoutAThresholdNothingIsPassed) {
    EXPECT_EQ(frame(1, 0.1, std::nullopt).status, Status::Measured);
}

TEST(Judge, AThresholdThatHoldsPassesBesideAMeasurementWithoutOne) {
    FrameResult result = frame(1, 0.1);
    result.measurements.push_back(measured(0.9, std::nullopt));
    judge(result);
    EXPECT_EQ(result.status, Status::Passed);
}

TEST(Judge, WithoutAMeasurementItIsAnError) {
    FrameResult empty;
    empty.status = Status::Passed;
    judge(empty);
    EXPECT_EQ(empty.status, Status::Error);
}

TEST(Judge, WhatIsWorseThanAFailureStays) {
    EXPECT_EQ(missing(3).status, Status::Missing);
    EXPECT_EQ(missing(3).message, "no file \"a\"");
}

TEST(Judge, AFaultCountsByItsSeverity) {
    FrameResult result = frame(1, 0.1);
    result.faults = {{"dark", Severity::Info, "A bit dark.", "", {}, {}, {}}};
    judge(result);
    EXPECT_EQ(result.status, Status::Passed);
    result.faults.push_back({"nan", Severity::Error, "NaN.", "", {}, {}, {}});
    judge(result);
    EXPECT_EQ(result.status, Status::Failed);
    EXPECT_EQ(result.message, "NaN.");
}

TEST(Conclude, TheWorstComeFirst) {
    const ShotResult result = shot({frame(9, 0.9), frame(1, 0.1), missing(4), frame(2, 0.95)});
    EXPECT_EQ(result.verdict, Status::Missing);
    EXPECT_THAT(result.worst, ElementsAre(2, 1, 3)); // of 1, 2, 4, 9
    EXPECT_THAT(result.sentence, HasSubstr("4 frames: 1 missing, 2 failed, 1 passed"));
    EXPECT_EQ(exit_status(result.verdict, false), 1);
}

TEST(Conclude, WhereAllPassedTheLargestErrorIsNamed) {
    const ShotResult result = shot({frame(1, 0.1), frame(2, 0.3), frame(3, 0.2)});
    EXPECT_EQ(result.verdict, Status::Passed);
    EXPECT_THAT(result.worst, ElementsAre(1));
    EXPECT_EQ(exit_status(result.verdict, true), 0);
}

TEST(Conclude, WhereHigherIsBetterTheLowestIsNamed) {
    const auto of = [](const char* command, const char* quantity, std::vector<double> values) {
        std::vector<FrameResult> frames;
        for (const double value : values) {
            FrameResult one = frame(int(frames.size()) + 1, 0.1, std::nullopt);
            one.measurements[0].command = command;
            one.measurements[0].quantities = {{quantity, value}, {"mean", 0.1}};
            frames.push_back(one);
        }
        return shot(frames).worst;
    };
    EXPECT_THAT(of("errormap", "psnr", {HUGE_VAL, 20, 30}), ElementsAre(1));
    EXPECT_THAT(of("errormap", "psnr", {3, -5, -1}), ElementsAre(1));
    EXPECT_THAT(of("errormap", "mpsnr", {HUGE_VAL, 20, 30}), ElementsAre(1));
    EXPECT_THAT(of("tmqi", "Q", {0.9, 0.8, 0.2}), ElementsAre(2));
    EXPECT_THAT(of("errormap", "mse", {0.9, 20, 0.8}), ElementsAre(1));
    EXPECT_THAT(of("hdrflip", "mean", {0.1, 0.2, 0.15}), ElementsAre(1));
}

TEST(Conclude, AValueThatIsNoNumberIsTheWorst) {
    EXPECT_THAT(shot({frame(1, 0.9), frame(2, std::nan("")), frame(3, 0.8)}).worst,
                ElementsAre(1, 0, 2));
    EXPECT_THAT(shot({frame(1, 0.9, std::nullopt), frame(2, std::nan(""), std::nullopt)}).worst,
                ElementsAre(1));
}

TEST(Conclude, NoFrameIsAnErrorAndOneTwiceIsRefused) {
    EXPECT_EQ(exit_status(shot({}).verdict, false), 1);
    EXPECT_THROW(shot({frame(1, 0.1), frame(1, 0.2)}), std::runtime_error);
}

std::string qc_text() {
    QcRecord record;
    record.facts.parts.resize(1);
    record.facts.parts[0].metadata["1/3"] = "0.333";
    record.facts.picture.group_sum = 1.0 / 3;
    record.facts.picture.groups = 1;
    QcPicture& picture = record.facts.picture;
    picture.thumbnail.resize(size_t(QcPicture::kWide) * QcPicture::kHigh, -2474);
    picture.red = picture.blue = std::vector<int16_t>(picture.thumbnail.size());
    picture.peaks.resize(size_t(QcPicture::kPeaksWide) * QcPicture::kPeaksHigh);
    picture.fingerprints.resize(picture.peaks.size());
    record.limits.set("light", "0.1,error");
    return to_json(record);
}

TEST(Json, ComesBackToTheByte) {
    FrameResult second = frame(2, std::nextafter(0.1, 1.0));
    second.view = "left";
    second.faults = {{"odd", Severity::Warning, "NaN.", "R", Position{1, 2}, -HUGE_VAL, 1e-310}};
    second.qc = qc_text();
    judge(second);
    FrameResult first = frame(1, 0.75);
    first.measurements[0].parameters = {{"ppd", std::nan("")}, {"peak", HUGE_VAL}};
    ShotResult result = shot({first, second, missing(7)});
    result.exposures = ShotExposures{1.0 / 3, 0.1, 8};
    const std::string text = to_json(result);
    EXPECT_EQ(to_json(shot_from_json(text)), text);
    EXPECT_EQ(shot_from_json(text).frames[1].measurements[0].thresholds.at(0).value,
              std::nextafter(0.1, 1.0));
    EXPECT_EQ(to_json(frame_from_json(to_json(second))), to_json(second));
}

TEST(Json, EveryNameOfAStatusComesBack) {
    for (int i = 0; i <= int(Status::Error); ++i)
        EXPECT_EQ(status_of_name(status_name(Status(i))), Status(i));
    EXPECT_FALSE(status_of_name("fine"));
}

TEST(Json, NamesThatAreNoTextDoNotBreakIt) {
    FrameResult odd = missing(1);
    odd.test = "a\xff\"\n.exr";
    EXPECT_EQ(frame_from_json(to_json(odd)).test, "a\xEF\xBF\xBD\"\n.exr");
}

std::string refusal(const std::string& text) {
    try {
        shot_from_json(text);
    } catch (const std::runtime_error& problem) {
        return problem.what();
    }
    return "accepted";
}

TEST(Json, RefusesWhatIsNoResultAndSaysWhy) {
    EXPECT_THAT(refusal("[]"), HasSubstr("tonetool-check"));
    EXPECT_THAT(refusal("{"), HasSubstr("parse error"));
    EXPECT_THAT(refusal(R"({"format":"tonetool-check","version":9})"), HasSubstr("version 9"));
    EXPECT_THAT(refusal(R"({"format":"tonetool-check","version":2,"check":[],
        "frames":[{"frame":1,"status":"fine"}]})"),
                HasSubstr("\"fine\""));
    EXPECT_THAT(refusal(R"({"format":"tonetool-check","version":2,"check":[],
        "frames":[{"status":"passed"}]})"),
                HasSubstr("'frame'"));
}

} // namespace
} // namespace tonetool::sequence
