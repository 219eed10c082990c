// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/check_files.h"

#include <algorithm>
#include <filesystem>
#include <iostream>
#include <set>
#include <stdexcept>
#include <string>

#include "sequence/results/results_json.h"
#include "sequence/results/tables.h"
#include "tonetool/write.h"

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

using Text = std::string (*)(const ShotResult&);

const std::map<std::string, Text>& texts() {
    static const std::map<std::string, Text> all = {
        {"json", [](const ShotResult& shot) { return to_json(shot); }},
        {"csv", csv_text},
        {"junit", junit_text}};
    return all;
}

// Only one text file may go to the standard output.
void check_standard_output(const std::string& start, const std::string& command,
                           const CheckFiles& files) {
    if (texts().count(command) == 0 && command != "statistics" && command != "bad-frames") {
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
        const bool is_folder = command == "state" || command == "pictures";
        const fs::path folder = fs::path(file).parent_path();
        std::error_code none;
        if (!folder.empty() && !is_folder && !fs::is_directory(folder, none)) {
            throw std::runtime_error(start + "there is no folder \"" + folder.string() +
                                     "\" to write \"" + file + "\" into");
        }
        if (!is_folder && fs::is_directory(file, none))
            throw std::runtime_error(start + "\"" + file + "\" is a folder");
        if (!seen.insert(fs::path(file).lexically_normal().string()).second)
            throw std::runtime_error(start + "\"" + file + "\" is also another's file");
    }
}

std::vector<std::string> write_results(const ShotResult& shot, const CheckFiles& files) {
    std::vector<std::string> errors;
    for (const auto& item : files) {
        const std::string& file = item.second;
        const auto text = texts().find(item.first);
        if (text != texts().end())
            attempt(errors, [&] { write_text(text->second(shot), file); });
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
