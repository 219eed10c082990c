// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/part_files.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <glob.h>
#include <iostream>
#include <iterator>
#include <sstream>
#include <stdexcept>

#include "sequence/results/shot_exposures.h"

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

std::vector<std::string> in_folder(const std::string& folder) {
    std::vector<std::string> files;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
        const fs::path& path = entry.path();
        std::error_code none;
        if (!OIIO::Strutil::iends_with(path.filename().string(), ".json") ||
            path.filename().string().front() == '.')
            continue;
        // A part that is left out is frames that nobody misses.
        if (!entry.is_regular_file(none))
            throw std::runtime_error("\"" + path.string() + "\" is no file that can be read");
        files.push_back(path.string());
    }
    std::sort(files.begin(), files.end());
    if (files.empty())
        throw std::runtime_error("no *.json in the folder \"" + folder + "\"");
    return files;
}

std::vector<std::string> fitting(const std::string& pattern) {
    glob_t found{};
    std::vector<std::string> files;
    if (::glob(pattern.c_str(), 0, nullptr, &found) == 0)
        files.assign(found.gl_pathv, found.gl_pathv + found.gl_pathc);
    ::globfree(&found);
    if (files.empty())
        throw std::runtime_error("no file matches \"" + pattern + "\"");
    return files;
}

} // namespace

std::vector<std::string> part_files(const std::vector<std::string>& words) {
    std::vector<std::string> files;
    for (const std::string& word : words) {
        std::error_code none;
        std::vector<std::string> some{word};
        if (fs::is_directory(word, none))
            some = in_folder(word);
        else if (!fs::exists(word, none) && word.find_first_of("*?") != std::string::npos)
            some = fitting(word);
        std::move(some.begin(), some.end(), std::back_inserter(files));
    }
    return files;
}

std::vector<std::string> lines_of(const std::string& file) {
    std::istringstream text(file == "-" ? std::string(std::istreambuf_iterator<char>(std::cin), {})
                                        : read_text(file));
    std::vector<std::string> lines;
    for (std::string line; std::getline(text, line);) {
        if (!line.empty() && line.back() == '\r')
            line.pop_back();
        if (!line.empty())
            lines.push_back(line);
    }
    return lines;
}

} // namespace tonetool::sequence
