// SPDX-License-Identifier: BSD-3-Clause
#include "runs/interruption.h"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

namespace tonetool::runs {

namespace {

// What a signal handler may touch.
std::atomic<int> g_signal{0};
std::atomic<int> g_wake{-1}; ///< the end of the pipe that is written; -1: signals are not noted
static_assert(std::atomic<int>::is_always_lock_free);

} // namespace

Interruption::Interruption() {
    g_signal = 0;
    if (::pipe(m_pipe) != 0)
        return;
    for (const int end : m_pipe)
        ::fcntl(end, F_SETFD, FD_CLOEXEC);
    g_wake = m_pipe[1];
}

Interruption::~Interruption() {
    g_wake = -1;
    for (const int end : m_pipe)
        if (end >= 0)
            ::close(end);
}

int Interruption::signal_number() noexcept {
    return g_signal;
}

bool Interruption::is_for_all(int signal_number) const {
    constexpr int moment = 200; // milliseconds
    if (signal_number != SIGINT && signal_number != SIGTERM && signal_number != SIGHUP)
        return false;
    pollfd polled{m_pipe[0], POLLIN, 0};
    while (Interruption::signal_number() == 0 && ::poll(&polled, 1, moment) < 0 && errno == EINTR) {
    }
    return Interruption::signal_number() != 0;
}

void Interruption::forget() noexcept {
    g_wake = -1;
    g_signal = 0;
}

bool note_interruption(int signal_number) noexcept {
    const int wake = g_wake;
    int none = 0;
    if (wake < 0 || !g_signal.compare_exchange_strong(none, signal_number))
        return false;
    const int before = errno;
    const ssize_t written = ::write(wake, "", 1);
    (void)written; // an empty pipe takes a byte
    errno = before;
    return true;
}

} // namespace tonetool::runs
