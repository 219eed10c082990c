// SPDX-License-Identifier: BSD-3-Clause
#include "runs/uncompared.h"

#include <algorithm>
#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <utility>

#include "chain/session/call.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

namespace fs = std::filesystem;
using chain::Call;
using chain::Group;
using chain::Word;

// Runs the numbers of images that commands take and leave.
class Rundown {
public:
    Rundown(const chain::ParsedLine& line, const CheckPlan& check) : m_line(line), m_check(check) {}

    Reading reading() {
        for (const Word& word : m_line.words)
            if (!take(word))
                return {};
        if (!m_waiting.empty())
            return {};
        m_reading.certain = true;
        for (const size_t at : m_read)
            if (std::find(m_used.begin(), m_used.end(), at) == m_used.end())
                m_reading.unused.push_back(at);
        return m_reading;
    }

private:
    // The place of an image's file; nullopt for what a command has made or a label names.
    using Slot = std::optional<size_t>;

    // An expression may look at an image.
    bool is_plain(const Word& word) const {
        for (size_t at = word.at; at < word.end(); ++at) {
            const std::string& text = m_line.texts[at];
            const size_t brace = text.find('{');
            if (brace != std::string::npos && text.find('.', brace) != std::string::npos &&
                text.find("FRAME_NUMBER", brace) != brace + 1)
                return false;
        }
        return true;
    }

    bool take(const Word& word) {
        if (!is_plain(word))
            return false;
        if (!word.row) {
            if (!word.token.is_command)
                push(word.at);
            return !word.token.is_command && run_waiting();
        }
        if (word.row->control || !word.missing.empty())
            return false;
        if (word.is("i")) {
            push(word.arguments.empty() ? word.at : word.arguments.front());
            return run_waiting();
        }
        m_waiting.push_back(&word);
        return run_waiting();
    }

    void push(size_t at) {
        const bool file = m_check.is_input(at);
        m_stack.push_back(file ? Slot(at) : std::nullopt);
        if (file)
            m_read.push_back(at);
    }

    bool run_waiting() {
        while (!m_waiting.empty()) {
            const Word& word = *m_waiting.front();
            const Call call(*word.row, word.token, {});
            const int pops = call.pops();
            if (pops > int(m_stack.size()))
                return true;
            m_waiting.pop_front();
            if (!run(word, size_t(std::max(pops, 0)), call.pushes()))
                return false;
        }
        return true;
    }

    void use(size_t count) {
        for (size_t i = m_stack.size() - std::min(count, m_stack.size()); i < m_stack.size(); ++i)
            if (m_stack[i])
                m_used.push_back(*m_stack[i]);
    }

    bool run(const Word& word, size_t pops, int pushes) {
        const bool looks = word.row->group == Group::Write || word.row->group == Group::Print;
        use(word.row->takes_all ? m_stack.size() : std::max<size_t>(pops, looks ? 1 : 0));
        if (word.row->group == Group::Compare && pops >= 2)
            note_sides(pops);
        if (pushes == chain::kAnyNumber)
            return looks && pops == 0; // an output leaves the images as they are
        if (word.is("swap"))
            std::swap(m_stack[m_stack.size() - 1], m_stack[m_stack.size() - 2]);
        if (pushes == int(pops)) // what is made of an image counts as that image
            return true;
        m_stack.resize(m_stack.size() - pops);
        m_stack.resize(m_stack.size() + size_t(pushes));
        return true;
    }

    void note_sides(size_t pops) {
        const size_t first = m_stack.size() - pops;
        for (size_t i = first; i < m_stack.size(); ++i)
            if (m_stack[i])
                (i == first ? m_reading.references : m_reading.tests).push_back(*m_stack[i]);
    }

    const chain::ParsedLine& m_line;
    const CheckPlan& m_check;
    Reading m_reading;
    std::vector<Slot> m_stack;
    std::deque<const Word*> m_waiting;
    std::vector<size_t> m_read, m_used;
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
        return Rundown(line, check).reading();
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
