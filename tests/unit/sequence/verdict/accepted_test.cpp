// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/accepted.h"

#include <OpenImageIO/filesystem.h>
#include <gmock/gmock.h>

#include "sequence/results/results_json.h"

namespace tonetool::sequence {
namespace {

namespace fs = OIIO::Filesystem;
using testing::ElementsAre;
using testing::HasSubstr;

FrameResult faulty(int number, const std::vector<std::string>& layers) {
    FrameResult frame;
    frame.frame = number;
    frame.status = Status::Passed;
    for (const std::string& layer : layers)
        frame.faults.push_back(
            {"blacklayer", Severity::Error, layer + " is black", layer, {}, {}, {}});
    judge(frame);
    return frame;
}

ShotResult shot(const std::vector<Acceptance>& accepted) {
    ShotResult result;
    result.check = {"a.#.exr"};
    result.frames = {faulty(1, {"neon"}), faulty(2, {"neon", "key"})};
    result.accepted = accepted;
    conclude(result);
    return result;
}

std::string why_not(const std::string& text) {
    const std::string name = testing::TempDir() + fs::unique_path("accepted-%%%%%%%%");
    fs::write_text_file(name, text);
    try {
        (void)read_acceptances(name);
    } catch (const std::runtime_error& problem) {
        fs::remove(name);
        return problem.what();
    }
    fs::remove(name);
    return "";
}

TEST(Accepted, FaultsBecomeInformationAndDoNotFailTheirFrame) {
    const ShotResult found = shot({{1, "", "blacklayer", "", "Ann", "the lamp is off"}});
    EXPECT_EQ(found.frames[0].status, Status::Passed);
    EXPECT_EQ(found.frames[0].faults[0].severity, Severity::Info);
    EXPECT_EQ(found.frames[0].faults[0].sentence,
              "accepted by Ann (the lamp is off): neon is black");
    EXPECT_EQ(found.frames[1].status, Status::Failed);
    EXPECT_EQ(found.verdict, Status::Failed);
}

TEST(Accepted, OneLayerWhereOneIsNamed) {
    const ShotResult found = shot({{2, "", "blacklayer", "key", "", ""}});
    EXPECT_EQ(found.frames[1].faults[0].severity, Severity::Error);
    EXPECT_EQ(found.frames[1].faults[1].sentence, "accepted: key is black");
    EXPECT_EQ(found.frames[1].status, Status::Failed);
}

TEST(Accepted, WhatIsNotThereIsSaid) {
    const ShotResult found = shot({{1, "", "nan", "", "", ""},
                                   {1, "left", "blacklayer", "", "", ""},
                                   {7, "", "blacklayer", "", "", ""},
                                   {2, "", "blacklayer", "", "", ""}});
    EXPECT_THAT(unused_acceptances(found),
                ElementsAre("frame 1: nan is accepted, but there is no such fault",
                            "2 of 4 accepted faults are of frames that were not checked here"));
}

TEST(Accepted, ResultsKeepItAndAMergeOfThemDoes) {
    const ShotResult found = shot({{1, "", "blacklayer", "", "Ann", ""}});
    ShotResult again = shot_from_json(to_json(found));
    EXPECT_EQ(to_json(again), to_json(found));
    conclude(again);
    EXPECT_EQ(to_json(again), to_json(found)); // not accepted twice
}

TEST(Accepted, AFileThatIsNoneOrOfAnotherCheckIsRefused) {
    EXPECT_THAT(why_not("{"), HasSubstr("valid: a file that the report's page exports"));
    EXPECT_THAT(why_not("{}"), HasSubstr("has no \"check\" and \"accepted\""));
    EXPECT_THAT(why_not(R"({"check":"0","accepted":[{"frame":"x","code":"nan"}]})"),
                HasSubstr("accepted/0"));
    EXPECT_THAT(why_not(R"({"check":"0","accepted":{"frame":1}})"), HasSubstr("accepted"));
    EXPECT_EQ(why_not(R"({"check":"0","accepted":[]})"), "");
    const std::vector<std::string> check{"a.#.exr", "--qc"}, other{"a.#.exr--qc"};
    EXPECT_NE(check_id(check), check_id(other));
    EXPECT_NO_THROW(check_same_check({check_id(check), {}}, check, "f"));
    EXPECT_THROW(check_same_check({check_id(other), {}}, check, "f"), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
