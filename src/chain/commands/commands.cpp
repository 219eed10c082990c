// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/commands.h"

#include <algorithm>
#include <iterator>

#include "chain/commands/options.h"

namespace tonetool::chain {

std::vector<Command> own_commands() {
    std::vector<Command> all = diff_commands();
    for (auto family : {compare_commands, qc_commands, exposure_commands, tone_commands,
                        cgtmo_commands, light_commands, memory_commands}) {
        for (Command& row : family()) {
            row.own = true;
            all.push_back(std::move(row));
        }
    }
    return all;
}

std::vector<Modifier> inserted(std::vector<Modifier> rows, const std::string& key,
                               const std::vector<Modifier>& more) {
    const auto at =
        std::find_if(rows.begin(), rows.end(), [&](const Modifier& row) { return row.key == key; });
    rows.insert(at + 1, more.begin(), more.end());
    return rows;
}

} // namespace tonetool::chain
