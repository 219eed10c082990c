// Commands that rearrange the image stack.
#include "chain/call.h"
#include "chain/error.h"
#include "chain/session.h"

namespace tonetool::chain {

namespace {

void run_dup(Session& session, const Call& call) {
    session.push(call.images[0]);
    session.push(call.images[0]);
}

void run_swap(Session& session, const Call& call) {
    session.push(call.images[1]);
    session.push(call.images[0]);
}

void run_pop(Session&, const Call&) {}

void run_label(Session& session, const Call& call) {
    if (call.argument(0).empty()) {
        throw CommandError("empty label");
    }
    session.labels[call.argument(0)] = call.images[0];
    session.push(call.images[0]);
}

} // namespace

std::vector<Command> stack_commands() {
    return {
        {{{"dup"}, {}, 1, 2, Group::Stack}, {}, "Push a copy of the current image", run_dup, false},
        {{{"swap"}, {}, 2, 2, Group::Stack}, {}, "Swap the two images on top", run_swap, false},
        {{{"pop"}, {}, 1, 0, Group::Stack}, {}, "Throw away the current image", run_pop, false},
        {{{"label"}, {"NAME"}, 1, 1, Group::Stack},
         {},
         "Label the current image: the bare word NAME pushes it again",
         run_label,
         false},
    };
}

} // namespace tonetool::chain
