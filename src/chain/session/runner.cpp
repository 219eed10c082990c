#include "chain/session/runner.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <cstring>
#include <new>
#include <ostream>

#include "chain/session/ancestry.h"
#include "chain/session/expression.h"
#include "chain/session/io.h"
#include "chain/session/ops.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

// OpenImageIO ends the process where these get depth samples.
void refuse_deep(const Session& session, const Call& call) {
    static const Strings flat_only = {"resample",   "transpose", "fft",      "maxchan",
                                      "minchan",    "chsum",     "colormap", "colorcount",
                                      "rangecheck", "pdiff"};
    const std::string& name = call.row().names.front();
    if (std::find(flat_only.begin(), flat_only.end(), name) == flat_only.end())
        return;
    for (const ImagePtr& image : call.images) {
        const Chosen chosen = chosen_subimages(session, call, *image);
        for (size_t s = 0; s < chosen.count; ++s) {
            if (chosen.active[s] && image->part(s).header().deep) {
                throw CommandError(session.compat ? "deep images not supported"
                                                  : "\"" + image->name() +
                                                        "\" is deep, which this command cannot use "
                                                        "(--flatten makes it flat)");
            }
        }
    }
}

void execute(Session& session, Call& call) {
    std::vector<ImagePtr>& stack = session.stack;
    auto first = stack.end() - call.pops();
    call.images.assign(first, stack.end());
    stack.erase(first, stack.end());
    for (const ImagePtr& image : call.images) {
        image->used = true;
        image->worked_on |= call.row().group != Group::Stack && call.row().group != Group::Print;
        if (call.row().group != Group::Stack)
            session.note_format(*image);
    }
    refuse_deep(session, call);
    const size_t below = stack.size();
    const size_t expected = below + static_cast<size_t>(call.pushes());
    call.row().run(session, call);
    note_ancestry(session, call, below);
    if (call.pushes() != kAnyNumber && stack.size() != expected)
        throw CommandError("internal error: wrong number of images on the stack");
}

// Files that a command reads are where the policy says.
void locate_files(Session& session, const Command& row, Token& token, Strings& arguments) {
    for (size_t i = 0; i < arguments.size() && i < row.args.size() && !row.writes(); ++i)
        if (names_file(row.args[i]))
            arguments[i] = session.file(arguments[i]);
    for (auto& [key, value] : token.modifiers) {
        for (const Modifier& modifier : row.modifiers) {
            if (modifier.key == key && names_file(modifier.hint)) {
                const std::string path = session.file(value);
                const bool layer = modifier.hint != "FILE" && !OIIO::Filesystem::is_regular(path);
                value = layer ? value : path;
            }
        }
    }
}

// What messages call a command.
std::string name_in_messages(const Call& call, bool compat) {
    return !compat ? call.row().label() : call.operation().empty() ? call.text() : call.operation();
}

} // namespace

void run_command(Session& session, const std::string& word, Strings arguments) {
    Token token = parse_token("--" + word, session.compat);
    const Command* row = find_command(token.name);
    if (!row)
        throw CommandError("internal error: no command " + word);
    Call call(*row, std::move(token), std::move(arguments), session.compat);
    execute(session, call);
}

void Runner::run_all() {
    Flow& flow = m_session.flow;
    const bool stops = m_session.compat || m_session.error_exit;
    while (flow.next < m_words.size() && !m_ended && !(m_session.aborted && stops)) {
        m_where.clear();
        guarded(&Runner::run_word);
    }
    m_where.clear();
    if (!m_session.aborted && !m_ended)
        guarded(&Runner::finish);
    if (m_session.runstats)
        print_statistics();
}

