// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/qc/qc.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <gmock/gmock.h>
#include <random>

#include "sequence/results/results_json.h"
#include "sequence/verdict/fault_lines.h"
#include "shots.h"

namespace tonetool::sequence {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

using Change = void (*)(QcFacts& facts);

// Twelve frames, of which those from first to last are changed.
std::vector<FrameResult> shot_with(int first, int last, Change change) {
    std::vector<FrameResult> frames;
    for (int number = 1; number <= 12; ++number) {
        QcFacts facts = facts_of(number);
        if (number >= first && number <= last)
            change(facts);
        frames.push_back(result_of(number, facts));
    }
    return frames;
}

void brighter(QcFacts& facts) {
    for (int16_t& cell : facts.picture.thumbnail)
        cell += 800;
    facts.picture.hash += "brighter";
}

void without_key(QcFacts& facts) {
    facts.layers[1].lit = 0;
    facts.layers[1].mean = facts.layers[1].max = 0;
}

TEST(Qc, ACleanShotHasNoFault) {
    EXPECT_THAT(codes_of(shot_with(1, 12, [](QcFacts&) {})), IsEmpty());
}

TEST(Qc, FindsWhatIsOddInAFrame) {
    EXPECT_THAT(codes_of(shot_with(4, 4, without_key)), ElementsAre("4 blacklayer"));
    EXPECT_THAT(codes_of(shot_with(6, 6, brighter)), ElementsAre("6 flicker"));
    EXPECT_THAT(codes_of(shot_with(6, 7, brighter)), ElementsAre("6 flicker"));
    EXPECT_THAT(codes_of(shot_with(7, 12, brighter)), ElementsAre("7 light"));
    EXPECT_THAT(codes_of(shot_with(5, 5, [](QcFacts& f) { f.layers[0].nan.pixels = 1; })),
                ElementsAre("5 nan"));
    EXPECT_THAT(codes_of(shot_with(5, 8, [](QcFacts& f) { f.parts[0].compression = "none"; })),
                ElementsAre("5 compression"));
    EXPECT_THAT(codes_of(shot_with(5, 5, [](QcFacts& f) { f.picture.group_difference = 0.01; })),
                ElementsAre("5 lightsum"));
    EXPECT_THAT(codes_of(shot_with(5, 5, [](QcFacts& f) { f.channels[1].second = "float"; })),
                ElementsAre("5 type"));
}

// Frames with a rectangle of this value.
void with_rectangle(QcFacts& facts, int x, float value, bool background = false) {
    facts.picture.rectangles.push_back({x, 96, 64, 64, {value, value, value}, background});
}

TEST(Qc, AHoleIsInNoFrameAround) {
    const Change hole = [](QcFacts& facts) { with_rectangle(facts, 160, 0); };
    EXPECT_THAT(codes_of(shot_with(6, 6, hole)), ElementsAre("6 hole"));
    EXPECT_THAT(codes_of(shot_with(6, 7, hole)), ElementsAre("6 hole", "7 hole"));
    EXPECT_THAT(codes_of(shot_with(12, 12, hole)), ElementsAre("12 hole"));
    EXPECT_THAT(codes_of(shot_with(1, 12, hole)), IsEmpty());
    const Change bar = [](QcFacts& facts) {
        facts.picture.rectangles.push_back({0, 0, 640, 40, {}, false});
    };
    EXPECT_THAT(codes_of(shot_with(1, 12, bar)), ElementsAre("1 bars"));
}

TEST(Qc, ALampADarkPlaceAndAMatteAreNoHoles) {
    std::vector<FrameResult> lamp, dark, matte, moves;
    for (int number = 1; number <= 12; ++number) {
        QcFacts facts = facts_of(number), black = facts, element = facts, moving = facts;
        if (number == 6 || number == 9)
            with_rectangle(facts, 160, 1);
        for (int16_t& cell : black.picture.thumbnail)
            cell = QcPicture::kDark;
        black.picture.thumbnail[0] = 0;
        element.picture.alpha_clear = 0.3;
        if (number == 6) {
            with_rectangle(black, 160, 0);
            with_rectangle(element, 160, 0);
        }
        if (number > 4)
            with_rectangle(moving, 10 * number, 0);
        lamp.push_back(result_of(number, facts));
        dark.push_back(result_of(number, black));
        matte.push_back(result_of(number, element));
        moves.push_back(result_of(number, moving));
    }
    EXPECT_THAT(codes_of(lamp), IsEmpty());
    EXPECT_THAT(codes_of(dark), IsEmpty());
    EXPECT_THAT(codes_of(matte), IsEmpty());
    EXPECT_THAT(codes_of(moves), IsEmpty());
}

TEST(Qc, TheRimOfASetIsNoHole) {
    std::vector<FrameResult> frames, plain;
    for (int number = 1; number <= 12; ++number) {
        QcFacts facts = facts_of(number);
        if (number == 6)
            with_rectangle(facts, 576, 0); // up to the right border
        frames.push_back(result_of(number, facts));
        facts.picture.borders.right.fill(60);
        plain.push_back(result_of(number, facts));
    }
    EXPECT_THAT(codes_of(frames), ElementsAre("6 hole"));
    EXPECT_THAT(codes_of(plain), IsEmpty());
}

TEST(Qc, AHoleWithNothingBehindItIsAWarning) {
    std::vector<FrameResult> frames =
        shot_with(6, 6, [](QcFacts& facts) { with_rectangle(facts, 160, 0, true); });
    judge_qc(frames);
    EXPECT_EQ(frames[5].status, Status::Warning);
    frames = shot_with(6, 6, [](QcFacts& facts) { with_rectangle(facts, 160, NAN); });
    judge_qc(frames);
    EXPECT_EQ(frames[5].status, Status::Failed);
    ASSERT_EQ(frames[5].faults.size(), 1U);
    EXPECT_EQ(frames[5].faults[0].position, (Position{160, 96}));
}

// The frames of a shot by the moments that they show. With other noise, only geometry tells them.
std::vector<std::string> codes_of_moments(const std::vector<int>& moments, bool other_noise) {
    std::vector<FrameResult> frames;
    for (size_t i = 0; i < moments.size(); ++i) {
        const int number = int(i) + 1;
        QcFacts facts = facts_of(moments[i]);
        facts.layers.push_back(
            {"Depth", "depth", std::to_string(moments[i]), false, 1, 0, 3, 1, {}, {}, {}});
        if (other_noise)
            facts.picture.hash += "seed " + std::to_string(number);
        frames.push_back(result_of(number, facts));
    }
    judge_qc(frames);
    std::vector<std::string> codes;
    for (const FrameResult& frame : frames)
        for (const Fault& fault : frame.faults)
            codes.push_back(std::to_string(frame.frame) + " " + severity_name(fault.severity) +
                            " " + fault.code);
    return codes;
}

TEST(Qc, AMomentThatIsShownAgain) {
    for (const bool noise : {false, true}) {
        EXPECT_THAT(codes_of_moments({1, 2, 3, 4, 5, 6, 6, 8, 9, 10, 11, 12}, noise),
                    ElementsAre("7 warning duplicate"));
        EXPECT_THAT(codes_of_moments({1, 2, 3, 4, 5, 6, 7, 8, 9, 3, 11, 12}, noise),
                    ElementsAre("10 error repeat"));
        // A still, twos, a loop, a pose of rest to which a movement comes back.
        EXPECT_THAT(codes_of_moments({5, 5, 5, 5, 5, 5, 5}, noise), IsEmpty());
        EXPECT_THAT(codes_of_moments({1, 1, 2, 2, 3, 3, 4, 4, 5, 5, 6, 6}, noise), IsEmpty());
        EXPECT_THAT(codes_of_moments({1, 2, 3, 4, 5, 6, 1, 2, 3, 4, 5, 6}, noise), IsEmpty());
        EXPECT_THAT(codes_of_moments({1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 1}, noise), IsEmpty());
    }
}

TEST(Qc, FrozenFramesAreAnErrorInsideTheShot) {
    const std::vector<int> inside = {1, 2, 3, 4, 5, 5, 5, 5, 9, 10, 11, 12};
    EXPECT_THAT(codes_of_moments(inside, false), ElementsAre("6 error frozen"));
    EXPECT_THAT(codes_of_moments(inside, true), ElementsAre("6 warning frozen"));
    EXPECT_THAT(codes_of_moments({1, 1, 1, 1, 1, 6, 7, 8, 9, 10, 11, 12}, false),
                ElementsAre("2 warning frozen"));
    EXPECT_THAT(codes_of_moments({1, 2, 3, 4, 5, 6, 7, 8, 9, 9, 9, 9}, false),
                ElementsAre("10 warning frozen"));
}

// With a fixed camera the depth of most frames is one, and the picture tells.
TEST(Qc, GeometryThatStandsStillIsNoFrozenFrame) {
    EXPECT_THAT(codes_of_moments({5, 5, 5, 5, 5, 5, 5, 8, 5, 5, 5, 5}, true), IsEmpty());
}

TEST(Qc, AHoldByIntentMayBeMadeAnError) {
    FaultLimits limits(qc_rules());
    EXPECT_EQ(limits.severity("frozen", Severity::Warning), Severity::Warning);
    EXPECT_EQ(limits.severity("duplicate", Severity::Error), Severity::Warning);
    limits.set("frozen", "5");
    EXPECT_EQ(limits.severity("frozen", Severity::Warning), Severity::Warning);
    limits.set("frozen", "5,error");
    EXPECT_EQ(limits.severity("frozen", Severity::Warning), Severity::Error);
    limits.set("frozen", "off");
    EXPECT_FALSE(limits.severity("frozen", Severity::Warning));
}

// A cell of the same light beside it, a frame before, is a lamp that moves.
TEST(Qc, AFireflyIsAloneInTimeToo) {
    const Change firefly = [](QcFacts& facts) {
        facts.picture.spikes = {{300, 200, 1000, 0.5}};
        facts.picture.peaks[size_t(20 * QcPicture::kPeaksWide + 30)] = 80;
    };
    EXPECT_THAT(codes_of(shot_with(5, 5, firefly)), ElementsAre("5 firefly"));
    EXPECT_THAT(codes_of(shot_with(5, 6, firefly)), IsEmpty());
    EXPECT_THAT(codes_of(shot_with(1, 12, firefly)), IsEmpty());
}

TEST(Qc, ALayerThatFadesOutIsNoFault) {
    std::vector<FrameResult> frames;
    for (int number = 1; number <= 12; ++number) {
        QcFacts facts = facts_of(number);
        facts.layers[1].mean = std::max(0.0, 0.1 * (8 - number));
        facts.layers[1].lit = number < 8 ? 1000 : 0;
        frames.push_back(result_of(number, facts));
    }
    EXPECT_THAT(codes_of(frames), IsEmpty());
    frames.erase(frames.begin() + 3,
                 frames.begin() + 7); // from 0.5 to nothing, and frames that lack
    EXPECT_THAT(codes_of(frames), ElementsAre("8 missing", "8 blacklayer"));
}

TEST(Qc, HeaderFieldsThatChangeAllTheTimeAreNoFault) {
    std::vector<FrameResult> frames;
    for (int number = 1; number <= 12; ++number) {
        QcFacts facts = facts_of(number);
        facts.parts[0].metadata["seed"] = std::to_string(number);
        facts.parts[0].metadata["DateTime"] = number < 5 ? "noon" : "evening";
        facts.parts[0].data[0] = number;
        frames.push_back(result_of(number, facts));
    }
    EXPECT_THAT(codes_of(frames), IsEmpty());
}

TEST(Qc, AStillAndAnimationOnTwosHaveNoDuplicates) {
    std::vector<FrameResult> twos;
    for (int number = 1; number <= 12; ++number)
        twos.push_back(result_of(number, facts_of(number / 2)));
    EXPECT_THAT(codes_of(twos), IsEmpty());
    twos.clear();
    for (int number = 1; number <= 12; ++number)
        twos.push_back(result_of(number, facts_of(number == 7 ? 6 : number)));
    EXPECT_THAT(codes_of(twos), ElementsAre("7 duplicate"));
}

TEST(Qc, WhatTasksLeaveInHeadersIsNoFault) {
    std::vector<FrameResult> frames;
    for (int number = 1; number <= 12; ++number) {
        QcFacts facts = facts_of(number);
        facts.parts[0].metadata["jobName"] = "chunk" + std::to_string((number - 1) / 3);
        facts.parts[0].metadata["renderHost"] = number < 5 ? "node1" : "node2";
        facts.parts[0].metadata["cameraMatrix"] = number < 5 ? "1 0 0 1" : "2 0 0 1";
        facts.parts[0].metadata["matrix"] = number < 5 ? "1 0 0 0 1 0 0 0 1" : "2 0 0 0 1 0 0 0 1";
        frames.push_back(result_of(number, facts));
    }
    EXPECT_THAT(codes_of(frames), IsEmpty());
    EXPECT_THAT(codes_of(shot_with(
                    5, 5, [](QcFacts& f) { f.parts[0].metadata["activeCamera"] = "persp"; })),
                ElementsAre("5 metadata"));
}

// The severities of the first fault of each frame that has one.
std::vector<std::string> severities_of(std::vector<FrameResult> frames) {
    judge_qc(frames);
    std::vector<std::string> found;
    for (const FrameResult& frame : frames)
        if (!frame.faults.empty())
            found.push_back(std::to_string(frame.frame) + " " +
                            severity_name(frame.faults[0].severity) + " " + frame.faults[0].code);
    return found;
}

TEST(Qc, ALayerThatStaysBlackOrIsMotionIsAWarning) {
    EXPECT_THAT(severities_of(shot_with(4, 6, without_key)), ElementsAre("4 error blacklayer"));
    EXPECT_THAT(severities_of(shot_with(4, 7, without_key)), ElementsAre("4 warning blacklayer"));
    EXPECT_THAT(severities_of(shot_with(11, 12, without_key)),
                ElementsAre("11 warning blacklayer"));
    std::vector<FrameResult> frames;
    for (int number = 1; number <= 12; ++number) {
        QcFacts facts = facts_of(number);
        facts.layers.push_back({"vector", "motion", "", false, 90000, 0, 2, 0.1, {}, {}, {}});
        if (number == 5)
            facts.layers[2].lit = 0;
        frames.push_back(result_of(number, facts));
    }
    EXPECT_THAT(severities_of(frames), ElementsAre("5 warning blacklayer"));
}

TEST(Qc, AlphaThatHidesOneFrameIsAnError) {
    const Change hidden = [](QcFacts& facts) {
        facts.picture.lit = 230000;
        facts.picture.unseen.pixels = 220000;
        facts.picture.unseen.first = {{0, 0, 0, 0}};
    };
    EXPECT_THAT(severities_of(shot_with(6, 6, hidden)), ElementsAre("6 error alphaempty"));
    std::vector<FrameResult> all = shot_with(1, 12, hidden);
    EXPECT_THAT(severities_of(all), testing::Contains("6 warning alphaempty"));
    EXPECT_THAT(severities_of(all), testing::Not(testing::Contains("6 error alphaempty")));
}

TEST(Qc, EnlargedAndCoarsePicturesAreToldOnceForTheirFrames) {
    EXPECT_THAT(codes_of(shot_with(3, 7,
                                   [](QcFacts& f) {
                                       f.picture.pairs = {0.2, 0.98};
                                   })),
                ElementsAre("3 proxy"));
    EXPECT_THAT(codes_of(shot_with(3, 7,
                                   [](QcFacts& f) {
                                       f.picture.pairs = {0.95, 0.95};
                                   })),
                IsEmpty());
    const Change coarse = [](QcFacts& facts) {
        facts.picture.greens = 100000;
        facts.picture.distinct = 240;
    };
    EXPECT_THAT(codes_of(shot_with(1, 12, coarse)), ElementsAre("1 bands"));
    EXPECT_THAT(codes_of(shot_with(1, 12,
                                   [](QcFacts& facts) {
                                       facts.picture.greens = 100000;
                                       facts.picture.distinct = 240;
                                       for (auto& channel : facts.channels)
                                           channel.second = "uint8";
                                   })),
                IsEmpty());
}

TEST(Qc, ViewsAreJudgedByThemselves) {
    std::vector<FrameResult> frames = shot_with(4, 4, without_key);
    std::vector<FrameResult> right = shot_with(1, 12, brighter);
    for (FrameResult& frame : frames)
        frame.view = "left";
    for (FrameResult& frame : right) {
        frame.view = "right";
        frames.push_back(frame);
    }
    EXPECT_THAT(codes_of(frames), ElementsAre("4 blacklayer"));
}

TEST(Qc, SeveritiesAndThresholdsAreThoseThatWereAskedFor) {
    std::vector<FrameResult> frames = shot_with(6, 6, brighter);
    FaultLimits limits(qc_rules());
    limits.set("flicker", "0.1,error");
    for (FrameResult& frame : frames)
        frame.qc = to_json(QcRecord{qc_from_json(frame.qc).facts, limits});
    judge_qc(frames);
    ASSERT_EQ(frames[5].faults.size(), 1U);
    EXPECT_EQ(frames[5].status, Status::Failed);
    EXPECT_EQ(frames[5].faults[0].threshold, 0.1);
    EXPECT_NEAR(*frames[5].faults[0].value, 0.8, 0.05);
    limits.set("flicker", "off");
    for (FrameResult& frame : frames)
        frame.qc = to_json(QcRecord{qc_from_json(frame.qc).facts, limits});
    EXPECT_THAT(codes_of(frames), IsEmpty());
}

TEST(Qc, LimitsRefuseWhatTheyCannotBe) {
    FaultLimits limits(qc_rules());
    EXPECT_THROW(limits.set("jmp", "1"), std::runtime_error);
    for (const char* text : {"", "-1", "1,2", "loud", "off,off", "nan", "inf", "1,error,off"})
        EXPECT_THROW(limits.set("light", text), std::runtime_error) << text;
    EXPECT_THROW(limits.set("missing", "1"), std::runtime_error);
    limits.set("light", "error,2");
    EXPECT_EQ(limits.threshold("light"), 2);
    EXPECT_EQ(limits.severity("light"), Severity::Error);
}

// The order in which frames come, and whether parts of the shot were judged before, do not matter.
TEST(Qc, AnySplitOfTheFramesGivesTheSame) {
    std::vector<FrameResult> all = shot_with(7, 7, brighter);
    ShotResult whole;
    whole.frames = all;
    conclude(whole);
    std::mt19937 random(1);
    for (const size_t size : {1U, 5U, 12U}) {
        std::shuffle(all.begin(), all.end(), random);
        ShotResult merged;
        for (size_t begin = 0; begin < all.size(); begin += size) {
            ShotResult part;
            const size_t end = std::min(begin + size, all.size());
            part.frames.assign(all.begin() + std::ptrdiff_t(begin),
                               all.begin() + std::ptrdiff_t(end));
            conclude(part);
            const ShotResult read = shot_from_json(to_json(part));
            merged.frames.insert(merged.frames.end(), read.frames.begin(), read.frames.end());
        }
        conclude(merged);
        EXPECT_EQ(to_json(merged), to_json(whole)) << size;
    }
    EXPECT_EQ(whole.verdict, Status::Warning);
    EXPECT_THAT(faults_text(whole), HasSubstr("qc: frame 7: warning flicker: "));
}

TEST(Qc, ARecordThatIsNoneIsRefused) {
    EXPECT_THROW(qc_from_json("{}"), std::runtime_error);
    std::string text = to_json(QcRecord{facts_of(1)});
    EXPECT_EQ(to_json(qc_from_json(text)), text);
    QcFacts places = facts_of(2);
    with_rectangle(places, 160, NAN, true);
    places.picture.borders.top[7] = 60;
    places.picture.alpha_mean = 0.7;
    places.layers[1].hash = "c0ffee";
    places.picture.pairs = {0.25, 0.5};
    places.picture.distinct = 77;
    places.picture.fine = 0.1;
    places.picture.at_largest_half = 12;
    places.picture.peaks[7] = QcPicture::kPeakBright;
    places.picture.peaks[8] = QcPicture::kPeakDark;
    places.picture.red[9] = -128;
    places.picture.thumbnail[10] = QcPicture::kDark;
    places.picture.fingerprints[11] = 65535;
    places.guides = {
        {"Depth.Z", 1, std::vector<int16_t>(QcPicture::kWide * QcPicture::kHigh, -32767)},
        {"Normal", 3, std::vector<int16_t>(3 * QcPicture::kWide * QcPicture::kHigh, 5)}};
    const std::string more = to_json(QcRecord{places});
    const QcRecord read = qc_from_json(more);
    EXPECT_EQ(to_json(read), more);
    EXPECT_TRUE(std::isnan(read.facts.picture.rectangles[0].color[2]));
    EXPECT_EQ(read.facts.picture.borders.top[7], 60);
    EXPECT_EQ(read.facts.layers[1].hash, "c0ffee");
    EXPECT_EQ(read.facts.picture.distinct, 77);
    EXPECT_EQ(read.facts.picture.fine, 0.1);
    EXPECT_EQ(read.facts.picture.at_largest_half, 12);
    EXPECT_EQ(read.facts.picture.peaks, places.picture.peaks);
    EXPECT_EQ(read.facts.picture.red, places.picture.red);
    EXPECT_EQ(read.facts.picture.thumbnail, places.picture.thumbnail);
    EXPECT_EQ(read.facts.picture.fingerprints, places.picture.fingerprints);
    EXPECT_EQ(read.facts.guides[0].cells, places.guides[0].cells);
    EXPECT_EQ(read.facts.guides[1].cells, places.guides[1].cells);
    text.replace(text.find("\"cells\":\"") + 20, 4, "AAAA");
    EXPECT_THROW(qc_from_json(text), std::runtime_error);
}

std::vector<FrameResult> measured(const std::filesystem::path& folder, const std::string& side) {
    std::vector<FrameResult> frames;
    for (int number = 1; number <= 8; ++number) {
        QcFacts facts;
        std::string why;
        const OIIO::ImageBuf image(
            (folder / (side + ".000" + std::to_string(number) + ".exr")).string());
        EXPECT_TRUE(ToneAlgo::qc_facts(facts, {&image}, why)) << why;
        frames.push_back(result_of(number, facts));
    }
    return frames;
}

void find_frame_five(const std::filesystem::path& folder) {
    EXPECT_THAT(codes_of(measured(folder, "ref")), IsEmpty());
    ShotResult shot;
    shot.frames = measured(folder, "test");
    conclude(shot);
    EXPECT_THAT(shot.worst, ElementsAre(4));
    EXPECT_EQ(shot.frames[4].faults[0].code, "blacklayer");
    EXPECT_EQ(shot.frames[4].faults[0].layer, "ViewLayer.Combined_neonC");
    EXPECT_THAT(shot.frames[4].message, HasSubstr("neonC is black in frame 5"));
}

TEST(Qc, TheLightGroupThatFailsInFrameFiveIsFound) {
    find_frame_five(std::filesystem::path(TESTIMAGES_DIR) / "anim");
}

TEST(Qc, AndInTheRenderedScene) {
    const char* shared = std::getenv("SHARED_DIR");
    const auto folder = std::filesystem::path(shared ? shared : "") / "scenes" / "anim";
    if (!shared || !std::filesystem::exists(folder))
        GTEST_SKIP() << "no folder " << folder;
    find_frame_five(folder);
}

} // namespace
} // namespace tonetool::sequence
