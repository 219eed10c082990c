// SPDX-License-Identifier: BSD-3-Clause
// Commands that rearrange the image stack.
#include "chain/commands/commands.h"
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

void label(Session& session, const Call& call) {
    if (call.argument(0).empty())
        throw CommandError("empty label");
    session.stack.labels[call.argument(0)] = call.images[0];
    session.stack.push(call.images[0]);
}

void dup(Session& session, const Call& call) {
    session.stack.push(call.images[0]);
    session.stack.push(call.images[0]);
}

void swap(Session& session, const Call& call) {
    session.stack.push(call.images[1]);
    session.stack.push(call.images[0]);
}

} // namespace

Rows stack_commands() {
    return {
        command("dup", "Push a copy of the current image", dup).images(1, 2).at_once(),
        command("swap", "Swap the two images on top", swap).images(2, 2).at_once(),
        command("pop", "Throw away the current image", do_nothing).images(1, 0).at_once(),
        command("label NAME", "Label the current image: the bare word NAME pushes it again", label)
            .images(1, 1)
            .at_once()
            .keeps_header()};
}

} // namespace tonetool::chain
