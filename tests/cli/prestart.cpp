// SPDX-License-Identifier: BSD-3-Clause
// Preloaded into a program under test (LD_PRELOAD), so that it starts a thousand times in the time
// of a few: most of what it does then is to load two hundred libraries. Once loaded it waits on the
// socket that PRESTART_SOCKET names. For each request a copy of it (fork) calls the program's own
// main with the arguments, the environment, the folder and the standard streams of the request;
// what main sees is what it sees in a process of its own. See prestart.py.
#include <algorithm>
#include <array>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <iostream>
#include <poll.h>
#include <string>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace {

using Main = int (*)(int, char**, char**);
Main g_main = nullptr;

struct Request {
    std::array<int, 3> streams{-1, -1, -1};
    std::string folder;
    std::vector<std::string> arguments, environment;
};

bool receive_all(int socket, void* to, size_t size) {
    auto* at = static_cast<char*>(to);
    while (size > 0) {
        const ssize_t n = ::read(socket, at, size);
        if (n <= 0)
            return false;
        at += n;
        size -= size_t(n);
    }
    return true;
}

// The sizes of the text and of its argument list, with the streams; then the text.
bool receive(int socket, Request& request) {
    std::array<uint32_t, 2> sizes{};
    iovec data{sizes.data(), sizeof sizes};
    alignas(cmsghdr) std::array<char, CMSG_SPACE(sizeof request.streams)> control{};
    msghdr message{};
    message.msg_iov = &data;
    message.msg_iovlen = 1;
    message.msg_control = control.data();
    message.msg_controllen = control.size();
    if (::recvmsg(socket, &message, 0) != ssize_t(sizeof sizes) || !CMSG_FIRSTHDR(&message))
        return false;
    std::memcpy(request.streams.data(), CMSG_DATA(CMSG_FIRSTHDR(&message)), sizeof request.streams);
    std::string text(sizes[0], '\0');
    if (!receive_all(socket, text.data(), text.size()))
        return false;
    std::vector<std::string> words;
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find('\0', at), text.size());
        words.push_back(text.substr(at, end - at));
        at = end + 1;
    }
    const size_t first = 1, last = first + sizes[1];
    if (words.size() < last)
        return false;
    request.folder = words[0];
    request.arguments.assign(words.begin() + first, words.begin() + ssize_t(last));
    request.environment.assign(words.begin() + ssize_t(last), words.end());
    return true;
}

std::vector<char*> pointers(std::vector<std::string>& words) {
    std::vector<char*> all;
    for (std::string& word : words)
        all.push_back(word.data());
    all.push_back(nullptr);
    return all;
}

// What was set up before the fork is not taken down: libraries would wait for threads that they
// have started when they were loaded, and that a copy does not have.
void end(int status, void*) {
    std::cout.flush();
    std::fflush(nullptr);
    ::_exit(status);
}

// Never destroyed: main's arguments live as long as the process.
int run(Request& request) {
    for (int i = 0; i < 3; ++i)
        ::dup2(request.streams[size_t(i)], i);
    for (int stream : request.streams)
        ::close(stream);
    if (::chdir(request.folder.c_str()) != 0)
        ::_exit(127);
    static std::vector<char*> arguments = pointers(request.arguments);
    static std::vector<char*> environment = pointers(request.environment);
    ::environ = environment.data();
    ::on_exit(end, nullptr);
    return g_main(int(request.arguments.size()), arguments.data(), environment.data());
}

// In a process of its own, which waits for the program's. Tells its number, then how it ended.
int answer(int connection) {
    static Request request;
    if (!receive(connection, request))
        ::_exit(1);
    ::signal(SIGCHLD, SIG_DFL);
    const pid_t process = ::fork();
    if (process == 0) {
        ::close(connection);
        return run(request);
    }
    for (int stream : request.streams) // so that they end where the program ends
        ::close(stream);
    int status = 127 << 8;
    const auto tell = [connection](int32_t number) {
        return ::send(connection, &number, sizeof number, MSG_NOSIGNAL) == sizeof number;
    };
    const bool told = tell(process);
    if (process > 0)
        ::waitpid(process, &status, 0);
    ::_exit(told && tell(status) ? 0 : 1);
}

int serve(int argc, char** argv, char** environment) {
    const char* path = std::getenv("PRESTART_SOCKET");
    if (!path)
        return g_main(argc, argv, environment);
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    std::strncpy(address.sun_path, path, sizeof address.sun_path - 1);
    const int listening = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (::bind(listening, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
        ::listen(listening, 64) != 0)
        return 1;
    ::signal(SIGCHLD, SIG_IGN); // nobody waits for those who wait
    std::array<pollfd, 2> waited{pollfd{listening, POLLIN, 0}, pollfd{STDIN_FILENO, POLLIN, 0}};
    while (::poll(waited.data(), waited.size(), -1) > 0 &&
           !waited[1].revents) { // a closed stdin ends
        const int connection = ::accept4(listening, nullptr, nullptr, SOCK_CLOEXEC);
        if (connection >= 0 && ::fork() == 0) {
            ::close(listening);
            return answer(connection);
        }
        ::close(connection);
    }
    ::_exit(0);
}

} // namespace

extern "C" __attribute__((visibility("default"))) int
__libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                  void (*rtld_fini)(), void* stack_end) {
    using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
    const auto start = reinterpret_cast<Start>(::dlsym(RTLD_NEXT, "__libc_start_main"));
    g_main = main;
    return start(serve, argc, argv, init, fini, rtld_fini, stack_end);
}
