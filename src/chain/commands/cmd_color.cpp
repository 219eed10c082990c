// SPDX-License-Identifier: BSD-3-Clause
// Values as colours, and the OpenColorIO configuration.
#include "chain/commands/commands.h"
#include "chain/images/colormap.h"
#include "chain/session/ops.h"
#include "tonetool/display.h"

namespace tonetool::chain {

namespace {

bool colormap(Op& op) {
    const std::string& map = op.call.argument(0);
    const bool bar = op.call.flag("bar", false);
    op.dst = op.session.settings.compat ? linear_colored(op.a(), map)
             : bar                      ? colored_with_bar(op.a(), map)
                                        : colored(op.a(), map);
    return !op.dst.has_error();
}

void run_colorconfig(Session& session, const Call& call) {
    session.settings.color_config = call.argument(0);
    session.settings.ocio.reset();
    if (session.settings.compat && color_config(session).has_error())
        throw CommandError(color_config(session).geterror());
}

} // namespace

Rows color_commands() {
    const std::string maps = join(ToneAlgo::color_maps(), ", ");
    return {on_pixels("colormap MAPNAME", 1, "Show values as colours: " + maps + ", or RGB triples",
                      colormap)
                .modifier("bar", "0|1", "with a bar of the colours from 0 to 1 at the right"),
            command("colorconfig FILE",
                    "OpenColorIO configuration of the commands that follow ($OCIO)",
                    run_colorconfig)
                .keeps_header()};
}

} // namespace tonetool::chain
