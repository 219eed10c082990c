// SPDX-License-Identifier: BSD-3-Clause
#include "metrics/distributions.h"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/distributions/non_central_t.hpp>
#include <boost/math/distributions/normal.hpp>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>

namespace tonetool::metrics {
namespace {

namespace policies = boost::math::policies;

// By default all is computed in long double, several times slower: there are tens of thousands of
// tails in one image. Overflow gives infinity instead of an exception.
using InDouble = policies::policy<policies::promote_double<false>,
                                  policies::overflow_error<policies::errno_on_error>>;
using Student = boost::math::students_t_distribution<double, InDouble>;
using NoncentralT = boost::math::non_central_t_distribution<double>;

} // namespace

double normal_upper_tail(double z) {
    return 0.5 * std::erfc(z / std::sqrt(2.0));
}

double normal_quantile(double p) {
    return boost::math::quantile(boost::math::normal(), p);
}

double student_upper_tail(double t, double df) {
    if (std::isinf(t))
        return t > 0 ? 0.0 : 1.0;
    return boost::math::cdf(boost::math::complement(Student(df), t));
}

double student_quantile(double p, double df) {
    return boost::math::quantile(Student(df), p);
}

double binomial_at_most(int64_t successes, int64_t trials, double p) {
    if (successes < 0)
        return 0;
    return boost::math::cdf(boost::math::binomial(double(trials), p), double(successes));
}

double tolerance_factor(int64_t n, double content, double confidence) {
    const double root = std::sqrt(double(n));
    const NoncentralT t(double(n - 1), normal_quantile(content) * root);
    return boost::math::quantile(t, confidence) / root;
}

} // namespace tonetool::metrics
