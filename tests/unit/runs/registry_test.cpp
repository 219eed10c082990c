// SPDX-License-Identifier: BSD-3-Clause
#include "chain/language/registry.h"

#include <algorithm>
#include <gtest/gtest.h>
#include <set>

#include "chain/manual/help.h"
#include "runs/runs.h"
#include "sequence/results/measuring.h"

namespace tonetool::runs {
namespace {

using namespace chain;

class Registry : public testing::Test {
protected:
    void SetUp() override { know_all_commands(); }
};
using Help = Registry;

TEST_F(Registry, EveryRowIsComplete) {
    for (const Command& row : all_commands()) {
        ASSERT_FALSE(row.names.empty());
        const std::string& name = row.names.front();
        EXPECT_NE(row.run, nullptr) << name;
        EXPECT_FALSE(row.help.empty()) << name;
        EXPECT_EQ(row.help.find('\n'), std::string::npos) << name;
        EXPECT_FALSE(group_title(row.group).empty()) << name;
        EXPECT_GE(row.pops, 0) << name;
        EXPECT_GE(row.pushes, kAnyNumber) << name;
    }
}

TEST_F(Registry, NamesAreUnique) {
    std::set<std::string> seen;
    for (const Command& row : all_commands()) {
        for (const std::string& name : row.names) {
            EXPECT_TRUE(seen.insert(name).second) << name;
            EXPECT_NE(name.front(), '-') << name;
            EXPECT_EQ(find_command(name), &row) << name;
        }
    }
}

TEST_F(Registry, ModifiersAreUniqueAndExplained) {
    for (const Command& row : all_commands()) {
        std::set<std::string> seen;
        for (const Modifier& modifier : row.modifiers) {
            const std::string where = row.names.front() + ":" + modifier.key;
            EXPECT_TRUE(seen.insert(modifier.key).second) << where;
            EXPECT_FALSE(modifier.key.empty()) << where;
            EXPECT_FALSE(modifier.hint.empty()) << where;
            EXPECT_FALSE(modifier.help.empty()) << where;
        }
    }
}

bool has_limits(const Command& row) {
    return std::any_of(row.modifiers.begin(), row.modifiers.end(),
                       [](const Modifier& modifier) { return modifier.key == "fail"; });
}

// What a check must know of a command whose numbers it judges.
TEST_F(Registry, EveryCommandWithLimitsIsKnownToMeasure) {
    for (const Command& row : all_commands())
        if (has_limits(row))
            EXPECT_NE(sequence::measuring_command(row.names.front()), nullptr) << row.names.front();
    for (const sequence::MeasuringCommand& known : sequence::kMeasuringCommands) {
        const Command* row = find_command(known.name);
        ASSERT_NE(row, nullptr) << known.name;
        EXPECT_EQ(has_limits(*row), !known.compares_values()) << known.name;
    }
}

TEST_F(Registry, OnlyTheLastArgumentMayBeLeftOut) {
    for (const Command& row : all_commands())
        for (size_t i = 0; i + 1 < row.args.size(); ++i)
            EXPECT_NE(row.args[i].front(), '[') << row.names.front();
}

// What a recipe's size is told from without running it.
TEST_F(Registry, WhatKeepsHeadersKeepsTheStack) {
    size_t rows = 0;
    for (const Command& row : all_commands()) {
        const std::string& name = row.names.front();
        if (row.keeps_header) {
            ++rows;
            EXPECT_EQ(row.pops, row.pushes) << name;
            EXPECT_LE(row.pops, 1) << name;
            EXPECT_EQ(row.pops_of, nullptr) << name;
            EXPECT_FALSE(row.control || row.whole_line || row.outlives_chain()) << name;
        }
        if (row.makes_map) {
            EXPECT_EQ(row.pops, 2) << name;
            EXPECT_EQ(row.pushes, 1) << name;
        }
        EXPECT_FALSE(row.keeps_header && row.makes_map) << name;
    }
    EXPECT_GT(rows, 25U);
}

TEST_F(Registry, WholeLinesAreSetByWhatMakesNoImage) {
    for (const Command& row : all_commands()) {
        if (row.whole_line) {
            EXPECT_EQ(row.pops + row.pushes, 0) << row.names.front();
            // No call reads them: who has some checks them himself, in the plan of the line.
            const std::set<std::string> with = {"bad-frames", "figure", "json", "pictures",
                                                "report",     "suite",  "table"};
            EXPECT_EQ(!row.modifiers.empty(), with.count(row.names.front()) > 0)
                << row.names.front();
        }
        EXPECT_TRUE(row.whole_line || row.group != Group::Check) << row.names.front();
    }
}

TEST_F(Registry, FrequentModifiersAreModifiersOfTheCommand) {
    for (const Command& row : all_commands()) {
        const chain::SortedModifiers sorted = chain::sorted_modifiers(row);
        EXPECT_EQ(sorted.frequent.size(), row.frequent.size()) << row.names.front();
        EXPECT_EQ(sorted.frequent.size() + sorted.others.size() + sorted.of_curves.size(),
                  row.modifiers.size())
            << row.names.front();
    }
}

TEST_F(Registry, SuggestsNearNames) {
    EXPECT_NE(suggest_command("hdrflp").find("--hdrflip"), std::string::npos);
    EXPECT_EQ(suggest_command("qqqqqqqqqq").find("did you mean"), std::string::npos);
}

TEST_F(Help, ListsEveryCommandAndEveryModifier) {
    const std::string all = chain::help_text();
    for (const Command& row : all_commands()) {
        const std::string own = chain::help_text(row);
        EXPECT_NE(all.find(row.help), std::string::npos) << row.names.front();
        EXPECT_NE(own.find(row.help), std::string::npos) << row.names.front();
        for (const Modifier& modifier : row.modifiers) {
            EXPECT_NE(own.find(modifier.key + "=" + modifier.hint), std::string::npos)
                << row.names.front() << ":" << modifier.key;
        }
    }
}

} // namespace
} // namespace tonetool::runs
