// Commands that print what images are.
#include "chain/call.h"
#include "chain/session.h"

namespace tonetool::chain {

namespace {

void run_info(Session& session, const Call& call) {
    session.info = true;
    session.info_verbose = session.info_verbose || call.flag("verbose", false);
}

void run_stats(Session& session, const Call&) {
    session.stats = true;
}

} // namespace

std::vector<Command> inspect_commands() {
    return {
        {{{"info"}, {}, 0, 0, Group::Print},
         {{"verbose", "0|1", "with the metadata, as -v does"}},
         "Print size, channels and format of every image read after it (-v: and its metadata)",
         run_info},
        {{{"stats"}, {}, 0, 0, Group::Print},
         {},
         "Print pixel statistics of every image read after it",
         run_stats},
    };
}

} // namespace tonetool::chain
