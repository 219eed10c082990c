// SPDX-License-Identifier: BSD-3-Clause
#include "flip/evaluate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "flip/filters.h"
#include "hdr_image.h"
#include "kernels/flip_reference.h"
#include "schedules.h"
#include "tonemap/rational.h"

namespace tonetool::flip {
namespace {

using kernels::backwards;
using kernels::Content;
using kernels::HdrImage;
using kernels::in_order;
using kernels::on_threads;
using kernels::ParallelFor;
using kernels::Window;

// Two tiles in both directions, of 351 x 71 pixels: none of them whole vectors.
constexpr int kWidth = 701, kHeight = 141, kSeamX = 351, kSeamY = 71;

const std::vector<double> kStops = {-3.5, -1.0, 0.5, 2.0};

Evaluation evaluation(double ppd = 67.02, std::vector<double> stops = kStops) {
    return {lane_taps(make_taps(ppd)), *tonemap::rational_curve("aces"), std::move(stops)};
}

// Planes of one test, the size of the whole image; stale so that missing pixels show.
struct Planes {
    std::vector<float> error, index;
    std::vector<std::vector<float>> each;

    explicit Planes(const HdrImage& image, size_t exposures = 0)
        : error(image.size(), -1.0f),
          index(image.size(), -1.0f),
          each(exposures, std::vector<float>(image.size(), -1.0f)) {}

