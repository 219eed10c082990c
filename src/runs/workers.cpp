// SPDX-License-Identifier: BSD-3-Clause
#include "runs/workers.h"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <poll.h>
#include <stdexcept>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include "runs/interruption.h"

namespace tonetool::runs {

namespace {

// A socket's end is closed, and a worker's or the caller's death seen, as a read of nothing.
bool read_all(int socket, void* to, size_t size) {
    auto* at = static_cast<char*>(to);
    while (size > 0) {
        const ssize_t n = ::read(socket, at, size);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        at += n;
        size -= size_t(n);
    }
    return true;
}

bool write_all(int socket, const void* from, size_t size) {
    const auto* at = static_cast<const char*>(from);
    while (size > 0) {
        const ssize_t n = ::send(socket, at, size, MSG_NOSIGNAL);
        if (n < 0 && errno == EINTR)
            continue;
        if (n <= 0)
            return false;
        at += n;
        size -= size_t(n);
    }
    return true;
}

std::string in_words(int status) {
    if (WIFSIGNALED(status)) {
        const int number = WTERMSIG(status);
        const char* name = ::sigabbrev_np(number);
        const char* description = ::sigdescr_np(number);
        return std::string("signal ") +
               (name ? std::string("SIG") + name : std::to_string(number)) +
               (description ? std::string(" (") + description + ")" : "");
    }
    return "exit status " + std::to_string(WEXITSTATUS(status));
}

// Signals that would end the process come when it is known which of the two it is.
class SignalsHeld {
public:
    SignalsHeld() {
        sigset_t held;
        sigemptyset(&held);
        for (const int number : {SIGINT, SIGTERM, SIGHUP})
            sigaddset(&held, number);
        ::sigprocmask(SIG_BLOCK, &held, &m_before);
    }
    ~SignalsHeld() { release(); }
    SignalsHeld(const SignalsHeld&) = delete;
    SignalsHeld& operator=(const SignalsHeld&) = delete;
    void release() { ::sigprocmask(SIG_SETMASK, &m_before, nullptr); }

private:
    sigset_t m_before{};
};

// The workers end with the process that started them, and by a signal that lets them remove what
// they have not finished. Where memory is short they go first, and the check goes on.
void follow_the_starter(int starter) {
#ifdef __linux__
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != starter)
        ::_exit(1);
    std::ofstream("/proc/self/oom_score_adj") << 500;
#else
    (void)starter;
#endif
}

} // namespace

Workers::Workers(int processes, Task task, std::function<void()> begin)
    : m_processes(std::max(1, processes)),
      m_task(std::move(task)),
      m_begin(std::move(begin)) {}

Workers::~Workers() {
    for (const Worker& worker : m_workers)
        ::kill(worker.process, SIGTERM);
    for (Worker& worker : m_workers)
        end_of(worker);
}

void Workers::serve(int socket) const {
    size_t index = 0;
    int status = 0;
    try {
        while (read_all(socket, &index, sizeof index)) {
            const std::string reply = m_task(index);
            const uint64_t size = reply.size();
            if (!write_all(socket, &size, sizeof size) ||
                !write_all(socket, reply.data(), reply.size()))
                break;
        }
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "tonetool ERROR: %s\n", problem.what());
        status = 1;
    }
    // What the libraries have printed; no destructors of what belongs to the starter, and no return
    // to what it was doing.
    std::fflush(nullptr);
    ::_exit(status);
}

void Workers::start(size_t index) {
    int sockets[2];
    if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets) != 0) {
        throw std::runtime_error(std::string("cannot start a worker process: ") +
                                 std::strerror(errno));
    }
    std::fflush(nullptr);
    SignalsHeld held;
    const int starter = ::getpid(), process = ::fork();
    if (process == 0) {
        Interruption::forget();
        held.release();
        follow_the_starter(starter);
        ::close(sockets[0]);
        for (const Worker& other : m_workers)
            ::close(other.socket);
        if (m_begin)
            m_begin();
        serve(sockets[1]);
    }
    const int failure = errno;
    ::close(sockets[1]);
    if (process < 0) {
        ::close(sockets[0]);
        throw std::runtime_error(std::string("cannot start a worker process: ") +
                                 std::strerror(failure));
    }
    m_workers.push_back({process, sockets[0], index});
    assign(m_workers.back(), index);
}

// False where the process has ended since its last reply.
bool Workers::assign(Worker& worker, size_t index) const {
    worker.index = index;
    worker.received.clear();
    return write_all(worker.socket, &index, sizeof index);
}

// True where the task has ended, with a reply or with its process.
bool Workers::take_reply(Worker& worker, TaskResult& result) const {
    char bytes[65536];
    ssize_t n = 0;
    do {
        n = ::read(worker.socket, bytes, sizeof bytes);
    } while (n < 0 && errno == EINTR);
    if (n <= 0) {
        const int status = end_of(worker);
        result.crash = in_words(status);
        result.signal_number = WIFSIGNALED(status) ? WTERMSIG(status) : 0;
        return true;
    }
    worker.received.append(bytes, size_t(n));
    uint64_t size = 0;
    if (worker.received.size() < sizeof size)
        return false;
    std::memcpy(&size, worker.received.data(), sizeof size);
    if (worker.received.size() < sizeof size + size)
        return false;
    result.reply = worker.received.substr(sizeof size);
    return true;
}

int Workers::end_of(Worker& worker) const {
    ::close(worker.socket);
    worker.socket = -1;
    int status = 0;
    while (::waitpid(worker.process, &status, 0) < 0 && errno == EINTR) {
    }
    return status;
}

void Workers::run(const Next& next, const Done& done, int stop) {
    std::optional<size_t> index;
    while (int(m_workers.size()) < m_processes && (index = next()))
        start(*index);
    while (!m_workers.empty()) {
        std::vector<pollfd> polled;
        for (const Worker& worker : m_workers)
            polled.push_back({worker.socket, POLLIN, 0});
        polled.push_back({stop, POLLIN, 0}); // poll() takes no notice of -1
        if (::poll(polled.data(), nfds_t(polled.size()), -1) < 0)
            continue; // a signal
        if (polled.back().revents != 0)
            return;
        for (size_t i = m_workers.size(); i-- > 0;) {
            TaskResult result;
            if (polled[i].revents == 0 || !take_reply(m_workers[i], result))
                continue;
            done(m_workers[i].index, result);
            index = next();
            const bool alive = result.crash.empty();
            if (alive && index && assign(m_workers[i], *index))
                continue;
            if (alive)
                end_of(m_workers[i]);
            m_workers.erase(m_workers.begin() + std::ptrdiff_t(i));
            if (index)
                start(*index);
        }
    }
}

} // namespace tonetool::runs
