// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/trust.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gmock/gmock.h>
#include <stdexcept>

#include "metrics/errors.h"
#include "sequence/results/json_text.h"
#include "sequence/results/results_json.h"

namespace tonetool::sequence {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

// Three frames of which the second is bad.
ShotResult shot_of(const std::vector<std::string>& check, const Measurement& good,
                   const Measurement& bad) {
    ShotResult result;
    result.check = {"ref.#.exr", "test.#.exr"};
    result.check.insert(result.check.end(), check.begin(), check.end());
    for (int number = 1; number < 4; ++number) {
        FrameResult frame;
        frame.frame = number;
        frame.status = Status::Passed;
        frame.measurements = {number == 2 ? bad : good};
        judge(frame);
        result.frames.push_back(frame);
    }
    conclude(result);
    return result;
}

Measurement of(const std::string& command, const Threshold& threshold, const Numbers& quantities) {
    Measurement one;
    one.command = command;
    one.thresholds = {threshold};
    one.quantities = quantities;
    one.pixels = 1000;
    return one;
}

ShotResult shot() {
    return shot_of({"--hdrflip:fail=0.01"},
                   of("hdrflip", {"mean", 0.005, false, 0.01, {}}, {{"mean", 0.005}, {"max", 1}}),
                   of("hdrflip", {"mean", 0.25, false, 0.01, {}}, {{"mean", 0.25}, {"max", 1}}));
}

using Change = std::function<void(ordered_json&)>;

// As if the words of the frames were those of their program: only the frames themselves contradict.
void count_again(ordered_json& json) {
    Status verdict = Status::Passed;
    for (auto& count : json["counts"].items())
        count.value() = 0;
    for (const auto& frame : json["frames"]) {
        const auto word = frame["status"].get<std::string>();
        json["counts"][word] = json["counts"].value(word, 0) + 1;
        verdict = std::max(verdict, status_of_name(word).value_or(Status::Passed));
    }
    json["verdict"] = status_name(verdict);
}

ShotResult read(const Change& change, const ShotResult& of_shot = shot()) {
    auto json = parse_json<ordered_json>(to_json(of_shot));
    change(json);
    if (json["frames"].is_array())
        count_again(json);
    return shot_from_json(json.dump());
}

std::string refusal(const Change& change, const ShotResult& of_shot = shot()) {
    try {
        return "accepted, " + status_name(read(change, of_shot).verdict);
    } catch (const std::runtime_error& problem) {
        return problem.what();
    }
}

ordered_json& frame(ordered_json& json, size_t index = 1) {
    return json["frames"][index];
}

ordered_json& measured(ordered_json& json, size_t index = 1) {
    return frame(json, index)["measurements"][0];
}

TEST(Trust, AResultThatIsAsItWasWrittenIsBelieved) {
    EXPECT_EQ(read([](auto&) {}).verdict, Status::Failed);
}

TEST(Trust, NumbersAreBelievedNotTheWord) {
    for (const char* word : {"passed", "measured", "warning"}) {
        const ShotResult result = read(
            [&](ordered_json& json) { frame(json)["status"] = measured(json)["status"] = word; });
        EXPECT_EQ(result.verdict, Status::Failed) << word;
        EXPECT_THAT(result.frames[1].message, HasSubstr("hdrflip: mean 0.25 > 0.01"));
        EXPECT_THAT(result.frames[1].warnings, ElementsAre(HasSubstr("but its numbers")));
    }
}

TEST(Trust, FaultsAreBelievedNotTheWord) {
    const ShotResult result = read([](ordered_json& json) {
        frame(json, 0)["faults"] = {{{"code", "odd"}, {"severity", "error"}, {"sentence", "Odd."}}};
    });
    EXPECT_EQ(result.frames[0].status, Status::Failed);
    EXPECT_EQ(result.frames[0].message, "Odd.");
}

TEST(Trust, NumbersThatAreMissingPassNothing) {
    EXPECT_THAT(refusal([](auto& json) { measured(json, 0).erase("thresholds"); }),
                HasSubstr("passed"));
    EXPECT_THAT(refusal([](auto& json) {
                    frame(json, 0)["status"] = "measured";
                    measured(json, 0).erase("thresholds");
                }),
                HasSubstr("hdrflip has no threshold"));
    const ShotResult none = read([](auto& json) { frame(json, 0).erase("measurements"); });
    EXPECT_EQ(none.frames[0].status, Status::Error);
    EXPECT_EQ(none.verdict, Status::Error);
}

TEST(Trust, AThresholdIsTheOneOfTheCheckAndOfItsQuantity) {
    EXPECT_THAT(refusal([](auto& json) {
                    frame(json)["status"] = "passed";
                    measured(json)["thresholds"][0]["value"] = 0.001;
                }),
                HasSubstr("held against mean 0.001, but mean is 0.25"));
    EXPECT_THAT(refusal([](auto& json) {
                    frame(json)["status"] = "passed";
                    measured(json)["thresholds"][0]["fail"] = 0.5;
                }),
                HasSubstr("held to fail=mean=0.5, but the check's limit is fail=mean=0.01"));
    EXPECT_THAT(refusal([](auto& json) {
                    frame(json)["status"] = "passed";
                    measured(json)["thresholds"][0]["fail"] = "inf";
                }),
                HasSubstr("held to fail=mean=inf"));
    EXPECT_THAT(refusal([](auto& json) { frame(json, 0)["status"] = "failed"; }),
                HasSubstr("called \"failed\", but its numbers and faults say \"passed\""));
}

TEST(Trust, ValuesThatDoNotFitAreNamedWithTheirPlace) {
    for (const char* value : {"1e99", "1099511627776", "1.5", "\"nan\"", "null", "[]"}) {
        EXPECT_THAT(refusal([&](auto& json) { frame(json)["frame"] = ordered_json::parse(value); }),
                    HasSubstr("frames/1: \"frame\" is "))
            << value;
    }
    EXPECT_THAT(refusal([](auto& json) { measured(json)["thresholds"][0]["value"] = nullptr; }),
                HasSubstr("frames/1: measurements/0: \"value\" is null"));
    EXPECT_THAT(refusal([](auto& json) { measured(json)["thresholds"][0]["fail"] = nullptr; }),
                HasSubstr("\"fail\" is null"));
    EXPECT_THAT(refusal([](auto& json) { measured(json)["quantities"]["mean"] = "few"; }),
                HasSubstr("\"mean\" is \"few\""));
    EXPECT_THAT(refusal([](auto& json) { measured(json)["pixels"] = 1e300; }),
                HasSubstr("\"pixels\" is 1e+300"));
    EXPECT_THAT(refusal([](auto& json) { frame(json)["status"] = "splendid"; }),
                HasSubstr("unknown status \"splendid\""));
    EXPECT_THAT(refusal([](auto& json) { json["version"] = 4294967297; }),
                HasSubstr("\"version\" is 4294967297"));
    EXPECT_THAT(refusal([](auto& json) { json["frames"] = 7; }), HasSubstr("not a list"));
}

// The frame that is bad, changed and called good.
std::string forged(const ShotResult& of_shot, const Change& change) {
    EXPECT_EQ(read([](auto&) {}, of_shot).verdict, of_shot.verdict) << "as it was written";
    return refusal(
        [&](ordered_json& json) {
            change(measured(json));
            frame(json)["status"] = measured(json)["status"] = "passed";
            frame(json).erase("message");
        },
        of_shot);
}

TEST(Trust, DirectionFollowsFromTheQuantity) {
    const auto flipped = [](ordered_json& one) {
        ordered_json& higher = one["thresholds"][0]["higher_is_better"];
        higher = !higher.get<bool>();
    };
    EXPECT_THAT(forged(shot(), flipped),
                HasSubstr("threshold of mean for which higher is better, but lower is"));
    const auto psnr = [](double mean) {
        const double value = -10 * std::log10(mean);
        return of("errormap", {"psnr", value, true, 30.0, {}},
                  {{"psnr", value}, {"mean", mean}, {"max", 1}});
    };
    const ShotResult decibels =
        shot_of({"--errormap:metric=psnr:fail=30"}, psnr(0.0001), psnr(0.1));
    EXPECT_EQ(decibels.verdict, Status::Failed);
    EXPECT_THAT(forged(decibels, flipped), HasSubstr("for which lower is better, but higher is"));
    EXPECT_THAT(
        forged(decibels,
               [](auto& one) { one["quantities"]["psnr"] = one["thresholds"][0]["value"] = 40; }),
        HasSubstr("has psnr 40, but its mean of 0.1 gives 10"));
    EXPECT_THAT(refusal([](auto&) {},
                        shot_of({"--errormap:metric=mse:fail=psnr=30"}, psnr(0.0001), psnr(0.1))),
                HasSubstr("metric is mse"));
}

TEST(Trust, TheMeasureOfEveryMetricIsHeldToTheMapsMean) {
    for (const metrics::ErrorMetric& metric : metrics::kErrorMetrics) {
        const bool up = metric.has(metrics::kDecibels);
        const auto measure = [&](double mean) {
            const double value = metric.measure(mean, 1);
            return of("errormap", {metric.name, value, up, metric.measure(0.01, 1), {}},
                      {{metric.name, value}, {"mean", mean}, {"max", 1}});
        };
        const ShotResult result = shot_of(
            {std::string("--errormap:metric=") + metric.name + ":fail=" + (up ? "20" : "0.01")},
            measure(0.0001), measure(0.1));
        EXPECT_EQ(result.frames[0].status, Status::Passed) << metric.name;
        EXPECT_EQ(result.frames[1].status, Status::Failed) << metric.name;
        EXPECT_THAT(forged(result,
                           [&](auto& one) {
                               one["quantities"][metric.name] = one["thresholds"][0]["value"] =
                                   metric.measure(0.001, 1);
                           }),
                    HasSubstr("but its mean of 0.1 gives"))
            << metric.name;
    }
}

TEST(Trust, TheScoresOfTmqiAreHeldToEachOther) {
    const auto score = [](double s, double n) {
        const double q = 0.8012 * std::pow(s, 0.3046) + 0.1988 * std::pow(n, 0.7088);
        return of("tmqi", {"Q", q, true, 0.8, {}}, {{"Q", q}, {"S", s}, {"N", n}});
    };
    const ShotResult scores = shot_of({"--tmqi:fail=0.8"}, score(0.9, 0.8), score(0.2, 0.1));
    EXPECT_THAT(
        forged(scores,
               [](auto& one) { one["quantities"]["Q"] = one["thresholds"][0]["value"] = 0.9; }),
        HasSubstr("has Q 0.9, but S 0.2 and N 0.1 give"));
}

Measurement difference(double count, double max, double fail = 0) {
    return of("diff", {"differing-pixels", count, false, fail, {}},
              {{"mean", max / 100}, {"rms", max / 10}, {"max", max}});
}

TEST(Trust, AComparisonOfValuesIsHeldToTheCheck) {
    const ShotResult plain = shot_of({"--diff"}, difference(0, 0), difference(150, 0.5));
    EXPECT_THAT(forged(plain, [](auto& one) { one["thresholds"][0]["value"] = 0; }),
                HasSubstr("max of 0.5, which is above a limit of the check"));
    EXPECT_THAT(forged(plain, [](auto& one) { one["thresholds"][0]["fail"] = 1e9; }),
                HasSubstr("held to differing-pixels fail=1000000000, but the check's limit is 0"));
    EXPECT_THAT(refusal(
                    [](auto& json) {
                        frame(json)["status"] = "measured";
                        measured(json).erase("thresholds");
                    },
                    plain),
                HasSubstr("diff has no threshold"));
    EXPECT_THAT(
        forged(plain,
               [](auto& one) { one["thresholds"][0]["value"] = one["quantities"]["max"] = 0; }),
        HasSubstr("mean of 0.005, which contradicts its max of 0"));
    EXPECT_THAT(forged(plain,
                       [](auto& one) {
                           one["thresholds"][0] = {{"quantity", "max"},
                                                   {"value", 0.5},
                                                   {"higher_is_better", false},
                                                   {"fail", 1}};
                       }),
                HasSubstr("held to max fail=1"));
    const std::vector<std::string> lenient{"--fail",        "0.1", "--failpercent", "10",
                                           "--warnpercent", "50",  "--diff"};
    const ShotResult some = shot_of(lenient, difference(20, 0.2, double(10.0f) / 100 * 1000),
                                    difference(150, 0.5, 100));
    EXPECT_EQ(some.verdict, Status::Failed);
    EXPECT_THAT(forged(some, [](auto& one) { one["thresholds"][0]["value"] = 0; }),
                HasSubstr("differing-pixels 0, which contradicts its max of 0.5"));
}

TEST(Trust, AMeasurementIsOfACommandOfTheCheck) {
    EXPECT_THAT(forged(shot(),
                       [](auto& one) {
                           one["command"] = "diff";
                           one["thresholds"] = {{{"quantity", "differing-pixels"},
                                                 {"value", 0},
                                                 {"higher_is_better", false},
                                                 {"fail", 0}}};
                       }),
                HasSubstr("frame 2 was measured by diff, which the check does not have"));
    ShotResult two = shot_of({"--hdrflip:fail=0.5", "--ldrflip:fail=0.1"},
                             of("hdrflip", {"mean", 0, false, 0.5, {}}, {{"mean", 0}}),
                             of("hdrflip", {"mean", 0, false, 0.5, {}}, {{"mean", 0}}));
    EXPECT_THAT(refusal([](auto&) {}, two),
                HasSubstr("frame 1 has 0 measurements by ldrflip, but the check has 1"));
}

TEST(Trust, EachLimitIsOfItsQuantityAndKind) {
    const auto warned = [](double value) {
        Measurement one = of("hdrflip", {"p99", value, false, 0.9, 0.1}, {});
        one.thresholds.push_back({"mean", value / 2, false, {}, 0.1});
        one.quantities = {{"mean", value / 2}, {"p99", value}, {"min", 0}, {"max", value}};
        return one;
    };
    const ShotResult both =
        shot_of({"--hdrflip:quantity=p99:fail=0.9:warn=p99=0.1,mean=0.1"}, warned(0), warned(0.95));
    EXPECT_THAT(forged(both, [](auto& one) { one["thresholds"][0]["warn"] = 1; }),
                HasSubstr("warn=mean=0.1,p99=1, but the check's limit is warn=mean=0.1,p99=0.1"));
    EXPECT_THAT(forged(both, [](auto& one) { one["thresholds"].erase(1); }),
                HasSubstr("held to warn=p99=0.1"));
    EXPECT_THAT(forged(shot(),
                       [](auto& one) {
                           one["thresholds"][0]["quantity"] = "min";
                           one["thresholds"][0]["value"] = one["quantities"]["min"] = 0;
                       }),
                HasSubstr("held to fail=min=0.01, but the check's limit is fail=mean=0.01"));
}

// 900 pixels of 0 and 100 of 0.955.
Measurement half_bad() {
    Measurement one = of("hdrflip", {"mean", 0.0955, false, 0.01, {}},
                         {{"mean", 0.0955},
                          {"weighted-median", 0.955},
                          {"p50", 0},
                          {"p95", 0.955},
                          {"p99", 0.955},
                          {"min", 0},
                          {"max", 0.955},
                          {"above0.5", 0.1}});
    one.histogram.assign(100, 0);
    one.histogram[0] = 900;
    one.histogram[95] = 100;
    return one;
}

TEST(Trust, NumbersOfAMapAreHeldToEachOther) {
    const ShotResult maps = shot_of({"--hdrflip:fail=0.01"}, half_bad(), half_bad());
    const auto with = [&](const std::string& name, const ordered_json& value) {
        return forged(maps, [&](auto& one) { one["quantities"][name] = value; });
    };
    const auto mean = [&](const Change& also) {
        return forged(maps, [&](auto& one) {
            one["quantities"]["mean"] = one["thresholds"][0]["value"] = 0;
            also(one);
        });
    };
    EXPECT_THAT(mean([](auto&) {}), HasSubstr("mean of 0, but its histogram gives"));
    EXPECT_THAT(mean([](auto& one) { one.erase("histogram"); }),
                HasSubstr("mean of 0, but its percentiles give"));
    EXPECT_THAT(mean([](auto& one) { one["quantities"]["min"] = 0.1; }),
                HasSubstr("has min 0.1 above p50 0"));
    EXPECT_THAT(with("p99", 0.5), HasSubstr("has p95 0.955 above p99 0.5"));
    EXPECT_THAT(with("p50", 0.5), HasSubstr("has p50 0.5, which its histogram contradicts"));
    EXPECT_THAT(with("max", 0.999), HasSubstr("has max 0.999, which its histogram contradicts"));
    EXPECT_THAT(with("max", "inf"), HasSubstr("max of inf, but a mean of 0.0955"));
    EXPECT_THAT(with("weighted-median", 0.99), HasSubstr("weighted-median of 0.99"));
    EXPECT_THAT(with("above0.5", 0.05), HasSubstr("above0.5 of 0.05, but its histogram gives"));
    EXPECT_THAT(forged(maps, [](auto& one) { one["histogram"][95] = 10; }),
                HasSubstr("histogram of 910 pixels, but compared 1000"));
    EXPECT_THAT(forged(maps, [](auto& one) { one["histogram"].erase(99); }),
                HasSubstr("histogram of 99 buckets (valid: 100)"));
}

TEST(Trust, WhatIsSaidOfAllFramesIsOfThoseThatAreThere) {
    const auto said = [](const Change& change) {
        auto json = parse_json<ordered_json>(to_json(shot()));
        change(json);
        try {
            return "accepted, " + status_name(shot_from_json(json.dump()).verdict);
        } catch (const std::runtime_error& problem) {
            return std::string(problem.what());
        }
    };
    EXPECT_EQ(said([](auto&) {}), "accepted, failed");
    EXPECT_THAT(said([](auto& json) { json["frames"].erase(1); }),
                HasSubstr("\"counts/failed\" is 1, but that of its frames is 0"));
    EXPECT_THAT(said([](auto& json) { json["verdict"] = "passed"; }),
                HasSubstr("\"verdict\" is \"passed\", but that of its frames is \"failed\""));
    EXPECT_THAT(said([](auto& json) { json["sentence"] = "3 frames: 3 passed"; }),
                HasSubstr("\"sentence\" is \"3 frames: 3 passed\""));
    EXPECT_THAT(said([](auto& json) { json["worst"][0]["frame"] = 1; }), HasSubstr("\"worst\" is"));
    EXPECT_THAT(said([](auto& json) {
                    json["frames"].erase(1);
                    json["counts"]["failed"] = 0;
                    json["verdict"] = "passed";
                }),
                HasSubstr("\"sentence\" is"));
}

// What no number is does not hold.
TEST(Trust, ANaNFails) {
    const ShotResult result = read([](ordered_json& json) {
        measured(json, 0)["thresholds"][0]["value"] = measured(json, 0)["quantities"]["mean"] =
            "nan";
    });
    EXPECT_EQ(result.frames[0].status, Status::Failed);
}

TEST(Trust, DepthIsBounded) {
    const std::string deep = std::string(100000, '[') + std::string(100000, ']');
    const auto refused = [](const std::string& text) {
        try {
            shot_from_json(text);
        } catch (const std::runtime_error& problem) {
            return std::string(problem.what());
        }
        return std::string("accepted");
    };
    EXPECT_THAT(refused(deep), HasSubstr("nested deeper than 100"));
    std::string objects;
    for (int i = 0; i < 10000; ++i)
        objects += "{\"a\":";
    EXPECT_THAT(refused(objects), HasSubstr("nested deeper than 100"));
    EXPECT_THAT(refused("\"" + std::string(500, '[') + "\\\"[[[[\""), HasSubstr("tonetool-check"));
    EXPECT_THROW(frame_from_json(deep), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
