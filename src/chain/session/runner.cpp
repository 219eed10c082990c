// SPDX-License-Identifier: BSD-3-Clause
#include "chain/session/runner.h"

#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <cstring>
#include <new>
#include <ostream>

#include "chain/session/execute.h"
#include "chain/session/expression.h"
#include "chain/session/io.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// What messages call a command.
std::string name_in_messages(const Call& call, bool compat) {
    return !compat ? call.row().label() : call.operation().empty() ? call.text() : call.operation();
}

} // namespace

void Runner::run_all() {
    Flow& flow = m_session.flow;
    // --no-error-exit is one of the words; oiiotool's own stops all the same.
    const auto stops = [this] {
        return m_session.outcome.aborted &&
               (m_session.settings.compat || m_session.settings.error_exit);
    };
    while (flow.next < m_words.size() && !m_ended && !stops()) {
        m_where.clear();
        guarded(&Runner::run_word);
    }
    m_where.clear();
    if (!m_session.outcome.aborted && !m_ended)
        guarded(&Runner::finish);
    if (m_session.settings.runstats)
        print_statistics();
}

void Runner::guarded(void (Runner::*step)()) {
    try {
        (this->*step)();
    } catch (const std::bad_alloc&) {
        m_session.error(m_where, "not enough memory");
    } catch (const ReadError& problem) {
        m_session.error(m_session.settings.compat ? "read" : m_where,
                        m_session.settings.compat ? problem.why : problem.what());
    } catch (const EndOfRun&) {
        m_ended = true;
    } catch (const UsageError& problem) {
        ++m_session.outcome.errors;
        m_session.outcome.aborted = m_session.outcome.misused = true;
        m_session.complaints() << problem.what() << "\n\nFull command line was:\n> "
                               << m_session.command_line << std::endl;
    } catch (const CommandError& problem) {
        const bool renamed = m_session.settings.compat && !problem.place.empty();
        m_session.error(renamed ? problem.place : m_where, problem.what());
        if (m_session.settings.compat && problem.again)
            m_session.error(m_where, "");
    } catch (const std::exception& problem) {
        m_session.error(m_where, problem.what());
    } catch (...) {
        m_session.error(m_where, "unknown error");
    }
}

void Runner::run_word() {
    Flow& flow = m_session.flow;
    count_word();
    const std::string& raw = m_words[flow.next];
    flow.command = flow.next++;
    m_where = raw.substr(0, raw.find(':'));
    const std::string text = flow.running() ? evaluated(flow.command) : raw;
    Word word = parse_word(m_words, flow.command, text, m_session.settings.compat);
    flow.next = word.end();
    note_varying(flow.command);
    if (word.token.is_command)
        run_command_word(std::move(word));
    else
        run_file(text);
}

void Runner::run_command_word(Word word) {
    const bool strict = !m_session.settings.compat || (word.row && word.row->own);
    if (strict && !word.token.problem.empty())
        throw CommandError(word.token.problem);
    const Command& row = known(word);
    m_where = m_session.settings.compat ? word.token.text : row.label();
    check_policy(Call(row, word.token, {}, m_session.settings.compat));
    Strings arguments = arguments_of(word);
    locate_files(m_session, row, word.token, arguments);
    if (m_session.flow.running() || row.control) {
        Call call(row, std::move(word.token), std::move(arguments), m_session.settings.compat);
        call.at = m_session.flow.command;
        for (const std::string& modifier : call.dropped()) {
            m_session.warning(m_where, "\"" + modifier +
                                           "\" is no modifier of this command, it has "
                                           "no effect");
        }
        run_or_postpone(std::move(call));
    }
    run_postponed();
}

void Runner::count_word() {
    if (m_session.policy.max_words > 0 && ++m_count > m_session.policy.max_words) {
        throw CommandError("stopped after " + std::to_string(m_session.policy.max_words) +
                           " words, loops included");
    }
}

