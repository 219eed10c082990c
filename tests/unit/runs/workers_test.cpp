// SPDX-License-Identifier: BSD-3-Clause
#include "runs/workers.h"

#include <csignal>
#include <cstdlib>
#include <gmock/gmock.h>
#include <map>
#include <stdexcept>
#include <unistd.h>

namespace tonetool::runs {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

std::map<size_t, TaskResult> run_tasks(size_t count, int processes, const Workers::Task& task) {
    std::map<size_t, TaskResult> results;
    size_t next = 0;
    Workers(processes, task)
        .run([&] { return next == count ? std::nullopt : std::optional<size_t>(next++); },
             [&](size_t index, const TaskResult& result) {
                 EXPECT_TRUE(results.emplace(index, result).second) << index;
             });
    return results;
}

class WorkersTest : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Processes, WorkersTest, testing::Values(1, 2, 5));

TEST_P(WorkersTest, EveryTaskReplies) {
    const auto results =
        run_tasks(20, GetParam(), [](size_t index) { return "task " + std::to_string(index); });
    ASSERT_EQ(results.size(), 20u);
    for (const auto& [index, result] : results) {
        EXPECT_EQ(result.reply, "task " + std::to_string(index));
        EXPECT_THAT(result.crash, IsEmpty());
    }
}

TEST_P(WorkersTest, TasksRunInOtherProcesses) {
    const auto results = run_tasks(4, GetParam(), [](size_t) { return std::to_string(getpid()); });
    for (const auto& item : results)
        EXPECT_NE(item.second.reply, std::to_string(getpid()));
}

TEST_P(WorkersTest, ATaskThatEndsItsProcessIsLostAlone) {
    const auto results = run_tasks(12, GetParam(), [](size_t index) {
        std::signal(SIGFPE, SIG_DFL);
        std::signal(SIGSEGV, SIG_DFL);
        std::signal(SIGABRT, SIG_DFL);
        switch (index) {
        case 0:
            std::raise(SIGFPE);
            break;
        case 4:
            std::raise(SIGSEGV);
            break;
        case 5:
            std::raise(SIGABRT);
            break;
        case 7:
            std::raise(SIGKILL);
            break;
        case 11:
            _exit(3);
        default:
            break;
        }
        return std::string("done");
    });
    ASSERT_EQ(results.size(), 12u);
    const std::map<size_t, std::string> lost{
        {0, "SIGFPE"}, {4, "SIGSEGV"}, {5, "SIGABRT"}, {7, "SIGKILL"}, {11, "exit status 3"}};
    for (const auto& [index, result] : results) {
        const auto end = lost.find(index);
        EXPECT_EQ(result.reply, end == lost.end() ? "done" : "") << index;
        EXPECT_THAT(result.crash, end == lost.end() ? testing::Matcher<std::string>(IsEmpty())
                                                    : HasSubstr(end->second))
            << index;
    }
}

TEST_P(WorkersTest, AnExceptionEndsItsProcessAndNoOther) {
    const auto results = run_tasks(9, GetParam(), [](size_t index) -> std::string {
        if (index == 4)
            throw std::runtime_error("of task 4");
        return "done";
    });
    ASSERT_EQ(results.size(), 9u);
    for (const auto& [index, result] : results)
        EXPECT_EQ(result.crash, index == 4 ? "exit status 1" : "") << index;
}

TEST_P(WorkersTest, AllTasksMayBeLost) {
    const auto results = run_tasks(6, GetParam(), [](size_t) -> std::string { _exit(1); });
    EXPECT_EQ(results.size(), 6u);
}

TEST_P(WorkersTest, LongAndEmptyRepliesArriveWhole) {
    const auto results = run_tasks(4, GetParam(), [](size_t index) {
        return std::string(index * 3000001, char('a' + index));
    });
    for (const auto& [index, result] : results)
        EXPECT_EQ(result.reply, std::string(index * 3000001, char('a' + index))) << index;
}

TEST(Workers, NothingToDoStartsNoProcess) {
    EXPECT_THAT(run_tasks(0, 3, [](size_t) { return std::string(); }), IsEmpty());
}

TEST(Workers, WhatComesBeforeTheFirstTaskIsDoneInEachProcess) {
    std::string begun = "no", reply;
    size_t next = 0;
    Workers(
        1, [&](size_t) { return begun; }, [&] { begun = "yes"; })
        .run([&] { return next == 1 ? std::nullopt : std::optional<size_t>(next++); },
             [&](size_t, const TaskResult& result) { reply = result.reply; });
    EXPECT_EQ(reply, "yes");
    EXPECT_EQ(begun, "no");
}

} // namespace
} // namespace tonetool::runs
