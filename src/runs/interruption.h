// SPDX-License-Identifier: BSD-3-Clause
// Ctrl-C and the like while frames run.
#pragma once

#include <string>

namespace tonetool::runs {

/// While this lives the first signal that would end the process is only noted, so that who runs the
/// frames begins nothing new, ends the worker processes and says what is kept. One at a time.
class Interruption {
public:
    /// Without a pipe (none is left to this process) signals end it as ever.
    Interruption();
    ~Interruption();
    Interruption(const Interruption&) = delete;
    Interruption& operator=(const Interruption&) = delete;

    /// The signal that came; 0: none.
    static int signal_number() noexcept;
    /// To poll: it can be read once a signal has come. -1: it cannot be told so.
    int descriptor() const { return m_pipe[0]; }
    /// Whether a worker that was ended by a signal was ended by one that this process gets, too, at
    /// once or in a moment: a terminal sends it to all of them.
    bool is_for_all(int signal_number) const;
    /// In a new worker process, which signals end as ever.
    static void forget() noexcept;

private:
    int m_pipe[2] = {-1, -1};
};

/// For a signal handler: whether the signal was noted. Else the process is to end at once: no
/// frames run, or it was told before.
bool note_interruption(int signal_number) noexcept;

/// Thrown where a signal has ended the frames.
struct Interrupted {
    int signal_number;
    std::string kept; ///< what a later run need not do again, for people
    int exit_status() const { return 128 + signal_number; } ///< as shells have it
};

} // namespace tonetool::runs
