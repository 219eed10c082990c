// SPDX-License-Identifier: BSD-3-Clause
// One Highway target at a time.
#pragma once

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "kernels/curve_rows.h"
#include "kernels/flip_rows.h"

namespace tonetool::kernels {

/// While it lives, kernels run on this target alone.
class Target {
public:
    explicit Target(int64_t target) {
        hwy::SetSupportedTargetsForTest(target);
        hwy::GetChosenTarget().Update(target);
        EXPECT_STREQ(flip_rows().name, hwy::TargetName(target));
        EXPECT_STREQ(curve_target(), hwy::TargetName(target));
    }
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;
    ~Target() {
        hwy::SetSupportedTargetsForTest(0);
        hwy::GetChosenTarget().Update(hwy::SupportedTargets());
    }
};

/// Calls visit() on every target of the kernels that this machine can run.
template <class Visit>
void on_every_target(const Visit& visit) {
    for (int64_t id : hwy::SupportedAndGeneratedTargets()) {
        SCOPED_TRACE(hwy::TargetName(id));
        const Target target(id);
        visit();
    }
}

} // namespace tonetool::kernels
