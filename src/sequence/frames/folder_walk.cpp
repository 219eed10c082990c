// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/folder_walk.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <sys/stat.h>
#include <utility>

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;

class FolderWalk {
public:
    FolderWalk(std::string folder, size_t depth, std::string pattern)
        : m_folder(std::move(folder)),
          m_depth(depth),
          m_pattern(std::move(pattern)) {}

    std::vector<std::string> files() {
        visit("", 0);
        while (!m_links.empty()) { // when all folders have been seen by their own paths
            const std::string link = *m_links.begin();
            m_links.erase(m_links.begin());
            visit(link + "/", size_t(std::count(link.begin(), link.end(), '/')) + 1);
        }
        std::sort(m_files.begin(), m_files.end());
        return std::move(m_files);
    }

private:
    bool is_new(const std::string& place) {
        struct stat facts {};
        return ::stat(place.c_str(), &facts) == 0 &&
               m_seen.emplace(facts.st_dev, facts.st_ino).second;
    }

    void visit(const std::string& below, size_t depth) {
        const std::string place = m_folder + below;
        std::error_code problem;
        if (!fs::is_directory(place, problem) || !is_new(place))
            return;
        std::vector<std::string> folders;
        for (fs::directory_iterator entry(place, problem), end; !problem && entry != end;
             entry.increment(problem))
            take(*entry, below, folders);
        if (problem) {
            throw std::runtime_error("cannot list the folder \"" + place + "\" of \"" + m_pattern +
                                     "\": " + problem.message());
        }
        for (const std::string& folder : folders)
            if (depth < m_depth)
                visit(folder + "/", depth + 1);
    }

    void take(const fs::directory_entry& entry, const std::string& below,
              std::vector<std::string>& folders) {
        const std::string name = entry.path().filename().string();
        std::error_code none;
        if (name.front() == '.')
            return;
        if (!entry.is_directory(none))
            m_files.push_back(below + name); // also a link that leads nowhere: it is missing
        else if (!entry.is_symlink(none))
            folders.push_back(below + name);
        else if (size_t(std::count(below.begin(), below.end(), '/')) < m_depth)
            m_links.insert(below + name);
    }

    std::string m_folder;
    size_t m_depth;
    std::string m_pattern;
    std::vector<std::string> m_files;
    std::set<std::string> m_links;
    std::set<std::pair<dev_t, ino_t>> m_seen;
};

} // namespace

std::vector<std::string> files_below(const std::string& folder, size_t depth,
                                     const std::string& pattern) {
    return FolderWalk(folder.empty() ? "./" : folder, depth, pattern).files();
}

} // namespace tonetool::sequence
