// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/value_scan.h"

#include <gmock/gmock.h>

namespace tonetool::metrics {
namespace {

using testing::ElementsAre;

TEST(ValueScan, PairsOfColumns) {
    std::vector<float> row;
    for (int x = 0; x < 8; ++x)
        for (int c = 0; c < 3; ++c)
            row.push_back(float(x / 2 + 1)); // enlarged from 4 columns
    const ValueScan scan = scan_values(row.data(), 8, true);
    EXPECT_THAT(scan.shares(), ElementsAre(1, 0));
    for (int i = 0; i < 12; ++i)
        row[size_t(i)] = 0; // half of it is black
    EXPECT_THAT(scan_values(row.data(), 8, true).shares(), ElementsAre(1, 0));
    EXPECT_THAT(ValueScan().shares(), ElementsAre(0, 0));
}

TEST(ValueScan, DifferentGreens) {
    const std::vector<float> row = {0, 0.5f, 0, 9, 0.25f, 0, 0, 0.5f, 0, 0, 1, 0, 0, 0.01f, 0};
    ValueScan scan = scan_values(row.data(), 5, true);
    EXPECT_EQ(scan.greens, 3);
    EXPECT_THAT(scan.values, ElementsAre(0.25f, 0.5f));
    const std::vector<float> more = {0, 0.75f, 0, 0, 0.5f, 0};
    scan.add(scan_values(more.data(), 2, true));
    EXPECT_THAT(scan.values, ElementsAre(0.25f, 0.5f, 0.75f));
    EXPECT_EQ(scan.greens, 5);
    scan.add(scan_values(more.data(), 2, false));
    EXPECT_EQ(scan.values.size(), 3U);
    EXPECT_EQ(scan.greens, 7);
}

TEST(ValueScan, MoreValuesAreNotCounted) {
    std::vector<float> row;
    for (int i = 0; i < 3000; ++i)
        row.push_back(0.5f + 1e-5f * float(i));
    ValueScan scan = scan_values(row.data(), 600, true);
    EXPECT_EQ(scan.values.size(), 600U);
    scan.add(scan_values(row.data() + 1800, 400, true));
    EXPECT_EQ(scan.values.size(), ValueScan::kMost);
    scan.add(scan_values(row.data(), 600, true));
    EXPECT_EQ(scan.values.size(), ValueScan::kMost);
}

} // namespace
} // namespace tonetool::metrics
