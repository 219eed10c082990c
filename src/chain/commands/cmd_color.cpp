// SPDX-License-Identifier: BSD-3-Clause
// Values as colours, and the OpenColorIO configuration.
#include "chain/images/colormap.h"
#include "chain/session/ops.h"
#include "text/error.h"
#include "tonetool/display.h"

namespace tonetool::chain {

namespace {

bool colormap(Op& op) {
    const std::string& map = op.call.argument(0);
    if (op.a().deep() && !op.session.compat) {
        throw CommandError("\"" + op.call.images.front()->name() +
                           "\" is deep, which this command cannot use");
    }
    op.dst = op.session.compat ? linear_colored(op.a(), map) : colored(op.a(), map);
    return !op.dst.has_error();
}

void run_colorconfig(Session& session, const Call& call) {
    session.color_config = call.argument(0);
    session.ocio.reset();
    if (session.compat && color_config(session).has_error())
        throw CommandError(color_config(session).geterror());
}

} // namespace

std::vector<Command> color_commands() {
    std::vector<Command> all = op_rows(
        Group::Color,
        {{"colormap MAPNAME", 1,
          "Show values as colours: " + join(ToneAlgo::color_maps(), ", ") + ", or RGB triples",
          colormap}});
    all.push_back(
        keeping_header(Command{{{"colorconfig"}, {"FILE"}, 0, 0, Group::Color},
                               {},
                               "OpenColorIO configuration of the commands that follow ($OCIO)",
                               run_colorconfig}));
    return all;
}

} // namespace tonetool::chain
