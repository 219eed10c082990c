// SPDX-License-Identifier: BSD-3-Clause
// Which images there are of which case, for what shows them.
#pragma once

#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "sequence/frames/item.h"

namespace tonetool::sequence {

struct CaseFiles {
    /// Names as they were asked for; empty: there is none.
    struct Of {
        std::string reference, test, error;
        bool any() const { return !reference.empty() || !test.empty() || !error.empty(); }
        std::vector<std::string> all() const { return {reference, test, error}; }
    };
    /// What they are called, and where they are.
    static constexpr std::array<std::pair<const char*, std::string Of::*>, 3> kAll{
        {{"reference", &Of::reference}, {"test", &Of::test}, {"error", &Of::error}}};

    std::map<Item, Of> of{};

    Of find(const Item& item) const {
        const auto found = of.find(item);
        return found == of.end() ? Of{} : found->second;
    }
};

} // namespace tonetool::sequence