void Runner::check_policy(const Call& call) const {
    if (!m_session.policy.read_only)
        return;
    if (call.row().outlives_chain()) {
        throw CommandError(std::string("not allowed here: it ") +
                           (call.row().writes() ? "writes a file" : "sets up the whole process") +
                           ", and this chain is only run for its images");
    }
    for (const Modifier& modifier : call.row().modifiers) {
        if (modifier.writes() && call.has(modifier.key)) {
            throw CommandError("modifier \"" + modifier.key +
                               "\" is not allowed here: it writes files, and this chain is only "
                               "run for its images");
        }
    }
}

void Runner::run_file(const std::string& word) {
    if (m_session.flow.running()) {
        m_where = "read";
        OIIO::Timer time;
        double& seconds = m_session.outcome.seconds["-i"];
        const bool from_file = m_session.stack.labels.count(word) == 0;
        push_file_or_label(m_session, word);
        seconds += time();
        if (from_file)
            mark_frames(*m_session.stack.top());
        run_postponed();
    }
}

const Command& Runner::known(const Word& word) {
    const Command* row = word.row;
    const Token& token = word.token;
    // "--hdrflip=fail=1": a check that looks at no threshold would pass.
    const bool takes_value = row && !row->args.empty() && std::strchr("=[", row->args[0].front());
    if (row && !token.value.empty() && !takes_value && !m_session.settings.compat) {
        m_where = row->label();
        throw CommandError("takes no \"=" + token.value[0] + "\" (modifiers follow a colon)");
    }
    if (!row && m_session.settings.compat) {
        const std::string near = nearest_command(token.name);
        throw UsageError("Invalid option \"" + token.text + "\"" +
                         (near.empty() ? "" : " (did you mean " + near + "?)"));
    }
    if (!row) {
        m_where.clear();
        throw CommandError("unknown command \"" + token.text + "\", " +
                           suggest_command(token.name));
    }
    return *row;
}

void Runner::refuse_missing_argument(const Word& word) const {
    const bool at_end = word.end() >= m_words.size();
    if (at_end && m_session.settings.compat) {
        const size_t given = word.token.value.size() + word.arguments.size();
        const std::string label = word.row->label();
        throw UsageError("Missing parameter " + std::to_string(given + 1) + " from option \"" +
                         (label[0] == '-' ? "" : "--") + label + "\"");
    }
    const std::string next = at_end ? "" : m_words[word.end()];
    throw CommandError(
        "missing argument " + word.missing +
        (at_end ? ""
                : ", \"" + next + "\" is a command (a file of that name is \"./" + next + "\")"));
}

// Outputs of checks were taken from the command line as they are, before it ran.
Strings Runner::arguments_of(const Word& word) const {
    if (!word.missing.empty())
        refuse_missing_argument(word);
    const bool runs = m_session.flow.running() && word.row->group != Group::Check;
    Strings arguments = word.token.value;
    for (size_t at : word.arguments)
        arguments.push_back(runs ? evaluated(at) : m_words[at]);
    return arguments;
}

// A waiting operator's image must not be changed under it.
void Runner::refuse_to_overtake(const Call& call) const {
    if (call.pops() > 0 && !m_postponed.empty() && !m_session.settings.compat) {
        throw CommandError("--" + m_session.stack.waiting +
                           " still waits for an image, so this would not work on its result");
    }
}

bool Runner::is_found_name(size_t at) const {
    const std::vector<size_t>& found = m_session.frame.found;
    return std::find(found.begin(), found.end(), at) != found.end();
}

// Of a name that was found on the disk nothing is an expression.
std::string Runner::evaluated(size_t at) const {
    return is_found_name(at) ? m_words[at] : with_values(m_session, m_words[at]);
}

void Runner::note_varying(size_t begin) {
    const Frame& frame = m_session.frame;
    const auto is_one_of = [](const std::vector<size_t>& places, size_t at) {
        return std::find(places.begin(), places.end(), at) != places.end();
    };
    m_varies = !frame.loops;
    m_still = is_one_of(frame.stills, begin);
    for (size_t at = begin; at < m_session.flow.next && !m_varies; ++at) {
        m_varies = m_words[at].find('{') != std::string::npos || is_one_of(frame.varying, at);
        m_still |= is_one_of(frame.stills, at);
    }
}

