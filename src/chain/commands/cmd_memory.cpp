// SPDX-License-Identifier: BSD-3-Clause
// --memory, the bound of the memory of comparisons.
#include <cstdint>
#ifdef __GLIBC__
#include <malloc.h>
#endif

#include "chain/commands/commands.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// Per thread OpenEXR's decoder holds blocks of rows of the whole width.
constexpr int kThreadsWithinMemory = 2;

// glibc keeps freed blocks of up to 32 MB for itself, and some for each thread; with a bound set
// they are returned to the system.
void give_memory_back() {
#ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 20);
    mallopt(M_TRIM_THRESHOLD, 1 << 20);
    mallopt(M_ARENA_MAX, 2);
#endif
}

void run_memory(Session& session, const Call& call) {
    auto size = parse_size(call.argument(0));
    if (!size) {
        throw CommandError("SIZE \"" + call.argument(0) +
                           "\": not a size; valid: bytes, or a whole number with K, M or G "
                           "(powers of 1024), above 0: 268435456, 256M, 1G");
    }
    session.settings.memory = *size / uint64_t(session.settings.parallel);
    limit_reader_threads(kThreadsWithinMemory);
    give_memory_back();
}

} // namespace

Rows memory_commands() {
    return {command("memory SIZE",
                    "Peak memory of the comparisons that follow, 256M or 1G: larger images are "
                    "read in scanline blocks (half of the computer's memory)",
                    run_memory)
                .of_process()
                .manner()};
}

} // namespace tonetool::chain
