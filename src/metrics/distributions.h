// SPDX-License-Identifier: BSD-3-Clause
// Tails and quantiles of the distributions that the tests of this room need. They are Boost.Math's;
// its headers take seconds to compile, so that only distributions.cpp includes them.
#pragma once

#include <cstdint>

namespace tonetool::metrics {

/// P(Z > z) of the standard normal distribution.
double normal_upper_tail(double z);

/// z with P(Z <= z) = p, 0 < p < 1.
double normal_quantile(double p);

/// P(T > t) of Student's t with df > 0 degrees of freedom; t may be infinite.
double student_upper_tail(double t, double df);

/// t with P(T <= t) = p, 0 < p < 1.
double student_quantile(double p, double df);

/// P(X <= successes) of `trials` independent trials, each a success with probability 0 < p < 1.
double binomial_at_most(int64_t successes, int64_t trials, double p);

/// k of the upper tolerance limit mean + k sd of n >= 2 values of a normal distribution, which with
/// `confidence` lies above the part `content` of the distribution: a quantile of the noncentral t
/// over sqrt(n) (Hahn and Meeker, "Statistical Intervals", 1991).
double tolerance_factor(int64_t n, double content, double confidence);

} // namespace tonetool::metrics
