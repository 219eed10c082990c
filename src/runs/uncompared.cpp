// SPDX-License-Identifier: BSD-3-Clause
#include "runs/uncompared.h"

#include <algorithm>
#include <filesystem>
#include <map>

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

// "refs/%N.exr" for "refs/a.exr".
std::string named_like(const std::string& file) {
    const fs::path path = file;
    return (path.parent_path() / ("%N" + path.extension().string())).string();
}

// The most frequent extension of the files in a folder; of several, the first.
std::string usual_extension(const std::string& folder) {
    std::map<std::string, size_t> counts;
    std::error_code why;
    for (fs::directory_iterator entry(folder, why), end; !why && entry != end; entry.increment(why))
        if (const std::string extension = entry->path().extension().string(); !extension.empty())
            ++counts[extension];
    const auto most =
        std::max_element(counts.begin(), counts.end(),
                         [](const auto& a, const auto& b) { return a.second < b.second; });
    return most == counts.end() ? ".exr" : most->first;
}

void refuse_folder(const std::string& word) {
    std::error_code none;
    if (!fs::is_directory(word, none))
        return;
    const std::string name =
        word.size() > 1 && word.back() == '/' ? word.substr(0, word.size() - 1) : word;
    throw CommandError(name + " is a folder: write " + name + "/%N" + usual_extension(word));
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
    throw CommandError(unused.size() == 1
                           ? "\"" + first +
                                 "\" was never compared (valid: names with # for "
                                 "sequences, tests=K for K tests of one reference, or --pop)"
                           : std::to_string(unused.size()) +
                                 " images were read and never compared; for named images write '" +
                                 named_like(first) + "'");
}

} // namespace tonetool::runs