// Against a sequence it is a slip as often as it is meant: what is meant has to be said. And what
// is compared once is not to be counted as a comparison of each frame.
void Runner::refuse_the_same_in_all_frames(const Call& call) const {
    if (!m_session.judges || m_varies || call.row().group != Group::Compare)
        return;
    const std::vector<ImagePtr> images = m_session.stack.top(size_t(call.pops()));
    for (const ImagePtr& image : images) {
        if (image->same_in_all_frames && !image->meant_for_all_frames) {
            throw CommandError("\"" + image->name() +
                               "\" has no wildcard, it is the same in every frame "
                               "(valid: # in its name; of a still that is meant for all frames: "
                               "--wildcardoff " +
                               image->name() + " --wildcardon)");
        }
    }
    if (!images.empty() && std::all_of(images.begin(), images.end(), [](const ImagePtr& image) {
            return image->same_in_all_frames;
        })) {
        throw CommandError("\"" + images.front()->name() + "\" and \"" + images.back()->name() +
                           "\" are the same in every frame, so this would be one comparison that "
                           "counts for each (valid: one of them with # in its name, or another "
                           "command line for the two)");
    }
}

// Of an image that was just read.
void Runner::mark_frames(Image& image) const {
    image.same_in_all_frames = !m_varies;
    image.meant_for_all_frames = m_still;
}

// What the call has pushed, from `first` on.
void Runner::mark_pushed(const Call& call, size_t first) const {
    const auto& popped = call.images;
    const auto all = [&](bool Image::*is) {
        return !m_varies && !popped.empty() &&
               std::all_of(popped.begin(), popped.end(),
                           [is](const ImagePtr& image) { return (*image).*is; });
    };
    const bool measured = call.row().group == Group::Compare || call.row().group == Group::Measure;
    for (size_t i = first; i < m_session.stack.images.size(); ++i) {
        const ImagePtr& image = m_session.stack.images[i];
        if (std::find(popped.begin(), popped.end(), image) != popped.end())
            continue;
        if (call.row().group == Group::Read) {
            mark_frames(*image);
        } else {
            image->same_in_all_frames = all(&Image::same_in_all_frames);
            image->meant_for_all_frames = all(&Image::meant_for_all_frames);
        }
        image->is_result = call.row().group == Group::Compare ||
                           std::any_of(popped.begin(), popped.end(),
                                       [](const ImagePtr& from) { return from->is_result; });
        image->worked_on |= measured || image->is_result;
    }
}

void Runner::run_or_postpone(Call call) {
    if (enough_images(call)) {
        refuse_to_overtake(call);
        run_call(call);
        return;
    }
    if (!call.row().postponable)
        throw CommandError(m_session.stack.lacks(call.pops()));
    if (m_session.settings.compat) // as oiiotool, which has room for one
        m_postponed.clear();
    m_postponed.push_back(std::move(call));
    m_session.stack.waiting = m_postponed.front().row().label();
}

void Runner::run_call(Call& call) {
    m_where = name_in_messages(call, m_session.settings.compat);
    const bool told = m_session.settings.debug && call.pops() > 0;
    if (told) {
        m_session.print("Performing '-" + call.row().names.front() +
                        (call.has_argument(0) ? "' with args:  " : "' ") + call.quoted_words());
    }
    refuse_the_same_in_all_frames(call);
    OIIO::Timer time;
    const size_t first = m_session.stack.images.size() - size_t(call.pops());
    execute(m_session, call);
    mark_pushed(call, first);
    if (call.row().group != Group::General && call.row().group != Group::Control)
        m_session.outcome.seconds["-" + call.row().names.front()] += time();
    if (told) {
        m_session.print(OIIO::Strutil::fmt::format(
            "    -{} took {:.2f}s  (total time {:.2f}s, mem {})", call.row().names.front(), time(),
            m_time(), OIIO::Strutil::memformat(OIIO::Sysutil::memory_used())));
    }
}

void Runner::run_postponed() {
    while (!m_postponed.empty() && enough_images(m_postponed.front())) {
        Call call = std::move(m_postponed.front());
        m_postponed.pop_front();
        m_session.stack.waiting = m_postponed.empty() ? "" : m_postponed.front().row().label();
        run_call(call);
    }
}

} // namespace tonetool::chain
