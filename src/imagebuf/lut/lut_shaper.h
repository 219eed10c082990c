// SPDX-License-Identifier: BSD-3-Clause
// Maps scene light to the 0 to 1 that look-up tables are indexed with. Only lut*.cpp include this.
#pragma once

#include <array>
#include <string>

#include "imagebuf/color/view_config.h"
#include "tonetool/lut.h"

namespace tonetool {

class LutShaper {
public:
    void make(const LutOptions& options);

    double shape(double x) const;
    double light(double v) const; ///< the inverse, never below 0
    double low() const { return light(0); }
    double high() const { return light(1); }
    /// As a formula of x; empty: x itself.
    std::string formula() const;
    /// As OpenColorIO does it; null: nothing to do.
    ocio::TransformRcPtr transform() const;
    /// log2 on some of the channels; the others, which are 0 to 1, become log2(1 + v).
    ocio::TransformRcPtr channels(const std::array<bool, 3>& shaped) const;
    /// Of log2: v = slope log2(x + offset) + shift.
    double slope() const { return m_slope; }
    double shift() const { return m_shift; }
    double offset() const { return m_offset; }
    bool is_log2() const { return m_kind == Kind::Log2; }

private:
    enum class Kind { Log2, AcesCct, Linear };
    Kind m_kind = Kind::Log2;
    double m_min = 0, m_max = 0, m_slope = 1, m_shift = 0, m_offset = 0;
};

} // namespace tonetool
