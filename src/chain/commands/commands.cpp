#include "chain/commands/commands.h"

#include <iterator>

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

} // namespace tonetool::chain
