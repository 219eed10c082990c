// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/distributions.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace tonetool::metrics {
namespace {

// From the method's reference implementation, which integrates and bisects in double precision with
// code of its own.
struct StudentTail {
    double t, df, p;
};
constexpr StudentTail kStudent[] = {
    {0.5, 31, 0.3103029756238591},     {0.5, 255, 0.3087531337461128},
    {0.5, 4095, 0.30855097172471346},  {3.0, 31, 0.0026443733444956826},
    {3.0, 255, 0.001483589155739281},  {3.0, 4095, 0.0013580279519988278},
    {8.0, 31, 2.4701318509516992e-09}, {8.0, 255, 2.1882068977225034e-14},
    {8.0, 4095, 8.029400143909946e-16}};

struct Factor {
    int n;
    double content, confidence, k;
};
constexpr Factor kFactors[] = {
    {4, .99, .95, 7.04236257535403},    {4, .95, .95, 5.143874860988552},
    {4, .99, .99, 12.387283601286526},  {8, .99, .95, 4.35385580922893},
    {8, .95, .95, 3.1872935684474495},  {8, .99, .99, 5.811797532368896},
    {12, .99, .95, 3.747084893936475},  {12, .95, .95, 2.7363425058069932},
    {12, .99, .99, 4.633001166944272},  {20, .99, .95, 3.2951569361707147},
    {20, .95, .95, 2.3960016837520612}, {20, .99, .99, 3.831557985598371},
    {40, .99, .95, 2.940942121530247},  {40, .95, .95, 2.125493754339062},
    {40, .99, .99, 3.248552558265545}};

// Relative: that is where tails matter.
void expect_close(double got, double want) {
    EXPECT_NEAR(got / want, 1, 1e-10);
}

TEST(Distributions, StudentTails) {
    for (const StudentTail& tail : kStudent)
        expect_close(student_upper_tail(tail.t, tail.df), tail.p);
}

TEST(Distributions, StudentWithOneAndTwoDegreesHaveClosedForms) {
    const double pi = std::acos(-1.0);
    for (const double t : {0.1, 1.0, 7.0, 1e3}) {
        expect_close(student_upper_tail(t, 1), std::atan(1 / t) / pi);
        const double s = t * t + 2;
        expect_close(student_upper_tail(t, 2), 1 / (s + t * std::sqrt(s)));
    }
}

TEST(Distributions, TailsOfInfinityAndTheMiddle) {
    const double inf = std::numeric_limits<double>::infinity();
    EXPECT_EQ(student_upper_tail(inf, 255), 0.0);
    EXPECT_EQ(student_upper_tail(-inf, 255), 1.0);
    EXPECT_EQ(student_upper_tail(0, 255), 0.5);
    EXPECT_EQ(student_upper_tail(1e6, 1e4), 0.0) << "smaller than any double, no exception";
    EXPECT_EQ(normal_upper_tail(0), 0.5);
    EXPECT_EQ(normal_upper_tail(inf), 0.0);
    EXPECT_GT(normal_upper_tail(37), 0.0) << "1 - P(Z <= z) would be 0";
}

TEST(Distributions, QuantilesUndoTails) {
    for (const double p : {0.9, 0.99, 0.9999}) {
        expect_close(normal_upper_tail(normal_quantile(p)) + p, 1);
        EXPECT_NEAR(normal_upper_tail(normal_quantile(p)) / (1 - p), 1, 1e-9);
        for (const double df : {10.0, 255.0, 4095.0})
            EXPECT_NEAR(student_upper_tail(student_quantile(p, df), df) / (1 - p), 1, 1e-9);
    }
    EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-12);
    EXPECT_NEAR(normal_quantile(0.025), -1.959963984540054, 1e-12);
}

TEST(Distributions, ToleranceFactors) {
    for (const Factor& factor : kFactors)
        expect_close(tolerance_factor(factor.n, factor.content, factor.confidence), factor.k);
}

TEST(Distributions, BinomialIsTheSumOfItsTerms) {
    const double p = 0.3;
    double sum = 0, choose = 1;
    for (int i = 0; i <= 9; ++i) {
        sum += choose * std::pow(p, i) * std::pow(1 - p, 9 - i);
        expect_close(binomial_at_most(i, 9, p), sum);
        choose = choose * (9 - i) / (i + 1);
    }
    EXPECT_EQ(binomial_at_most(-1, 9, p), 0.0);
}

} // namespace
} // namespace tonetool::metrics
