// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/tables.h"

#include <cmath>
#include <gmock/gmock.h>

namespace tonetool::sequence {
namespace {

using testing::HasSubstr;
using testing::Not;

FrameResult frame(int number, Status status, const std::string& test) {
    FrameResult made;
    made.frame = number;
    made.status = status;
    made.test = test;
    return made;
}

ShotResult shot() {
    ShotResult made;
    made.frames = {frame(1, Status::Passed, "a.exr"), frame(2, Status::Failed, "=x,\"y\".exr"),
                   frame(3, Status::Missing, "<img src=\"&\x01\">.exr"),
                   frame(4, Status::Measured, "b\xff.exr")};
    made.frames[1].message = "p99 1 > 0.5";
    Measurement measured;
    measured.command = "hdrflip";
    measured.thresholds = {Threshold{"p99", 1, false, 0.5, {}}};
    measured.quantities = {{"mean", 0.1}, {"p99", std::nan("")}};
    made.frames[1].measurements = {measured, measured};
    return made;
}

TEST(Csv, CellsAreQuotedAndNoFormula) {
    const std::string text = csv_text(shot());
    EXPECT_THAT(text, HasSubstr("frame,view,status,message,reference,test,faults,"
                                "hdrflip.threshold,hdrflip.mean,hdrflip.p99,"
                                "hdrflip#2.threshold,hdrflip#2.mean,hdrflip#2.p99\r\n"));
    EXPECT_THAT(text, HasSubstr("1,,passed,,,a.exr,,,,,,,\r\n"));
    EXPECT_THAT(text, HasSubstr("2,,failed,p99 1 > 0.5,,\"'=x,\"\"y\"\".exr\",,0.5,0.1,nan,"));
    EXPECT_THAT(text, HasSubstr("b\xEF\xBF\xBD.exr"));
}

TEST(Csv, FurtherThresholdsHaveColumnsOfTheirOwn) {
    ShotResult made = shot();
    made.frames[1].measurements.resize(1);
    made.frames[1].measurements[0].thresholds.push_back({"mean", 0.1, false, 0.25, {}});
    EXPECT_THAT(csv_text(made), HasSubstr("faults,hdrflip.threshold,hdrflip.threshold.mean,"
                                          "hdrflip.mean,hdrflip.p99\r\n"));
    EXPECT_THAT(csv_text(made), HasSubstr(",,0.5,0.25,0.1,nan\r\n"));
}

TEST(Junit, OnlyWhatPassedIsAPlainCase) {
    const std::string text = junit_text(shot());
    EXPECT_THAT(text, HasSubstr("tests=\"4\" failures=\"1\" errors=\"1\" skipped=\"1\""));
    EXPECT_THAT(text, HasSubstr("<testcase classname=\"a.exr\" name=\"frame 0001\"/>"));
    EXPECT_THAT(text, HasSubstr("<failure type=\"failed\" message=\"p99 1 &gt; 0.5\">"));
    EXPECT_THAT(text, HasSubstr("<error type=\"missing\""));
    EXPECT_THAT(text, HasSubstr("<skipped message="));
}

TEST(Junit, NamesAreEscaped) {
    const std::string text = junit_text(shot());
    EXPECT_THAT(text, Not(HasSubstr("<img")));
    EXPECT_THAT(text, HasSubstr("&lt;img src=&quot;&amp;\xEF\xBF\xBD&quot;&gt;.exr"));
}

} // namespace
} // namespace tonetool::sequence
