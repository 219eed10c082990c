// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/measuring.h"

#include <gtest/gtest.h>

#include "metrics/errors.h"
#include "sequence/results/diff_limits.h"

namespace tonetool::sequence {
namespace {

TEST(Measuring, TheDirectionIsThatOfTheMetricsRow) {
    for (const metrics::ErrorMetric& metric : metrics::kErrorMetrics) {
        EXPECT_EQ(higher_is_better("errormap", metric.name), metric.has(metrics::kDecibels))
            << metric.name;
        EXPECT_FALSE(higher_is_better("hdrflip", metric.name)) << metric.name;
    }
    for (const char* quantity : {"mean", "p99", "above0.1", "another"})
        EXPECT_FALSE(higher_is_better("errormap", quantity)) << quantity;
    for (const char* quantity : {"Q", "S", "N"})
        EXPECT_TRUE(higher_is_better("tmqi", quantity)) << quantity;
    EXPECT_FALSE(higher_is_better("another", "psnr"));
}

TEST(Measuring, ALimitWithoutANameIsOfTheCommandsOwnQuantity) {
    const auto first = [](const char* name) {
        return measuring_command(name)->first_quantity("relmse");
    };
    EXPECT_EQ(first("hdrflip"), "mean");
    EXPECT_EQ(first("flipdiff"), "max");
    EXPECT_EQ(first("errormap"), "relmse");
    EXPECT_EQ(first("tmqi"), "Q");
    EXPECT_EQ(measuring_command("over"), nullptr);
}

TEST(Measuring, EachOptionOfDiffSetsALimitOfItsOwn) {
    for (const DiffOption& option : kDiffOptions) {
        DiffLimits limits;
        (limits.*option.limit).*option.number = 7;
        for (const DiffOption& other : kDiffOptions) {
            const float found = (limits.*other.limit).*other.number;
            EXPECT_EQ(found == 7, &option == &other) << option.name << " " << other.name;
        }
    }
    DiffLimits limits;
    limits.fail.percent = 10;
    EXPECT_DOUBLE_EQ(limits.fail.allowed(1000), 100);
}

} // namespace
} // namespace tonetool::sequence
