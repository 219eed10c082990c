// SPDX-License-Identifier: BSD-3-Clause
// Runs the words of one frame's command line from left to right.
#pragma once

#include <OpenImageIO/timer.h>
#include <deque>
#include <string>

#include "chain/language/line.h"
#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

inline constexpr char kNoOutput[] = "oiiotool produced no output. Did you forget -o?";

class Runner {
public:
    Runner(Session& session, const Strings& words) : m_session(session), m_words(words) {}
    /// Whatever goes wrong is in the session afterwards.
    void run_all();
    /// What can be said of the words without an image: unknown commands and modifiers, values that
    /// are not valid. What is wrong first is in the session afterwards.
    void check_all();

private:
    void check_word();
    void check_policy(const Call& call) const;
    void count_word();
    void guarded(void (Runner::*step)());
    void run_word();
    void run_file(const std::string& word);
    void run_command_word(Word word);
    const Command& known(const Word& word);
    [[noreturn]] void refuse_missing_argument(const Word& word) const;
    Strings arguments_of(const Word& word) const;
    bool enough_images(const Call& call) const {
        return static_cast<size_t>(call.pops()) <= m_session.stack.images.size();
    }
    void refuse_to_overtake(const Call& call) const;
    bool is_found_name(size_t at) const;
    std::string evaluated(size_t at) const;
    void note_varying(size_t begin);
    void refuse_the_same_in_all_frames(const Call& call) const;
    void mark_frames(Image& image) const;
    void mark_pushed(const Call& call, size_t first) const;
    void run_or_postpone(Call call);
    void run_call(Call& call);
    void run_postponed();
    void refuse_what_was_not_compared() const;
    void warn_of_unused();
    void finish();
    void finish_leniently();
    void print_statistics();

    Session& m_session;
    const Strings& m_words;
    std::string m_where; ///< the command that an error belongs to
    std::deque<Call> m_postponed;
    bool m_ended = false;
    int m_depth = 0;      ///< of --if, --while and --for, while words are only checked
    bool m_varies = true; ///< the word in hand and its arguments may be others in other frames
    bool m_still = false; ///< they stand behind --wildcardoff
    size_t m_count = 0;   ///< of words that were run
    OIIO::Timer m_time;
};

} // namespace tonetool::chain