void Runner::guarded(void (Runner::*step)()) {
    try {
        (this->*step)();
    } catch (const std::bad_alloc&) {
        m_session.error(m_where, "not enough memory");
    } catch (const ReadError& problem) {
        m_session.error(m_session.compat ? "read" : m_where,
                        m_session.compat ? problem.why : problem.what());
    } catch (const EndOfRun&) {
        m_ended = true;
    } catch (const UsageError& problem) {
        ++m_session.errors;
        m_session.aborted = true;
        m_session.misused = true;
        m_session.complaints() << problem.what() << "\n\nFull command line was:\n> "
                               << m_session.command_line << std::endl;
    } catch (const CommandError& problem) {
        const bool renamed = m_session.compat && !problem.place.empty();
        m_session.error(renamed ? problem.place : m_where, problem.what());
        if (m_session.compat && problem.again)
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
    const std::string raw = m_words[flow.next];
    flow.command = flow.next++;
    m_where = raw.substr(0, raw.find(':'));
    const std::string word = flow.running() ? evaluated(flow.command) : raw;
    Token token = parse_token(word, m_session.compat);
    note_varying(flow.command);
    if (!token.is_command) {
        run_file(word);
        return;
    }
    const Command& row = find(token);
    token = row.own ? parse_token(word) : token;
    m_where = m_session.compat ? word : row.label();
    check_policy(Call(row, token, {}, m_session.compat));
    Strings arguments = take_arguments(row, token);
    locate_files(m_session, row, token, arguments);
    note_varying(flow.command);
    if (flow.running() || row.control) {
        Call call(row, std::move(token), std::move(arguments), m_session.compat);
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
        double& seconds = m_session.seconds["-i"];
        const bool from_file = m_session.labels.count(word) == 0;
        push_file_or_label(m_session, word);
        seconds += time();
        if (from_file)
            mark_frames(*m_session.stack.back());
        run_postponed();
    }
}

const Command& Runner::find(const Token& token) {
    const Command* row = find_command(token.name);
    // "--hdrflip=fail=1": a check that looks at no threshold would pass.
    const bool takes_value = row && !row->args.empty() && std::strchr("=[", row->args[0].front());
    if (row && !token.value.empty() && !takes_value && !m_session.compat) {
        m_where = row->label();
        throw CommandError("takes no \"=" + token.value[0] + "\" (modifiers follow a colon)");
    }
    if (!row && m_session.compat) {
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

// An argument that is itself a command was forgotten, not meant.
Strings Runner::take_arguments(const Command& row, const Token& token) {
    Strings arguments = token.value;
    size_t& next = m_session.flow.next;
    for (size_t i = arguments.size(); i < row.args.size(); ++i) {
        const std::string& name = row.args[i];
        bool optional = name.front() == '[';
        const bool other = m_session.compat && next < m_words.size() && m_words[next][0] == '-';
        if (name.front() == '=' || is_left_out(name, m_words, next) || (optional && other))
            break;
        if (next >= m_words.size()) {
            if (m_session.compat) {
                throw UsageError("Missing parameter " + std::to_string(i + 1) + " from option \"" +
                                 (row.label()[0] == '-' ? "" : "--") + row.label() + "\"");
            }
            throw CommandError("missing argument " + name);
        }
        const std::string& word = m_words[next];
        bool dashed = word.size() > 1 && word[0] == '-' && !parse_number(word);
        if (!optional && dashed && !m_session.compat) {
            std::string bare = word.substr(word[1] == '-' ? 2 : 1);
            if (bare != "compat" && find_command(bare.substr(0, bare.find(':')))) {
                throw CommandError("missing argument " + name + ", \"" + word +
                                   "\" is a command (a file of that name is \"./" + word + "\")");
            }
        }
        // Outputs of checks were taken from the command line as they are, before it ran.
        const bool runs = m_session.flow.running() && row.group != Group::Check;
        arguments.push_back(runs ? evaluated(next) : word);
        ++next;
    }
    return arguments;
}

// A waiting operator's image must not be changed under it.
void Runner::refuse_to_overtake(const Call& call) const {
    if (call.pops() > 0 && !m_postponed.empty() && !m_session.compat) {
        throw CommandError("--" + m_session.waiting +
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
    const std::vector<ImagePtr> images(m_session.stack.end() - call.pops(), m_session.stack.end());
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
    for (size_t i = first; i < m_session.stack.size(); ++i) {
        const ImagePtr& image = m_session.stack[i];
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
    if (!call.row().postponable) {
        throw CommandError("needs " + std::to_string(call.pops()) + " image(s), the stack has " +
                           std::to_string(m_session.stack.size()));
    }
    if (m_session.compat) // as oiiotool, which has room for one
        m_postponed.clear();
    m_postponed.push_back(std::move(call));
    m_session.waiting = m_postponed.front().row().label();
}

void Runner::run_call(Call& call) {
    m_where = name_in_messages(call, m_session.compat);
    const bool told = m_session.debug && call.pops() > 0;
    if (told) {
        m_session.print("Performing '-" + call.row().names.front() +
                        (call.has_argument(0) ? "' with args:  " : "' ") + call.quoted_words());
    }
    refuse_the_same_in_all_frames(call);
    OIIO::Timer time;
    const size_t first = m_session.stack.size() - size_t(call.pops());
    execute(m_session, call);
    mark_pushed(call, first);
    if (call.row().group != Group::General && call.row().group != Group::Control)
        m_session.seconds["-" + call.row().names.front()] += time();
    if (told) {
        m_session.print(OIIO::Strutil::fmt::format(
            "    -{} took {:.2f}s  (total time {:.2f}s, mem {})", call.row().names.front(), time(),
            m_time(), OIIO::Strutil::memformat(OIIO::Sysutil::memory_used())));
    }
}

void Runner::print_statistics() {
    std::string text = OIIO::Strutil::fmt::format(
        "\nThreads: {}\ntonetool runtime statistics:\n  Total time: {:.2f}s\n",
        OIIO::get_int_attribute("threads"), m_time());
    double rest = m_time();
    for (const auto& [name, seconds] : m_session.seconds) {
        text += OIIO::Strutil::fmt::format("      {:<12} : {:5.2f}\n", name, seconds);
        rest -= seconds;
    }
    text += OIIO::Strutil::fmt::format("      {:<12} : {:5.2f}\n", "unaccounted", rest);
    m_session.out << text << "  Peak memory:    "
                  << OIIO::Strutil::memformat(OIIO::Sysutil::memory_used(true))
                  << "\n  Current memory: "
                  << OIIO::Strutil::memformat(OIIO::Sysutil::memory_used()) << "\n\n"
                  << OIIO::ImageCache::create()->getstats(2) << "\n";
}

void Runner::run_postponed() {
    while (!m_postponed.empty() && enough_images(m_postponed.front())) {
        Call call = std::move(m_postponed.front());
        m_postponed.pop_front();
        m_session.waiting = m_postponed.empty() ? "" : m_postponed.front().row().label();
        run_call(call);
    }
}

// A shell's * in place of #, or a forgotten tests=, leaves images that nothing has looked at.
void Runner::refuse_what_was_not_compared() const {
    for (const ImagePtr& image : m_session.stack) {
        if (m_session.judges && !image->worked_on && !image->written) {
            throw CommandError("\"" + image->name() +
                               "\" was never compared (valid: names with # "
                               "for sequences, tests=K for K tests of one reference, or --pop)");
        }
    }
}

// "ref a b --hdrflip" compares a with b: the forgotten tests=2 must not go unnoticed.
void Runner::warn_of_unused() {
    const bool listing = m_session.listing() || m_session.produced_by_name;
    for (const ImagePtr& image : m_session.stack) {
        const bool result = m_session.for_images && image == m_session.stack.back();
        if (!listing && !result && !image->used && image->part().from_file())
            m_session.warning("", "\"" + image->name() + "\" was read, but no command used it");
    }
}

void Runner::finish() {
    if (m_session.compat) {
        finish_leniently();
        return;
    }
    if (!m_postponed.empty()) {
        const Call& call = m_postponed.front();
        m_where = call.row().label();
        throw CommandError("never executed: needs " + std::to_string(call.pops()) +
                           " image(s), the stack has " + std::to_string(m_session.stack.size()));
    }
    if (!m_session.flow.blocks.empty()) {
        throw CommandError("--" + m_session.flow.blocks.back().kind + " without its --end" +
                           m_session.flow.blocks.back().kind);
    }
    if (!m_session.unused_limit.empty()) {
        m_where = m_session.unused_limit;
        throw CommandError("no --diff ran after it, so nothing was held to this limit (other "
                           "measurements have their own, as --hdrflip:fail=X)");
    }
    check_outputs(m_session);
    refuse_what_was_not_compared();
    warn_of_unused();
    if (!m_session.produced && !m_session.wrote && !m_session.for_images)
        throw CommandError("produced no output. Did you forget -o?");
}

void Runner::finish_leniently() {
    refuse_what_was_not_compared();
    if (!m_postponed.empty())
        m_session.warning(m_postponed.front().text(), "pending command never executed");
    if (!m_session.flow.blocks.empty()) {
        const std::string& kind = m_session.flow.blocks.back().kind;
        m_session.warning(kind, "unterminated " + kind);
    }
    if (!m_session.produced && !m_session.listing() && !m_session.dry_run &&
        !m_session.for_images) {
        const Image* top = m_session.stack.empty() ? nullptr : m_session.stack.back().get();
        if (top && !top->written && !top->part().from_file())
            m_session.warning("", "modified images without outputting them. Did you forget -o?");
        else if (!m_session.wrote)
            m_session.warning("", kNoOutput);
    }
}

} // namespace tonetool::chain
