// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/check_files.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>
#include <unistd.h>

#include "imagebuf/write/temporary_names.h"
#include "sequence/frames/file_stamp.h"
#include "sequence/results/results_json.h"
#include "sequence/results/tables.h"
#include "tonetool/write.h"

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

using Text = std::string (*)(const ShotResult&, const CaseFiles&);

const std::map<std::string, Text>& texts() {
    static const std::map<std::string, Text> all = {
        {"csv", [](const ShotResult& shot, const CaseFiles&) { return csv_text(shot); }},
        {"junit", junit_text}};
    return all;
}

// It may be larger than what it is made of.
void write_json(const ShotResult& shot, const std::string& file, bool records) {
    const auto put = [&](const std::function<void(const std::string&)>& to) {
        put_json(shot, records, to);
    };
    std::string why;
    if (file == "-") {
        put([](const std::string& piece) { std::cout << piece; });
        std::cout.flush();
    } else if (!write_bytes(put, file, why)) {
        throw std::runtime_error(why);
    }
}

// Only one text file may go to the standard output.
void check_standard_output(const std::string& start, const std::string& command,
                           const CheckFiles& files) {
    if (texts().count(command) == 0 && command != "json" && command != "statistics" &&
        command != "bad-frames") {
        throw std::runtime_error(start + "\"-\" is the standard output, which takes texts alone "
                                         "(valid: --json -, --csv -, --junit -, --statistics -)");
    }
    for (const auto& [other, file] : files) {
        if (file == "-" && other != command) {
            throw std::runtime_error(start + "--" + other +
                                     " has the standard output already "
                                     "(valid: one of them)");
        }
    }
}

bool is_folder(const std::string& command) {
    return command == "state" || command == "pictures" || command == "images";
}

// Of a file that may be a link to one elsewhere, which need not be there yet.
fs::path folder_of(const std::string& file) {
    fs::path target = file;
    std::error_code why;
    for (int hops = 0; hops < 40 && fs::is_symlink(target, why); ++hops)
        target = target.parent_path() / fs::read_symlink(target, why); // an absolute one is itself
    return target.has_parent_path() ? target.parent_path() : ".";
}

// Named as the temporary files of outputs are, which the next run removes if this process is killed
// before it has removed its own. Returns why it cannot be made, 0 if it can.
int make_and_remove(const fs::path& folder) {
    constexpr char kName[] = "tonetool-try";
    static std::atomic<unsigned> counter{0};
    remove_abandoned_outputs({(folder / kName).string()});
    for (int attempt = 0; attempt < 100; ++attempt) {
        const std::string file = (folder / temporary_name(kName, ::getpid(), counter++)).string();
        const int made = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
        const int failure = errno;
        if (made >= 0) {
            ::close(made);
            ::unlink(file.c_str());
            return 0;
        }
        if (failure != EEXIST) // another container's process may have the same number
            return failure;
    }
    return EEXIST;
}

} // namespace

bool has_standard_output(const CheckFiles& files) {
    return std::any_of(files.begin(), files.end(),
                       [](const auto& item) { return item.second == "-"; });
}

void check_places(const CheckFiles& files) {
    std::set<std::string> seen;
    for (const auto& [command, file] : files) {
        if (file.empty())
            continue;
        const std::string start = "--" + command + ": ";
        if (file == "-") {
            check_standard_output(start, command, files);
            continue;
        }
        const bool makes_folder = is_folder(command);
        const fs::path folder = fs::path(file).parent_path();
        std::error_code none;
        if (!folder.empty() && !makes_folder && !fs::is_directory(folder, none)) {
            throw std::runtime_error(start + "there is no folder \"" + folder.string() +
                                     "\" to write \"" + file + "\" into");
        }
        if (!makes_folder && fs::is_directory(file, none))
            throw std::runtime_error(start + "\"" + file + "\" is a folder");
        // Several may go to a device, such as /dev/null, by links to it.
        const std::string place =
            fs::is_other(file, none) ? fs::path(file).lexically_normal().string() : place_of(file);
        if (!seen.insert(place).second)
            throw std::runtime_error(start + "\"" + file + "\" is also another's file");
    }
}

void try_folder(const std::string& folder, const std::string& what) {
    std::error_code none;
    fs::path there = folder;
    while (!fs::exists(there, none) && there.has_relative_path())
        there = there.has_parent_path() ? there.parent_path() : ".";
    if (!fs::is_directory(there, none)) {
        throw std::runtime_error(what + "cannot make the folder \"" + folder + "\": \"" +
                                 there.string() + "\" is a file");
    }
    // A signal between the two calls would leave it there.
    sigset_t ending, before;
    sigemptyset(&ending);
    for (const int number : {SIGINT, SIGTERM, SIGHUP})
        sigaddset(&ending, number);
    ::pthread_sigmask(SIG_BLOCK, &ending, &before);
    const int failure = make_and_remove(there);
    ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
    if (failure != 0) {
        throw std::runtime_error(what + "cannot write into the folder \"" + there.string() +
                                 "\": " + std::strerror(failure));
    }
}

void try_places(const CheckFiles& files) {
    for (const auto& [command, file] : files) {
        if (file.empty() || file == "-")
            continue;
        const std::string start = "--" + command + ": ";
        std::error_code none;
        if (is_folder(command)) {
            try_folder(file, start);
        } else if (!fs::is_other(file, none)) { // a device or pipe is not opened before its time
            if (fs::exists(file, none) && ::access(file.c_str(), W_OK) != 0)
                throw std::runtime_error(start + "cannot write \"" + file +
                                         "\": " + std::strerror(errno));
            try_folder(folder_of(file).string(), start);
        }
    }
}

std::vector<std::string> write_results(const ShotResult& shot, const CheckFiles& files,
                                       bool records, const CaseFiles& images) {
    std::vector<std::string> errors;
    for (const auto& item : files) {
        const std::string& file = item.second;
        const auto text = texts().find(item.first);
        if (item.first == "json")
            attempt(errors, [&] { write_json(shot, file, records); });
        else if (text != texts().end())
            attempt(errors, [&] { write_text(text->second(shot, images), file); });
    }
    return errors;
}

void attempt(std::vector<std::string>& errors, const std::function<void()>& write) {
    try {
        write();
    } catch (const std::exception& problem) {
        errors.emplace_back(problem.what());
    }
}

void write_text(const std::string& text, const std::string& file) {
    if (file == "-") { // errors of the standard output are checked at the program's end
        std::cout << text << std::flush;
        return;
    }
    std::string why;
    if (!write_bytes(text, file, why))
        throw std::runtime_error(why);
}

} // namespace tonetool::sequence
