#include "sequence/trust.h"

#include <functional>
#include <gmock/gmock.h>
#include <stdexcept>

#include "sequence/json_text.h"
#include "sequence/results_json.h"

namespace tonetool::sequence {
namespace {

using nlohmann::ordered_json;
using testing::ElementsAre;
using testing::HasSubstr;

ShotResult shot() {
    ShotResult result;
    result.check = {"ref.#.exr", "test.#.exr", "--hdrflip:fail=0.01"};
    for (int number = 1; number < 4; ++number) {
        const double value = number == 2 ? 0.25 : 0.005;
        FrameResult frame;
        frame.frame = number;
        frame.status = Status::Passed;
        Measurement one;
        one.command = "hdrflip";
        one.thresholds = {Threshold{"mean", value, false, 0.01, {}}};
        one.quantities = {{"mean", value}, {"max", 1}};
        frame.measurements = {one};
        judge(frame);
        result.frames.push_back(frame);
    }
    conclude(result);
    return result;
}

using Change = std::function<void(ordered_json&)>;

ShotResult read(const Change& change) {
    auto json = parse_json<ordered_json>(to_json(shot()));
    change(json);
    return shot_from_json(json.dump());
}

std::string refusal(const Change& change) {
    try {
        return "accepted, " + status_name(read(change).verdict);
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

TEST(Trust, A_result_that_is_as_it_was_written_is_believed) {
    EXPECT_EQ(read([](auto&) {}).verdict, Status::Failed);
}

TEST(Trust, Numbers_are_believed_not_the_word) {
    for (const char* word : {"passed", "measured", "warning"}) {
        const ShotResult result = read([&](ordered_json& json) {
            json["verdict"] = "passed";
            frame(json)["status"] = measured(json)["status"] = word;
        });
        EXPECT_EQ(result.verdict, Status::Failed) << word;
        EXPECT_THAT(result.frames[1].message, HasSubstr("hdrflip: mean 0.25 > 0.01"));
        EXPECT_THAT(result.frames[1].warnings, ElementsAre(HasSubstr("but its numbers")));
    }
}

TEST(Trust, Faults_are_believed_not_the_word) {
    const ShotResult result = read([](ordered_json& json) {
        frame(json, 0)["faults"] = {{{"code", "odd"}, {"severity", "error"}, {"sentence", "Odd."}}};
    });
    EXPECT_EQ(result.frames[0].status, Status::Failed);
    EXPECT_EQ(result.frames[0].message, "Odd.");
}

TEST(Trust, Numbers_that_are_missing_pass_nothing) {
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

TEST(Trust, A_threshold_is_the_one_of_the_check_and_of_its_quantity) {
    EXPECT_THAT(refusal([](auto& json) {
                    frame(json)["status"] = "passed";
                    measured(json)["thresholds"][0]["value"] = 0.001;
                }),
                HasSubstr("held against mean 0.001, but mean is 0.25"));
    EXPECT_THAT(refusal([](auto& json) {
                    frame(json)["status"] = "passed";
                    measured(json)["thresholds"][0]["fail"] = 0.5;
                }),
                HasSubstr("held to fail=0.5, but the check's limit is fail=0.01"));
    EXPECT_THAT(refusal([](auto& json) {
                    frame(json)["status"] = "passed";
                    measured(json)["thresholds"][0]["fail"] = "inf";
                }),
                HasSubstr("held to fail=inf"));
    EXPECT_THAT(refusal([](auto& json) { frame(json, 0)["status"] = "failed"; }),
                HasSubstr("called \"failed\", but its numbers and faults say \"passed\""));
}

TEST(Trust, Values_that_do_not_fit_are_named_with_their_place) {
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

// What no number is does not hold.
TEST(Trust, A_NaN_fails) {
    const ShotResult result = read([](ordered_json& json) {
        measured(json, 0)["thresholds"][0]["value"] = measured(json, 0)["quantities"]["mean"] = "nan";
    });
    EXPECT_EQ(result.frames[0].status, Status::Failed);
}

TEST(Trust, Depth_is_bounded) {
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
    for (int i = 0; i < 10000; ++i) {
        objects += "{\"a\":";
    }
    EXPECT_THAT(refused(objects), HasSubstr("nested deeper than 100"));
    EXPECT_THAT(refused("\"" + std::string(500, '[') + "\\\"[[[[\""), HasSubstr("tonetool-check"));
    EXPECT_THROW(frame_from_json(deep), std::runtime_error);
}

} // namespace
} // namespace tonetool::sequence
