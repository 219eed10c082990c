// SPDX-License-Identifier: BSD-3-Clause
// Worker processes: work that a library below may end with a signal is done in a process of its
// own.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tonetool::runs {

/// What a worker process left of one task.
struct TaskResult {
    std::string reply; ///< the bytes that the task returned
    /// How the process ended before it replied, for people: "signal SIGFPE (Floating point
    /// exception)". Empty where it replied.
    std::string crash;
    int signal_number = 0; ///< that ended it; 0: none
};

/// Copies of this process, made by fork(), that run numbered tasks. A copy has no threads but the
/// one that called, so this process must not have started any (a pool, a library's readers) when
/// `run` is called; tasks may.
class Workers {
public:
    /// Runs in a worker process. Must not throw.
    using Task = std::function<std::string(size_t index)>;
    /// The next task; nullopt where there is none left. Called in this process.
    using Next = std::function<std::optional<size_t>()>;
    /// Called in this process, in the order in which tasks end.
    using Done = std::function<void(size_t index, const TaskResult& result)>;

    /// `processes` run at a time. `begin`, if any, is the first that each of them does.
    Workers(int processes, Task task, std::function<void()> begin = {});
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;
    /// Ends the worker processes; what they still do is lost.
    ~Workers();

    /// Until `next` has no more tasks and all are done. A worker process that ends early loses the
    /// task in hand alone: another one takes its place. A runtime_error where no process can be
    /// started. `stop`: a descriptor; as soon as it can be read, the rest is left undone.
    void run(const Next& next, const Done& done, int stop = -1);

private:
    struct Worker {
        int process = 0, socket = -1;
        size_t index = 0;       ///< of the task in hand
        std::string received{}; ///< of its reply
    };

    void start(size_t index);
    [[noreturn]] void serve(int socket) const;
    bool take_reply(Worker& worker, TaskResult& result) const;
    bool assign(Worker& worker, size_t index) const;
    /// The status that waitpid() tells.
    int end_of(Worker& worker) const;

    int m_processes;
    Task m_task;
    std::function<void()> m_begin;
    std::vector<Worker> m_workers;
};

} // namespace tonetool::runs
