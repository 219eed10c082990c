// SPDX-License-Identifier: BSD-3-Clause
// Where the time of the evaluation goes: its functions, each with a clock around it.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "kernels/flip_rows.h"

namespace tonetool::bench {

/// Works for one thread at a time and one object at a time.
class StageClock {
public:
    explicit StageClock(const kernels::FlipRows& functions);
    /// The same functions, timed.
    const kernels::FlipRows& functions() const { return m_timed; }
    /// Each stage's part of so many seconds; what is left is "other".
    std::vector<std::pair<std::string, double>> shares(double total) const;

private:
    kernels::FlipRows m_timed;
};

} // namespace tonetool::bench
