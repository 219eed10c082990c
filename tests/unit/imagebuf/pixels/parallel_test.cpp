// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/parallel.h"

#include <gtest/gtest.h>

#include <OpenImageIO/thread.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>

namespace tonetool {
namespace {

// A pool of more threads than are asked for, put back at the end.
struct LargePool {
    int before = OIIO::default_thread_pool()->size();
    LargePool() { OIIO::default_thread_pool()->resize(6); }
    ~LargePool() { OIIO::default_thread_pool()->resize(before); }
};

TEST(Parallel, RunsEveryTaskOnNoMoreThreadsThanAsked) {
    const LargePool pool;
    for (int asked : {1, 2, 3}) {
        std::atomic<int> running{0}, most{0}, done{0};
        make_parallel(asked)(40, [&](int64_t) {
            int seen = most;
            const int now = ++running;
            while (now > seen && !most.compare_exchange_weak(seen, now)) {
            }
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
            --running;
            ++done;
        });
        EXPECT_EQ(done, 40);
        EXPECT_LE(most, asked);
    }
}

TEST(Parallel, NothingToDoIsDone) {
    make_parallel(0)(0, [](int64_t) { ADD_FAILURE() << "there is no task"; });
}

TEST(Parallel, AnExceptionOfATaskReachesTheCaller) {
    std::atomic<int> done{0};
    const auto run = [&] {
        make_parallel(2)(10, [&](int64_t i) {
            ++done;
            if (i == 3 || i == 7)
                throw std::runtime_error(i == 3 ? "first" : "second");
        });
    };
    std::string what;
    try {
        run();
    } catch (const std::runtime_error& failure) {
        what = failure.what();
    }
    EXPECT_EQ(what, "first") << "whichever thread was first";
    EXPECT_EQ(done, 10) << "the others ran to the end";
}

} // namespace
} // namespace tonetool