    Output at(int x, int y, int width) {
        const size_t from = size_t(y) * size_t(width) + size_t(x);
        Output out;
        out.error = error.data() + from;
        out.index = index.data() + from;
        for (auto& plane : each)
            out.per_exposure.push_back(plane.data() + from);
        out.stride = width;
        return out;
    }
};

Planes whole(const HdrImage& reference, const HdrImage& test, const Evaluation& what,
             const ParallelFor& parallel, size_t keep = 0) {
    Planes planes(reference, keep);
    evaluate(what, reference.view(), {test.view()}, {0, 0, reference.width, reference.height},
             {planes.at(0, 0, reference.width)}, parallel);
    return planes;
}

void expect_same(const Planes& a, const Planes& b) {
    EXPECT_EQ(a.error, b.error);
    EXPECT_EQ(a.index, b.index);
    EXPECT_EQ(a.each, b.each);
}

class Evaluate : public testing::Test {
protected:
    const HdrImage m_reference = make_image(Content::Noise, kWidth, kHeight, 1);
    const HdrImage m_test = disturbed(m_reference, 0.3, 2);
    const Planes m_whole = whole(m_reference, m_test, evaluation(), in_order(), kStops.size());
};

TEST_F(Evaluate, MatchesTheReferenceImplementationAcrossTiles) {
    const auto expected = hdr_flip_reference(m_reference.view(), m_test.view(), make_taps(67.02),
                                             *tonemap::rational_curve("aces"), kStops, nullptr);
    for (size_t i = 0; i < expected.size(); ++i) // float noise, steep near 0: see flip_tile_test
        ASSERT_NEAR(m_whole.error[i], expected[i], expected[i] >= 0.01 ? 1e-5 : 1e-4) << i;
}

// A curve that comes from outside, by rows, is the curve that the kernels have: its rows are as
// long as the kernels' are, and each pixel's value depends on nothing else.
TEST_F(Evaluate, RowsInsteadOfTheCurveDoNotChangeABit) {
    Evaluation by_rows = evaluation();
    by_rows.rows = [curve = by_rows.curve](const float* const in[3], float* const out[3],
                                           ptrdiff_t count, float scale) {
        kernels::tone_map_pixels(in, out, count, curve, scale);
    };
    by_rows.curve = *tonemap::rational_curve("hable"); // is not looked at
    expect_same(m_whole, whole(m_reference, m_test, by_rows, on_threads(3), kStops.size()));
}

TEST_F(Evaluate, ScheduleDoesNotChangeABit) {
    for (const ParallelFor& parallel : {backwards(), on_threads(2), on_threads(7)})
        expect_same(m_whole, whole(m_reference, m_test, evaluation(), parallel, kStops.size()));
}

TEST_F(Evaluate, WindowsDoNotChangeABit) {
    const std::pair<int, int> sizes[] = {
        {kWidth, 9}, {67, kHeight}, {150, 37}, {497, 96}, {700, 140}};
    for (const auto& [w, h] : sizes) {
        SCOPED_TRACE(testing::Message() << w << "x" << h);
        Planes tiled(m_reference, kStops.size());
        for (int y = 0; y < kHeight; y += h)
            for (int x = 0; x < kWidth; x += w)
                evaluate(evaluation(), m_reference.view(), {m_test.view()},
                         {x, y, std::min(w, kWidth - x), std::min(h, kHeight - y)},
                         {tiled.at(x, y, kWidth)}, in_order());
        expect_same(m_whole, tiled);
    }
}

// Rows from `first` to `end`, as a reader of bands would hold them.
HdrImage rows_of(const HdrImage& image, int first, int end) {
    HdrImage band(image.width, end - first);
    for (int c = 0; c < 3; ++c)
        std::copy_n(image.plane[c].begin() + first * image.width, band.size(),
                    band.plane[c].begin());
    return band;
}

kernels::ConstRgb view_of_rows(const HdrImage& band, const HdrImage& whole_image, int first) {
    kernels::ConstRgb view = band.view();
    view.height = whole_image.height;
    view.first_row = first;
    return view;
}

TEST_F(Evaluate, BandsOfRowsDoNotChangeABit) {
    const int far = filter_radius(evaluation().taps);
    for (int rows : {1, 30, 64}) {
        SCOPED_TRACE(rows);
        Planes banded(m_reference, kStops.size());
        for (int y = 0; y < kHeight; y += rows) {
            const int count = std::min(rows, kHeight - y);
            const int first = std::max(0, y - far), end = std::min(kHeight, y + count + far);
            const HdrImage r = rows_of(m_reference, first, end), t = rows_of(m_test, first, end);
            evaluate(evaluation(), view_of_rows(r, m_reference, first),
                     {view_of_rows(t, m_test, first)}, {0, y, kWidth, count},
                     {banded.at(0, y, kWidth)}, in_order());
        }
        expect_same(m_whole, banded);
    }
}

TEST_F(Evaluate, AWindowLeavesTheRestAlone) {
    Planes planes(m_reference, kStops.size());
    evaluate(evaluation(), m_reference.view(), {m_test.view()}, {20, 30, 11, 7},
             {planes.at(20, 30, kWidth)}, in_order());
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x) {
            const size_t i = size_t(y * kWidth + x);
            const bool inside = x >= 20 && x < 31 && y >= 30 && y < 37;
            ASSERT_EQ(planes.error[i], inside ? m_whole.error[i] : -1.0f) << x << "," << y;
        }
}

TEST_F(Evaluate, SeveralTestsGiveTheBitsOfSingleOnes) {
    const HdrImage tests[] = {m_test, m_reference, disturbed(m_reference, 1e-3, 3),
                              make_image(Content::Gradient, kWidth, kHeight, 4)};
    std::vector<Planes> planes(std::size(tests), Planes(m_reference, kStops.size()));
    std::vector<kernels::ConstRgb> views;
    std::vector<Output> outputs;
    for (size_t t = 0; t < std::size(tests); ++t) {
        views.push_back(tests[t].view());
        outputs.push_back(planes[t].at(0, 0, kWidth));
    }
    evaluate(evaluation(), m_reference.view(), views, {0, 0, kWidth, kHeight}, outputs,
             backwards());
    for (size_t t = 0; t < std::size(tests); ++t) {
        SCOPED_TRACE(t);
        expect_same(planes[t],
                    whole(m_reference, tests[t], evaluation(), in_order(), kStops.size()));
    }
}

TEST_F(Evaluate, ErrorIsTheFirstMaximumOfTheExposures) {
    for (size_t i = 0; i < m_whole.error.size(); ++i) {
        size_t first = 0;
        for (size_t n = 1; n < kStops.size(); ++n)
            if (m_whole.each[n][i] > m_whole.each[first][i])
                first = n;
        ASSERT_EQ(m_whole.error[i], m_whole.each[first][i]) << i;
        ASSERT_EQ(m_whole.index[i], float(first)) << i;
    }
    const auto largest = *std::max_element(m_whole.index.begin(), m_whole.index.end());
    EXPECT_GT(largest, 0.0f) << "the test would pass with one exposure alone";
}

TEST_F(Evaluate, EachExposureIsThatExposureAlone) {
    for (size_t n = 0; n < kStops.size(); ++n)
        EXPECT_EQ(whole(m_reference, m_test, evaluation(67.02, {kStops[n]}), in_order()).error,
                  m_whole.each[n]);
}

TEST_F(Evaluate, IdenticalImagesAreZeroEverywhere) {
    const Planes same = whole(m_reference, m_reference, evaluation(), in_order(), kStops.size());
    const std::vector<float> zero(m_reference.size(), 0.0f);
    EXPECT_EQ(same.error, zero);
    EXPECT_EQ(same.index, zero);
    for (const auto& plane : same.each)
        EXPECT_EQ(plane, zero);
}

TEST_F(Evaluate, OnePixelIsFeltWithinTheReachOnly) {
    HdrImage changed = m_reference;
    const int cx = kSeamX, cy = kSeamY - 1; // beside two seams of tiles
    changed.plane[1][size_t(cy * kWidth + cx)] += 4.0f;
    const auto error = whole(m_reference, changed, evaluation(), in_order()).error;
    const int far = filter_radius(evaluation().taps);
    EXPECT_GT(error[size_t(cy * kWidth + cx)], 0.01f);
    for (int y = 0; y < kHeight; ++y)
        for (int x = 0; x < kWidth; ++x)
            if (std::max(std::abs(x - cx), std::abs(y - cy)) > far)
                ASSERT_EQ(error[size_t(y * kWidth + x)], 0.0f) << x << "," << y;
}

TEST_F(Evaluate, IndexAndExposuresAreOptional) {
    std::vector<float> error(m_reference.size());
    Output only;
    only.error = error.data();
    only.stride = kWidth;
    evaluate(evaluation(), m_reference.view(), {m_test.view()}, {0, 0, kWidth, kHeight}, {only},
             in_order());
    EXPECT_EQ(error, m_whole.error);
}

} // namespace
} // namespace tonetool::flip
