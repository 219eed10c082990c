// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with a command line before it runs.
#include "chain/session/runner.h"
#include "text/error.h"

namespace tonetool::chain {

void Runner::check_all() {
    while (m_session.flow.next < m_words.size() && m_session.outcome.errors == 0) {
        m_where.clear();
        guarded(&Runner::check_word);
    }
}

// A word with an expression in it is another one in each frame, and in a block one that may not run
// at all.
void Runner::check_word() {
    Flow& flow = m_session.flow;
    flow.command = flow.next++;
    const std::string& text = m_words[flow.command];
    Word word = parse_word(m_words, flow.command, text, false);
    flow.next = word.end();
    if (!word.token.is_command || text.find('{') != std::string::npos)
        return;
    m_where = text.substr(0, text.find(':'));
    if (!word.token.problem.empty())
        throw CommandError(word.token.problem);
    const Command& row = known(word);
    m_where = row.label();
    if (!word.missing.empty())
        refuse_missing_argument(word);
    if (row.control && !word.is("else"))
        m_depth += row.names.front().compare(0, 3, "end") == 0 ? -1 : 1;
    const Call call(row, std::move(word.token), {});
    if (row.check && m_depth == 0)
        row.check(m_session, call);
}

} // namespace tonetool::chain
