// SPDX-License-Identifier: BSD-3-Clause
// Commands that rearrange the image stack.
#include "chain/session/ops.h"

namespace tonetool::chain {

namespace {

void label(Session& session, const Call& call) {
    if (call.argument(0).empty())
        throw CommandError("empty label");
    session.labels[call.argument(0)] = call.images[0];
    session.push(call.images[0]);
}

void dup(Session& session, const Call& call) {
    session.push(call.images[0]);
    session.push(call.images[0]);
}

void swap(Session& session, const Call& call) {
    session.push(call.images[1]);
    session.push(call.images[0]);
}

} // namespace

std::vector<Command> stack_commands() {
    std::vector<Command> all = {
        free_row(Group::Stack, "dup", 1, 2, "Push a copy of the current image", dup),
        free_row(Group::Stack, "swap", 2, 2, "Swap the two images on top", swap),
        free_row(Group::Stack, "pop", 1, 0, "Throw away the current image",
                 [](Session&, const Call&) {}),
        keeping_header(free_row(Group::Stack, "label NAME", 1, 1,
                                "Label the current image: the bare word NAME pushes it again",
                                label)),
    };
    for (Command& row : all)
        row.postponable = false;
    return all;
}

} // namespace tonetool::chain
