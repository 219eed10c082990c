// SPDX-License-Identifier: BSD-3-Clause
#include "runs/stack_of_files.h"

#include <algorithm>
#include <deque>
#include <utility>

#include "chain/session/call.h"
#include "chain/session/stack.h"
#include "text/error.h"

namespace tonetool::runs {

namespace {

using chain::Call;
using chain::Group;
using chain::Word;

// Outputs and measurements leave the images as they are.
bool only_looks(const Word& word) {
    const Group group = word.row->group;
    return group == Group::Write || group == Group::Print || group == Group::Measure;
}

class Follower {
public:
    Follower(const chain::ParsedLine& line, const CheckPlan& check,
             const std::function<void(const StackedCommand&)>& visit)
        : m_line(line),
          m_check(check),
          m_visit(visit) {}

    Followed follow() {
        const auto& words = m_line.words;
        const bool known =
            std::all_of(words.begin(), words.end(), [&](const Word& word) { return take(word); });
        m_found.all = known && m_waiting.empty();
        if (known && !m_waiting.empty()) {
            const Word& word = *m_waiting.front();
            const Call call(*word.row, word.token, {});
            m_found.command = word.row->label();
            m_found.mistake = chain::too_few_images(size_t(call.pops()), m_stack.size(), m_taken);
        }
        return m_found;
    }

private:
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
        m_stack.push_back({file ? std::optional(at) : std::nullopt});
        if (file)
            m_found.files.push_back(at);
    }

    bool run_waiting() {
        while (!m_waiting.empty()) {
            const Word& word = *m_waiting.front();
            const Call call(*word.row, word.token, {});
            int pops = 0;
            try {
                pops = call.pops();
            } catch (const CommandError& problem) { // tests=0
                m_found.command = word.row->label();
                m_found.mistake = problem.what();
                return false;
            }
            if (pops > int(m_stack.size()))
                return true;
            m_waiting.pop_front();
            if (!run(word, size_t(std::max(pops, 0)), call.pushes()))
                return false;
        }
        return true;
    }

    bool run(const Word& word, size_t pops, int pushes) {
        m_visit({word, m_stack, pops});
        if (pushes == chain::kAnyNumber)
            return only_looks(word) && pops == 0;
        const auto taken = m_stack.end() - std::ptrdiff_t(pops);
        if (word.is("swap"))
            std::swap(taken[0], taken[1]);
        else if (!only_looks(word)) // what is made of an image counts as that image
            for (auto image = taken; image != m_stack.end(); ++image)
                image->unchanged = false;
        if (pushes == int(pops))
            return true;
        m_taken |= pops > 0;
        m_stack.resize(m_stack.size() - pops);
        m_stack.resize(m_stack.size() + size_t(pushes), {std::nullopt, false});
        return true;
    }

    const chain::ParsedLine& m_line;
    const CheckPlan& m_check;
    const std::function<void(const StackedCommand&)>& m_visit;
    Followed m_found;
    std::vector<StackedImage> m_stack;
    bool m_taken = false;
    std::deque<const Word*> m_waiting;
};

} // namespace

Followed follow_stack(const chain::ParsedLine& line, const CheckPlan& check,
                      const std::function<void(const StackedCommand&)>& visit) {
    return Follower(line, check, visit).follow();
}

} // namespace tonetool::runs
