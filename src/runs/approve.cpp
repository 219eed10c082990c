// SPDX-License-Identifier: BSD-3-Clause
#include "runs/approve.h"

#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <ctime>
#include <filesystem>
#include <map>
#include <ostream>
#include <pwd.h>
#include <set>
#include <unistd.h>

#include "sequence/results/probe.h"
#include "sequence/results/results_json.h"
#include "sequence/results/shot_exposures.h"
#include "sequence/suite/approvable.h"
#include "sequence/suite/suite_file.h"
#include "store/store.h"
#include "text/error.h"
#include "text/printable.h"

namespace tonetool::runs {

namespace {

using chain::Word;
using OIIO::Strutil::fmt::format;
using sequence::FrameResult;
using sequence::ShotResult;
using sequence::Status;

const char* const kSettings[] = {"approve", "reason", "by", "key", "add", "retire", "again"};

// The words of a line of --approve.
struct Order {
    std::map<std::string, std::string> settings; ///< "reason", with its argument
    Strings globs;

    bool has(const char* name) const { return settings.count(name) > 0; }
    std::string text(const char* name) const { return has(name) ? settings.at(name) : ""; }
};

Order order_of(const chain::ParsedLine& line) {
    Order order;
    for (const Word& word : line.words) {
        if (!word.row && !word.token.is_command) {
            order.globs.push_back(line.texts[word.at]);
            continue;
        }
        const bool known = word.row && std::any_of(std::begin(kSettings), std::end(kSettings),
                                                   [&](const char* one) { return word.is(one); });
        if (!known) {
            throw CommandError("--approve is a line of its own: \"" + line.texts[word.at] +
                               "\" does not go with it (valid: names of cases, --reason, --by, "
                               "--key, --add, --retire, --again)");
        }
        if (!word.missing.empty())
            throw CommandError("--" + word.row->names.front() + ": missing argument " +
                               word.missing);
        const std::string text = word.arguments.empty() ? "" : line.texts[word.arguments.front()];
        if (!order.settings.emplace(word.row->names.front(), text).second)
            throw CommandError("--" + word.row->names.front() + " is given twice");
    }
    return order;
}

ShotResult run_of(const std::string& file) {
    ShotResult shot;
    try {
        shot = sequence::shot_from_json(sequence::read_text(file));
    } catch (const std::runtime_error& problem) {
        throw CommandError("--approve: \"" + file + "\": " + problem.what());
    }
    if (!shot.suite || shot.suite->store.empty()) {
        throw CommandError("--approve: \"" + file +
                           "\" is not of a suite whose reference is a folder of approved images "
                           "(valid: the FILE of --json with --suite)");
    }
    return shot;
}

std::string could_be(const ShotResult& shot, bool retire) {
    Strings names;
    for (const FrameResult& frame : shot.frames)
        if (retire ? frame.status == Status::Missing && frame.of_suite.sha256.empty()
                   : sequence::approval_refusal(frame, false).empty())
            names.push_back(shell_quoted(frame.name));
    return names.empty() ? "none, no case needs it" : join(names, " ");
}

// A case that is still made is not retired.
std::string retire_refusal(const FrameResult& frame, bool again) {
    const bool gone = frame.status == Status::Missing && frame.of_suite.sha256.empty();
    return gone || again ? "" : "its image is there (--again retires it anyhow)";
}

struct Chosen {
    std::vector<const FrameResult*> cases;
    size_t left_out = 0; ///< cases that a glob names and that are as they were approved
};

// The cases that the globs name, each once.
Chosen chosen(const ShotResult& shot, const Order& order) {
    const bool retire = order.has("retire");
    if (order.globs.empty()) {
        throw CommandError(std::string("--approve: which cases are to be ") +
                           (retire ? "retired" : "approved") +
                           "? (valid: " + could_be(shot, retire) + ")");
    }
    std::map<std::string, const FrameResult*> cases;
    std::set<const FrameResult*> left_out;
    std::set<std::string> names;
    for (const FrameResult& frame : shot.frames)
        names.insert(frame.name);
    for (const std::string& text : order.globs) {
        sequence::CaseGlob glob(text);
        glob.look_at(names);
        bool any = false, left = false;
        std::string refused;
        for (const FrameResult& frame : shot.frames) {
            if (!glob.fits(frame.name))
                continue;
            any = true;
            const std::string why = retire ? retire_refusal(frame, order.has("again"))
                                           : sequence::approval_refusal(frame, order.has("again"));
            const bool leaves = glob.is_pattern() && (retire || frame.status == Status::Passed);
            if (!why.empty() && !leaves)
                throw CommandError("--approve: " + printable(frame.name) +
                                   " is not approved: " + why);
            if (!why.empty()) {
                refused = why;
                left_out.insert(&frame);
            }
            left = left || why.empty();
            if (why.empty() && !cases.emplace(frame.name, &frame).second &&
                cases.at(frame.name) != &frame)
                throw CommandError("--approve: " + printable(frame.name) +
                                   " has images of several methods in the run, and one can be "
                                   "approved (valid: a run of one method)");
        }
        if (!any)
            throw CommandError("--approve: \"" + text + "\" names no case of the run (valid: " +
                               could_be(shot, retire) + ")");
        if (!left)
            throw CommandError("--approve: \"" + text + "\" names no case that is to be " +
                               "approved: " + refused);
    }
    Chosen found;
    for (const auto& [name, frame] : cases)
        found.cases.push_back(frame);
    found.left_out = left_out.size();
    return found;
}

std::string user() {
    const std::string name(OIIO::Sysutil::getenv("GIT_AUTHOR_NAME")),
        address(OIIO::Sysutil::getenv("GIT_AUTHOR_EMAIL"));
    if (!name.empty())
        return address.empty() ? name : name + " <" + address + ">";
    const passwd* login = getpwuid(geteuid());
    return login ? login->pw_name : std::to_string(geteuid());
}

std::string now_text() {
    const std::time_t now = std::time(nullptr);
    std::tm utc{};
    gmtime_r(&now, &utc);
    char text[32];
    const size_t size = std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return {text, size};
}

// That of the run; another one would replace images that it was not compared with.
std::string key_of(const ShotResult& shot, const Order& order) {
    const std::string& of_run = shot.suite->key;
    if (!order.has("key") && !of_run.empty()) {
        throw CommandError("--approve: the run was compared with --key " + of_run +
                           " (valid: --key " + of_run + ", or --key '' for images of all)");
    }
    return order.text("key");
}

int approve(const Order& order, std::ostream& out) {
    const ShotResult shot = run_of(order.text("approve"));
    const bool blank = order.text("reason").find_first_not_of(" \t\n") == std::string::npos;
    if (blank && !order.globs.empty())
        throw CommandError("--approve: why? (valid: --reason 'new hair shader')");
    const auto [cases, left_out] = chosen(shot, order);
    const std::string key = key_of(shot, order);
    store::Store store(shot.suite->store);
    if (order.has("retire")) {
        Strings names;
        for (const FrameResult* frame : cases)
            names.push_back(frame->name);
        store.retire(names);
        for (const std::string& name : names)
            out << "retired: " << printable(name) << '\n';
        return 0;
    }
    std::vector<store::Approval> approvals;
    for (const FrameResult* frame : cases) {
        const sequence::Probe probe = sequence::probed({frame->test});
        if (!probe.message.empty())
            throw CommandError("--approve: " + printable(frame->name) +
                               " is not approved: " + probe.message);
        approvals.push_back({frame->name, frame->test, frame->of_suite.sha256, key,
                             order.has("by") ? order.text("by") : user(), now_text(),
                             order.text("reason"), order.has("add")});
    }
    store.approve(approvals);
    for (const FrameResult* frame : cases)
        out << "approved: " << printable(frame->name) << ", \"" << printable(frame->test) << "\" ("
            << status_name(frame->status)
            << (frame->message.empty() ? "" : ": " + printable(frame->message)) << ")\n";
    if (left_out > 0)
        out << left_out << " that passed left as approved (--again approves anyhow)\n";
    return 0;
}

// "3 days".
std::string age_of(const std::string& at) {
    std::tm utc{};
    const char* end = strptime(at.c_str(), "%Y-%m-%dT%H:%M:%SZ", &utc);
    if (!end || *end != '\0')
        return "?";
    const double days = std::difftime(std::time(nullptr), timegm(&utc)) / 86400;
    return days < 1 ? "today" : days < 2 ? "1 day" : format("{} days", int(days));
}

std::string table_text(const std::vector<Strings>& rows) {
    std::vector<size_t> widths(rows.front().size());
    for (const Strings& row : rows)
        for (size_t i = 0; i < row.size(); ++i)
            widths[i] = std::max(widths[i], row[i].size());
    std::string text;
    for (const Strings& row : rows) {
        std::string line;
        for (size_t i = 0; i < row.size(); ++i)
            line +=
                row[i] + std::string(i + 1 < row.size() ? widths[i] - row[i].size() + 2 : 0, ' ');
        text += line + "\n";
    }
    return text;
}

int list_approved(const chain::ParsedLine& line, std::ostream& out) {
    if (line.words.size() != 1 || line.words.front().arguments.empty())
        throw CommandError("--approved is a line of its own (valid: --approved DIR)");
    const std::string folder = line.texts[line.words.front().arguments.front()];
    std::error_code none;
    if (!std::filesystem::is_directory(folder, none))
        throw CommandError("--approved: there is no folder \"" + folder + "\"");
    const store::Store store(folder);
    std::vector<Strings> rows{{"name", "key", "bytes", "approved", "by", "reason"}};
    for (const std::string& name : store.names()) {
        const auto record = store.find(name);
        for (const store::ApprovedImage& image :
             record ? record->images : std::vector<store::ApprovedImage>())
            rows.push_back({printable(name), printable(image.key), std::to_string(image.bytes),
                            age_of(image.at), printable(image.by), printable(image.reason)});
    }
    if (rows.size() == 1)
        throw CommandError("--approved: no image is approved in \"" + folder + "\"");
    out << table_text(rows);
    const Strings problems = store.problems();
    for (const std::string& problem : problems)
        out << "WRONG: " << printable(problem) << '\n';
    return problems.empty() ? 0 : 1;
}

bool has(const chain::ParsedLine& line, const char* name) {
    return std::any_of(line.words.begin(), line.words.end(),
                       [&](const Word& word) { return word.is(name); });
}

} // namespace

bool is_of_store(const chain::ParsedLine& line) {
    for (const char* name : {"reason", "by", "retire", "again"})
        if (has(line, name) && !has(line, "approve"))
            throw CommandError(std::string("--") + name +
                               " goes with --approve (valid: --approve run.json NAME --reason "
                               "TEXT)");
    return has(line, "approve") || has(line, "approved");
}

int run_store_line(const chain::ParsedLine& line, std::ostream& out) {
    try {
        return has(line, "approve") ? approve(order_of(line), out) : list_approved(line, out);
    } catch (const CommandError&) {
        throw;
    } catch (const std::runtime_error& problem) {
        throw CommandError((has(line, "approve") ? "--approve: " : "--approved: ") +
                           std::string(problem.what()));
    }
}

} // namespace tonetool::runs
