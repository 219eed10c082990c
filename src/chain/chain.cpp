#include "chain/chain.h"

#include <deque>
#include <exception>
#include <new>
#include <ostream>

#include "chain/call.h"
#include "chain/error.h"
#include "chain/help.h"
#include "chain/io.h"
#include "chain/session.h"

namespace tonetool::chain {

namespace {

class Runner {
public:
    Runner(Session& session, const Strings& words) : m_session(session), m_words(words) {}

    void run_all() {
        while (m_next < m_words.size()) {
            m_where.clear();
            run_word(m_words[m_next++]);
            run_postponed();
        }
        finish();
    }

    /// The command that an error belongs to.
    const std::string& where() const { return m_where; }

private:
    void run_word(const std::string& word);
    Call make_call(const Command& row, Token token);
    void take_arguments(const Command& row, Strings& arguments);
    bool enough_images(const Call& call) const {
        return static_cast<size_t>(call.pops()) <= m_session.stack.size();
    }
    void refuse_to_overtake(const Call& call) const;
    void run_or_postpone(Call call);
    void run_call(Call& call);
    void run_postponed();
    void warn_of_unused();
    void finish();

    Session& m_session;
    const Strings& m_words;
    size_t m_next = 0;
    std::string m_where;
    std::deque<Call> m_postponed;
};

void Runner::run_word(const std::string& word) {
    m_where = word.substr(0, word.find(':'));
    Token token = parse_token(word);
    if (!token.is_command) {
        m_where = "read";
        push_file_or_label(m_session, word);
        return;
    }
    const Command* row = find_command(token.name);
    if (!row) {
        m_where.clear();
        throw CommandError("unknown command \"" + word + "\", " + suggest_command(token.name));
    }
    m_where = row->label();
    run_or_postpone(make_call(*row, std::move(token)));
}

// An argument that is itself a command was forgotten, not meant.
void Runner::take_arguments(const Command& row, Strings& arguments) {
    for (const std::string& name : row.args) {
        bool optional = name.front() == '[';
        if (m_next >= m_words.size()) {
            if (!optional) {
                throw CommandError("missing argument " + name);
            }
            return;
        }
        const std::string& word = m_words[m_next];
        bool dashed = word.size() > 1 && word[0] == '-' && !parse_number(word);
        if (!optional && dashed) {
            std::string bare = word.substr(word[1] == '-' ? 2 : 1);
            if (find_command(bare.substr(0, bare.find(':')))) {
                throw CommandError("missing argument " + name + ", \"" + word +
                                   "\" is a command (a file of that name is \"./" + word + "\")");
            }
        }
        arguments.push_back(word);
        ++m_next;
    }
}

Call Runner::make_call(const Command& row, Token token) {
    Strings arguments;
    Call checked(row, token, {});
    take_arguments(row, arguments);
    return Call(row, std::move(token), std::move(arguments));
}

// A waiting operator's image must not be changed under it.
void Runner::refuse_to_overtake(const Call& call) const {
    if (call.pops() > 0 && !m_postponed.empty()) {
        throw CommandError("--" + m_session.waiting +
                           " still waits for an image, so this would "
                           "not work on its result");
    }
}

void Runner::run_or_postpone(Call call) {
    if (enough_images(call)) {
        refuse_to_overtake(call);
        run_call(call);
        return;
    }
    if (!call.row().postponable) {
        throw CommandError("needs " + std::to_string(call.pops()) + " image(s), the stack has " +
                           std::to_string(m_session.stack.size()));
    }
    m_postponed.push_back(std::move(call));
    m_session.waiting = m_postponed.front().row().label();
}

void Runner::run_call(Call& call) {
    m_where = call.row().label();
    std::vector<ImagePtr>& stack = m_session.stack;
    auto first = stack.end() - call.pops();
    call.images.assign(first, stack.end());
    stack.erase(first, stack.end());
    for (const ImagePtr& image : call.images) {
        image->used = true;
    }
    size_t expected = stack.size() + static_cast<size_t>(call.pushes());
    call.row().run(m_session, call);
    if (call.pushes() != any_number && stack.size() != expected) {
        throw CommandError("internal error: wrong number of images on the stack");
    }
}

void Runner::run_postponed() {
    while (!m_postponed.empty() && enough_images(m_postponed.front())) {
        Call call = std::move(m_postponed.front());
        m_postponed.pop_front();
        m_session.waiting = m_postponed.empty() ? "" : m_postponed.front().row().label();
        run_call(call);
    }
}

// "ref a b --hdrflip" compares a with b: the forgotten tests=2 must not go unnoticed.
void Runner::warn_of_unused() {
    const bool listing = m_session.info || m_session.stats;
    for (const ImagePtr& image : m_session.stack) {
        if (!listing && !image->used && image->part().from_file()) {
            m_session.warning("", "\"" + image->name() + "\" was read, but no command used it");
        }
    }
}

void Runner::finish() {
    if (!m_postponed.empty()) {
        const Call& call = m_postponed.front();
        m_where = call.row().label();
        throw CommandError("never executed: needs " + std::to_string(call.pops()) +
                           " image(s), the stack has " + std::to_string(m_session.stack.size()));
    }
    m_where.clear();
    check_outputs(m_session);
    warn_of_unused();
    if (!m_session.produced) {
        throw CommandError("produced no output. Did you forget -o?");
    }
}

void run_guarded(Runner& runner, Session& session) {
    try {
        runner.run_all();
    } catch (const std::bad_alloc&) {
        session.error(runner.where(), "not enough memory");
    } catch (const std::exception& problem) {
        session.error(runner.where(), problem.what());
    } catch (...) {
        session.error(runner.where(), "unknown error");
    }
}

std::string full_command_line(const Strings& words) {
    std::string line = "tonetool";
    for (const std::string& word : words) {
        line += " " + shell_quoted(word);
    }
    return line;
}

} // namespace

int run(const Strings& words, std::ostream& out, std::ostream& err) {
    if (words.empty()) {
        err << usage_text();
        return 1;
    }
    Session session(out, err, full_command_line(words));
    Runner runner(session, words);
    run_guarded(runner, session);
    out.flush();
    if (!out) {
        session.error("", "cannot write to the standard output");
    }
    return session.exit_status();
}

} // namespace tonetool::chain
