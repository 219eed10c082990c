// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/light_args.h"

#include "chain/commands/options.h"
#include "imagebuf/options/tone_options.h"
#include "text/error.h"

namespace tonetool::chain {

LightOptions light_options(const Call& call) {
    LightOptions options;
    read_options(call, options);
    if (call.has("lightunit") && options.table.empty())
        throw CommandError("lightunit= needs a table of lights (lights=)");
    return options;
}

} // namespace tonetool::chain
