// SPDX-License-Identifier: BSD-3-Clause
#include "runs/uncompared.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "runs/check_end.h"
#include "runs/stack_of_files.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

namespace fs = std::filesystem;
using chain::Group;

// Notes what the commands of a line do with its files.
class Uses {
public:
    void note(const StackedCommand& command) {
        const chain::Command& row = *command.word.row;
        const bool looks = row.group == Group::Write || row.group == Group::Print;
        use(command.stack,
            row.takes_all ? command.stack.size() : std::max<size_t>(command.pops, looks ? 1 : 0));
        if (row.group == Group::Compare && command.pops >= 2)
            note_sides(command.stack, command.pops);
    }

    Reading reading(const Followed& followed) {
        if (!followed.all)
            return {};
        m_reading.certain = true;
        for (const size_t at : followed.files)
            if (std::find(m_used.begin(), m_used.end(), at) == m_used.end())
                m_reading.unused.push_back(at);
        return m_reading;
    }

private:
    void use(const std::vector<StackedImage>& stack, size_t count) {
        for (size_t i = stack.size() - std::min(count, stack.size()); i < stack.size(); ++i)
            if (stack[i].file)
                m_used.push_back(*stack[i].file);
    }

    void note_sides(const std::vector<StackedImage>& stack, size_t pops) {
        const size_t first = stack.size() - pops;
        for (size_t i = first; i < stack.size(); ++i)
            if (stack[i].file)
                (i == first ? m_reading.references : m_reading.tests).push_back(*stack[i].file);
    }

    Reading m_reading;
    std::vector<size_t> m_used;
};

// The pattern of files like this one: "refs/%N.exr" for "refs/a.exr", and "refs/a.#.exr" for
// "refs/a.0001.exr" if another file differs from it in the number alone.
std::string pattern_like(const std::string& file, const std::vector<std::string>& others) {
    const fs::path path = file;
    const std::string stem = path.stem().string(), ending = path.extension().string();
    const size_t last = stem.find_last_of("0123456789") + 1;
    const size_t begin = last == 0 ? 0 : stem.find_last_not_of("0123456789", last - 1) + 1;
    const std::string before = stem.substr(0, begin), after = stem.substr(last) + ending;
    const bool numbered =
        last > 0 && std::any_of(others.begin(), others.end(), [&](const auto& one) {
            const std::string name = fs::path(one).filename().string();
            const size_t digits = name.size() - std::min(name.size(), before.size() + after.size());
            return digits > 0 && name != path.filename() && name.compare(0, begin, before) == 0 &&
                   name.compare(begin + digits, std::string::npos, after) == 0 &&
                   name.find_first_not_of("0123456789", begin) == begin + digits;
        });
    const size_t width = last - begin;
    const std::string number = width == 4 ? "#"
                               : width > 1 && stem[begin] == '0'
                                   ? "%0" + std::to_string(width) + "d"
                                   : "@";
    return (path.parent_path() / (numbered ? before + number + after : "%N" + ending)).string();
}

// The files of the most frequent extension in a folder, in the order of their names.
std::vector<std::string> usual_files(const std::string& folder) {
    std::map<std::string, std::vector<std::string>> files;
    std::error_code why;
    for (fs::directory_iterator entry(folder, why), end; !why && entry != end; entry.increment(why))
        if (const std::string extension = entry->path().extension().string(); !extension.empty())
            files[extension].push_back(entry->path().string());
    const auto most =
        std::max_element(files.begin(), files.end(), [](const auto& a, const auto& b) {
            return a.second.size() < b.second.size();
        });
    if (most == files.end())
        return {};
    std::sort(most->second.begin(), most->second.end());
    return most->second;
}

void refuse_folder(const std::string& word) {
    std::error_code none;
    if (!fs::is_directory(word, none))
        return;
    const std::string name =
        word.size() > 1 && word.back() == '/' ? word.substr(0, word.size() - 1) : word;
    const auto files = usual_files(word);
    throw CommandError(
        name + " is a folder: write " +
        (files.empty()
             ? name + "/%N.exr"
             : name + "/" + fs::path(pattern_like(files.front(), files)).filename().string()));
}

// A recipe has a ? before its values.
void refuse_shell_wildcard(const std::string& word) {
    std::error_code none;
    const size_t question = word.find('?');
    if (word.find_first_of("*?[") == std::string::npos || fs::exists(word, none) ||
        (question != std::string::npos && fs::is_regular_file(word.substr(0, question), none)))
        return;
    const size_t at = word.find_first_of("*?[");
    const size_t end = word[at] == '[' ? word.find(']', at) : at;
    if (end != std::string::npos) {
        throw CommandError("\"" + word.substr(at, end - at + 1) + "\" in \"" + word +
                           "\" is no wildcard here: names are %N, frames #");
    }
}

} // namespace

Reading reading_of(const chain::ParsedLine& line, const CheckPlan& check) {
    try {
        Uses uses;
        const auto note = [&](const StackedCommand& command) { uses.note(command); };
        return uses.reading(follow_stack(line, check, note));
    } catch (const std::exception&) {
        return {}; // what is wrong is told when the command runs
    }
}

void refuse_uncompared(const chain::ParsedLine& line, const CheckPlan& check) {
    if (line.compat || check.has("merge") || !(check.judges() || check.compares))
        return;
    for (const size_t at : check.inputs) {
        refuse_folder(line.texts[at]);
        refuse_shell_wildcard(line.texts[at]);
    }
    const std::vector<size_t> unused =
        check.judges() ? reading_of(line, check).unused : std::vector<size_t>();
    if (unused.empty())
        return;
    const std::string& first = line.texts[unused.front()];
    const Strings names = words_at(line.texts, unused);
    throw CommandError(unused.size() == 1
                           ? "\"" + first +
                                 "\" was never compared (valid: names with # for "
                                 "sequences, tests=K for K tests of one reference, or --pop)"
                           : std::to_string(unused.size()) +
                                 " images were read and never compared; for all of them write '" +
                                 pattern_like(first, names) + "'");
}

} // namespace tonetool::runs
