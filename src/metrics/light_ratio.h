// SPDX-License-Identifier: BSD-3-Clause
// By which factor light has changed, and how sure that is.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace tonetool::metrics {

/// The ratio estimator sum(t) / sum(r) and its standard error, pixels as independent draws:
/// sqrt(sum (t - gain r)^2) / sum(r).
class LightRatio {
public:
    void add(double r, double t) {
        m_r += r;
        m_t += t;
        m_rr += r * r;
        m_rt += r * t;
        m_tt += t * t;
    }
    double reference() const { return m_r; }
    double test() const { return m_t; }

    /// NaN where the reference has no light.
    double gain() const { return m_r > 0 ? m_t / m_r : std::numeric_limits<double>::quiet_NaN(); }
    double error() const {
        const double g = gain();
        return std::sqrt(std::max(0.0, m_tt - 2 * g * m_rt + g * g * m_rr)) / m_r;
    }
    /// Another light: off by 5 %, as neighbouring pixels that share samples make the error too
    /// small, and by six standard errors.
    bool differs() const {
        constexpr double ratio = 0.05, errors = 6;
        const double off = std::abs(gain() - 1);
        return off >= ratio && off >= errors * error();
    }
    /// Of a light of which a picture with `whole` light has a thousandth or more: "off", "new",
    /// "weaker", "stronger", or "".
    std::string finding(double whole) const {
        constexpr double faint = 1e-3;
        // A few samples that strayed into it are no light, and make the error of the gain huge.
        const bool starts = m_t > 0 && m_r<faint * m_t, ends = m_r> 0 && m_t < faint * m_r;
        if (std::max(m_r, m_t) < faint * whole || !(starts || ends || differs()))
            return "";
        return starts ? "new" : ends ? "off" : gain() < 1 ? "weaker" : "stronger";
    }

private:
    double m_r = 0, m_t = 0, m_rr = 0, m_rt = 0, m_tt = 0;
};

} // namespace tonetool::metrics
