// SPDX-License-Identifier: BSD-3-Clause
// The tonetool program: its arguments go to the chain, the chain's status comes back.
#include <cerrno>
#include <csignal>
#include <exception>
#include <fcntl.h>
#include <iostream>
#include <unistd.h>

#include "program/doctor.h"
#include "runs/interruption.h"
#include "runs/runs.h"
#include "text/printable.h"
#include "tone.imageio/tone_input.h"
#include "tonetool/write.h"

namespace {

extern "C" void end_by_signal(int signal_number) {
    if (tonetool::runs::note_interruption(signal_number))
        return;
    tonetool::remove_unfinished_outputs();
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
}

void install_signal_handlers() {
    // A reader that went away is a failed write and status 1, not a silent death.
    std::signal(SIGPIPE, SIG_IGN);
    for (int number : {SIGINT, SIGTERM, SIGHUP}) {
        // nohup's SIGHUP stays ignored.
        if (std::signal(number, end_by_signal) == SIG_IGN)
            std::signal(number, SIG_IGN);
    }
#ifdef SIGXFSZ
    std::signal(SIGXFSZ, SIG_IGN); // a write beyond ulimit -f fails instead
#endif
}

// What is opened later must not take the place of a standard stream that is closed: results would
// be written into it. Reads and writes fail as they did.
void hold_closed_streams() {
    for (int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (::fcntl(stream, F_GETFD) < 0 && errno == EBADF) {
            // The lowest number that is free: this one.
            (void)::open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        }
    }
}

} // namespace

int main(int argc, char** argv) {
    const tonetool::PrintableStream out(std::cout), err(std::cerr);
    try {
        hold_closed_streams();
        install_signal_handlers();
        tonetool::register_tone_format();
        tonetool::runs::know_all_commands();
        tonetool::chain::add_commands(tonetool::chain::Group::General, tonetool::doctor_commands());
        tonetool::Strings words(argv + (argc > 0 ? 1 : 0), argv + argc);
        return tonetool::runs::run(words, std::cout, std::cerr, true);
    } catch (const std::exception& problem) {
        std::cerr << "tonetool ERROR: " << problem.what() << std::endl;
    } catch (...) {
        std::cerr << "tonetool ERROR: unknown error" << std::endl;
    }
    return 1;
}
