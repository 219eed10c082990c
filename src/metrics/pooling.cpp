// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/pooling.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <vector>

#include "metrics/blocks.h"
#include "metrics/order_statistics.h"

namespace tonetool::metrics {
namespace {

using Histogram = decltype(FlipPool::histogram);

struct Row {
    double sum = 0;
    float min = 0, max = 0;
    int min_x = 0, max_x = 0; // the first ones
    int pixels = 0;
};

// Four sums by turns, so that an addition need not wait for the one before.
double sum_of(const float* row, int width) {
    double sums[4] = {};
    int x = 0;
    for (; x + 3 < width; x += 4)
        for (int i = 0; i < 4; ++i)
            sums[i] += double(row[x + i]);
    for (; x < width; ++x)
        sums[0] += double(row[x]);
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

Row scan_row(const float* row, int width) {
    Row out{sum_of(row, width), row[0], row[0], 0, 0, width};
    for (int x = 1; x < width; ++x) {
        if (row[x] < out.min) {
            out.min = row[x];
            out.min_x = x;
        }
        if (row[x] > out.max) {
            out.max = row[x];
            out.max_x = x;
        }
    }
    return out;
}

// What counts of a row, closed up as if nothing else were there.
struct Closed {
    std::vector<float> values;
    std::vector<int> places;

    void take(const float* row, int width) {
        values.clear();
        places.clear();
        for (int x = 0; x < width; ++x)
            if (!std::isnan(row[x])) {
                values.push_back(row[x]);
                places.push_back(x);
            }
    }
    Row scanned() const {
        if (values.empty())
            return {};
        Row out = scan_row(values.data(), int(values.size()));
        out.min_x = places[size_t(out.min_x)];
        out.max_x = places[size_t(out.max_x)];
        return out;
    }
};

// Two histograms by turns: neighbours are often equal. Buckets are found some pixels at a time, in
// a loop that a compiler turns into vectors.
struct Histograms {
    Histogram even{}, odd{};

    void add(const float* row, int width) {
        constexpr int chunk = 64;
        for (int x = 0; x < width; x += chunk)
            add_few(row + x, std::min(chunk, width - x));
    }

private:
    void add_few(const float* values, int count) {
        constexpr auto buckets = double(std::tuple_size_v<Histogram>);
        int32_t at[64];
        for (int i = 0; i < count; ++i) {
            const double scaled = double(values[i]) * buckets;
            at[i] = int32_t(std::min(std::max(scaled, 0.0), buckets - 1.0));
        }
        for (int i = 0; i + 1 < count; i += 2) {
            ++even[size_t(at[i])];
            ++odd[size_t(at[i + 1])];
        }
        if (count % 2)
            ++even[size_t(at[count - 1])];
    }
};

// Sums of rows and extremes, in the order of the rows.
void join(FlipPool& pool, const std::vector<Row>& rows, int x0, int y0) {
    const auto less_min = [](const Row& a, const Row& b) {
        return a.pixels > 0 && (b.pixels == 0 || a.min < b.min);
    };
    const auto less_max = [](const Row& a, const Row& b) {
        return b.pixels > 0 && (a.pixels == 0 || a.max < b.max);
    };
    const auto lowest = std::min_element(rows.begin(), rows.end(), less_min);
    const auto highest = std::max_element(rows.begin(), rows.end(), less_max);
    pool.min = lowest->min;
    pool.min_x = x0 + lowest->min_x;
    pool.min_y = y0 + int(lowest - rows.begin());
    pool.max = highest->max;
    pool.max_x = x0 + highest->max_x;
    pool.max_y = y0 + int(highest - rows.begin());
    double sum = 0;
    for (const Row& row : rows) {
        sum += row.sum;
        pool.pixels += row.pixels;
    }
    pool.mean = sum / double(pool.pixels);
}

// A rank is computed from a decimal percentage with some slack: the rounding of the division by 100
// must not move it to the next rank.
Wanted nearest_rank(double percent, int64_t count) {
    constexpr double rounding = 1e-9;
    return Wanted::rank(int64_t(std::ceil(percent * double(count) / 100 - rounding)) - 1);
}

void percentiles(FlipPool& pool, const OrderStatistics& order, PoolRequest* further) {
    std::vector<Wanted> wanted(
        {Wanted::percentile(0.50), Wanted::percentile(0.95), Wanted::percentile(0.99),
         Wanted::percentile(0.999), Wanted::weighted_percentile(0.25),
         Wanted::weighted_percentile(0.50), Wanted::weighted_percentile(0.75)});
    const size_t usual = wanted.size();
    for (size_t i = 0; further && i < further->percentiles.size(); ++i)
        wanted.push_back(nearest_rank(further->percentiles[i], order.count()));
    const auto found = order.find(wanted);
    if (further)
        further->found_percentiles.assign(found.begin() + ptrdiff_t(usual), found.end());
    pool.p50 = found[0];
    pool.p95 = found[1];
    pool.p99 = found[2];
    pool.p999 = found[3];
    pool.weighted_q1 = found[4];
    pool.weighted_median = found[5];
    pool.weighted_q3 = found[6];
}

// An error is compared as the double that it is: no share depends on how E was rounded.
void shares_above(const float* map, int width, int height, ptrdiff_t stride,
                  const kernels::ParallelFor& parallel, int64_t pixels, PoolRequest& further) {
    for (const double error : further.above) {
        std::atomic<int64_t> count{0};
        parallel(height, [&](int64_t y) {
            const float* row = map + y * stride;
            count += std::count_if(row, row + width, [&](float v) { return double(v) > error; });
        });
        further.found_above.push_back(double(count) / double(pixels));
    }
}

} // namespace

FlipPool pool(const float* map, int width, int height, ptrdiff_t stride, int x0, int y0,
              const kernels::ParallelFor& parallel, PoolRequest* further, Gaps gaps) {
    FlipPool out;
    if (width <= 0 || height <= 0)
        return out;
    std::vector<Row> rows(static_cast<size_t>(height));
    Accumulators<Histograms> histograms([] { return Histograms(); });
    for_each_block(width, height, parallel, [&](int first, int end) {
        histograms.with_one([&](Histograms& histogram) {
            Closed closed;
            for (int y = first; y < end; ++y) {
                const float* row = map + y * stride;
                if (gaps == Gaps::Nan)
                    closed.take(row, width);
                rows[size_t(y)] = gaps == Gaps::Nan ? closed.scanned() : scan_row(row, width);
                histogram.add(gaps == Gaps::Nan ? closed.values.data() : row,
                              rows[size_t(y)].pixels);
            }
        });
    });
    join(out, rows, x0, y0);
    if (out.pixels == 0)
        return {};
    for (const auto& histogram : histograms.all())
        for (size_t i = 0; i < out.histogram.size(); ++i)
            out.histogram[i] += histogram->even[i] + histogram->odd[i];
    percentiles(out, {map, width, height, stride, parallel, OrderStatistics::Keep::CountsAndSums},
                further);
    if (further)
        shares_above(map, width, height, stride, parallel, out.pixels, *further);
    return out;
}

} // namespace tonetool::metrics
