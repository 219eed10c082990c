// SPDX-License-Identifier: BSD-3-Clause
// The bound on memory: what it admits and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files.h"
#include "imagebuf/pixels/bands.h"
#include "imagebuf/pixels/paged_array.h"
#include "refusal.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using testing::AllOf;
using testing::HasSubstr;

constexpr uint64_t kMega = uint64_t(1) << 20;
constexpr OIIO::ROI kRegion(0, 1000, 100, 2100);

MemoryNeeds needs() {
    MemoryNeeds out;
    out.row = 26000;
    out.map_row = 4000;
    out.reading = 2 * kMega;
    out.measuring = 9 * kMega;
    out.thread = kMega;
    out.threads = 8;
    out.radius = 14;
    return out;
}

// What is held in the band that begins with a row.
uint64_t held(const Bands& bands, int begin, int end) {
    const MemoryNeeds n = needs();
    const int64_t rows =
        std::min(end + n.radius, kRegion.yend) - std::max(begin - n.radius, kRegion.ybegin);
    return kSetAside + n.reading + n.thread * uint64_t(bands.threads()) + n.row * uint64_t(rows) +
           n.map_row * uint64_t(end - kRegion.ybegin);
}

TEST(Bands, StayWithinTheBound) {
    for (uint64_t memory : {119, 120, 125, 140, 160}) {
        Bands bands;
        bands.plan(memory * kMega, needs(), kRegion, kRegion);
        EXPECT_FALSE(bands.one());
        int count = 0;
        for (int begin = kRegion.ybegin; begin < kRegion.yend; ++count) {
            const int end = bands.end_of(begin);
            ASSERT_GT(end, begin);
            EXPECT_LE(held(bands, begin, end), memory * kMega) << begin;
            begin = end;
        }
        EXPECT_GT(count, 1);
    }
    Bands bands;
    bands.plan(400 * kMega, needs(), kRegion, kRegion);
    EXPECT_TRUE(bands.one());
    EXPECT_EQ(bands.end_of(kRegion.ybegin), kRegion.yend);
    EXPECT_EQ(bands.threads(), 8);
}

TEST(Bands, ABoundThatIsTooSmallSaysWhatWouldDo) {
    Bands bands;
    EXPECT_THAT(refusal([&] { bands.plan(100 * kMega, needs(), kRegion, kRegion); }),
                AllOf(HasSubstr("memory is 100M"), HasSubstr("needs at least 118M"),
                      HasSubstr("8M for its maps")));
    EXPECT_NO_THROW(bands.plan(118 * kMega, needs(), kRegion, kRegion));
    EXPECT_THROW(bands.plan(117 * kMega, needs(), kRegion, kRegion), Refusal);
}

TEST(Memory, ThePublicFunctionsKnowTheBound) {
    const auto reference = noise(24, 200, 1), test = disturbed(reference, 0.3, 2);
    HdrFlipOptions options;
    options.num_exposures = 2;
    const auto map = ToneAlgo::hdr_flip(reference, test, options);
    options.memory = 10 * kMega;
    const auto refused = ToneAlgo::hdr_flip(reference, test, options);
    EXPECT_FALSE(refused.initialized());
    const std::string error = refused.geterror();
    EXPECT_THAT(error, AllOf(HasSubstr("hdr_flip: memory is 10M"), HasSubstr("at least 1")));
    const auto at = error.find("at least ") + 9;
    options.memory = std::stoull(error.substr(at)) * kMega;
    const auto admitted = ToneAlgo::hdr_flip(reference, test, options);
    ASSERT_FALSE(admitted.has_error()) << admitted.geterror();
    EXPECT_EQ(values(admitted), values(map));
    FlipOptions ldr;
    ldr.memory = 1;
    EXPECT_THAT(ToneAlgo::ldr_flip(reference, test, ldr).geterror(), HasSubstr("memory is 1M"));
}

TEST(Memory, ResizingTakesTheWholeTest) {
    HdrFlipOptions options;
    options.size = SizePolicy::Resize;
    options.memory = 120 * kMega;
    const auto refused = ToneAlgo::hdr_flip(noise(32, 32, 3), noise(900, 900, 4), options);
    EXPECT_THAT(refused.geterror(),
                AllOf(HasSubstr("resizing takes the whole test image"), HasSubstr("at least ")));
}

TEST(PagedArray, KeepsWhatItIsAskedTo) {
    PagedArray<float> array;
    array.resize(100000);
    for (size_t i = 0; i < array.size(); ++i)
        array[i] = float(i);
    array.keep(60000, 30000);
    array.resize(30000);
    EXPECT_EQ(array[0], 60000.0f);
    EXPECT_EQ(array[29999], 89999.0f);
    array.resize(200000);
    EXPECT_EQ(array[29999], 89999.0f);
    PagedArray<float> other = std::move(array);
    EXPECT_EQ(other.size(), 200000u);
    EXPECT_EQ(other[1], 60001.0f);
}

} // namespace
} // namespace tonetool
