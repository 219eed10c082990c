// SPDX-License-Identifier: BSD-3-Clause
#include "runs/rehearsal.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <sstream>

#include "chain/session/runner.h"
#include "runs/check_end.h"
#include "runs/stack_of_files.h"
#include "runs/workers.h"
#include "sequence/results/check_files.h"
#include "sequence/results/method_table.h"
#include "sequence/results/probe.h"
#include "sequence/results/tables.h"
#include "text/error.h"
#include "text/printable.h"
#include "tonetool/parts.h"

namespace tonetool::runs {

namespace {

using chain::Group;
using chain::Word;
using OIIO::Strutil::fmt::format;

// ---- layers

// The layer that a command wants of a file, by the place of its word.
struct LayerAsked {
    std::string command, layer;
    size_t file;
};

// The layers that commands name, of the files that they get as they are.
class LayersAsked {
public:
    void note(const StackedCommand& command) {
        const Word& word = command.word;
        const size_t all = command.stack.size(), first = all - command.pops;
        if (word.is("qc"))
            ask(command, "layer", first, all);
        if (!word.is("against") && (word.row->group != Group::Compare || word.row->pops <= 0))
            return;
        const auto& keys = word.row->modifiers;
        const bool other = std::any_of(keys.begin(), keys.end(),
                                       [](const auto& one) { return one.key == "ldrlayer"; });
        ask(command, "layer", first, other ? first + 1 : all);
        ask(command, "ldrlayer", first + 1, all);
    }
    const std::vector<LayerAsked>& asked() const { return m_asked; }

private:
    void ask(const StackedCommand& command, const std::string& key, size_t begin, size_t end) {
        for (const auto& [name, layer] : command.word.token.modifiers) {
            if (name != key || layer.find('{') != std::string::npos)
                continue;
            for (size_t i = begin; i < end; ++i)
                if (const StackedImage& image = command.stack[i]; image.file && image.unchanged)
                    m_asked.push_back({command.word.row->label(), layer, *image.file});
        }
    }

    std::vector<LayerAsked> m_asked;
};

// Why a file has not the layer; empty where it has, nullopt where its headers cannot be read.
std::optional<std::string> lack_of(const std::string& file, const std::string& layer) {
    const auto in = OIIO::ImageInput::open(file);
    if (!in) {
        (void)OIIO::geterror();
        return std::nullopt;
    }
    std::vector<OIIO::ImageSpec> headers;
    for (int subimage = 0; in->seek_subimage(subimage, 0); ++subimage)
        headers.push_back(in->spec(subimage, 0));
    const PixelOptions options{layer, ""};
    PartChoice part;
    ColorChoice color;
    std::string why;
    const bool found = ToneAlgo::find_part(headers, options, part, why) &&
                       ToneAlgo::find_color(headers.at(size_t(part.part)), options, color, why);
    return found ? "" : why;
}

// The frames of the line first. A layer that another task of a farm finds is no mistake of the
// line.
Strings files_at(const FramePlan& plan, const FrameRun& first, size_t at) {
    Strings files;
    for (const FrameRun& run : plan.runs)
        if (run.of_suite.own == first.of_suite.own)
            files.push_back(run.words.at(at));
    const std::string& pattern = plan.line_of(first).texts[at];
    if (!plan.named && sequence::is_pattern(pattern)) {
        const Strings others = sequence::list_all_files(pattern, plan.options).names;
        files.insert(files.end(), others.begin(), others.end());
    }
    return files;
}

// What is wrong with all files of the sequence; empty where nothing is with one of them.
std::string lack_of_all(const FramePlan& plan, const FrameRun& run, const LayerAsked& asked) {
    std::string first;
    for (const std::string& file : files_at(plan, run, asked.file)) {
        const bool recipe = OIIO::Strutil::iends_with(file.substr(0, file.find('?')), ".tone");
        std::error_code none;
        if (recipe || !std::filesystem::is_regular_file(file, none))
            continue;
        const auto lack = lack_of(file, asked.layer);
        if (lack && lack->empty())
            return "";
        if (lack && first.empty())
            first = "\"" + file + "\": " + *lack;
    }
    return first;
}

// ---- commands

// What the commands of a run would print; empty where nothing is wrong.
std::string mistakes_of(const FramePlan& plan, const FrameRun& run) {
    std::ostringstream text;
    chain::Session session(text, text, full_command_line(plan.line_of(run), run.words, false));
    set_for_line(session, plan);
    session.frame = run.frame;
    chain::Runner(session, run.words).check_all();
    if (session.outcome.errors > 0)
        return text.str();
    LayersAsked layers;
    const Followed followed =
        follow_stack(plan.line_of(run), plan.check_of(run),
                     [&](const StackedCommand& command) { layers.note(command); });
    if (!followed.mistake.empty()) {
        session.error(followed.command, followed.mistake);
        return text.str();
    }
    for (const LayerAsked& asked : layers.asked()) {
        const std::string lack = lack_of_all(plan, run, asked);
        if (!lack.empty()) {
            session.error(asked.command, lack);
            return text.str();
        }
    }
    return "";
}

// Of the first run of each line: cases of a suite may have several.
std::string mistakes_of(const FramePlan& plan) {
    std::set<const OwnCheck*> known;
    for (const FrameRun& run : plan.runs) {
        if (!run.of_suite.skip.empty() || !known.insert(run.of_suite.own.get()).second)
            continue;
        std::string mistakes = mistakes_of(plan, run);
        if (!mistakes.empty())
            return mistakes;
    }
    return "";
}

std::string in_worker(const std::function<std::string()>& task) {
    std::string found;
    bool begun = false;
    Workers(1, [&](size_t) { return task(); })
        .run([&] { return std::exchange(begun, true) ? std::nullopt : std::optional<size_t>(0); },
             // What ends a process here ends that of its frame, whose result says so.
             [&](size_t, const TaskResult& result) { found = result.reply; });
    return found;
}

// ---- what --dry-run prints

bool is_there(const FramePlan& plan, const FrameRun& run) {
    const auto& places = plan.sequences.empty() ? plan.check.inputs : plan.sequences;
    return sequence::missing_of(words_at(run.words, places)).status != sequence::Status::Missing;
}

// As render farms read it: "3,7-9".
std::string numbers_text(const std::vector<const FrameRun*>& runs) {
    sequence::ShotResult shot;
    for (const FrameRun* run : runs) {
        sequence::FrameResult& frame = shot.frames.emplace_back();
        frame.frame = run->frame.number;
        frame.status = sequence::Status::Missing;
    }
    const std::string text = bad_frames_text(shot, sequence::Status::Failed);
    return text.substr(0, text.find('\n'));
}

std::string names_text(const std::vector<const FrameRun*>& runs) {
    Strings names;
    for (const FrameRun* run : runs)
        names.push_back(printable(sequence::item_name(run->frame.item())));
    return join(names, ", ");
}

// Of a case: as far as the pattern is the same for all, since folders below are made.
std::string fixed_name(const FramePlan& plan, size_t at, const std::string& file) {
    const std::string& pattern = plan.line.texts[at];
    return plan.named && sequence::has_names(pattern)
               ? sequence::NamePattern(sequence::without_range(pattern), true).fixed_part()
               : file;
}

// The words at these places, if they are the same file in all frames that have both.
void refuse_if_same(const FramePlan& plan, const std::vector<size_t>& pair) {
    size_t same = 0;
    for (const FrameRun& run : plan.runs) {
        const Strings files = words_at(run.words, pair);
        std::error_code none;
        if (std::filesystem::equivalent(files[0], files[1], none))
            ++same;
        else if (std::filesystem::exists(files[0], none) && std::filesystem::exists(files[1], none))
            return;
    }
    if (same > 1) {
        throw CommandError("in all " + std::to_string(same) + " frames \"" +
                           plan.line.texts[pair[0]] + "\" and \"" + plan.line.texts[pair[1]] +
                           "\" are the same file (valid: the names of two versions)");
    }
}

} // namespace

void check_cases_asked_for(const FramePlan& plan) {
    const CheckPlan& check = plan.check;
    if (check.has("table") && !plan.named && !check.has("merge")) // parts may have names
        throw CommandError(std::string("--table: ") + sequence::kTableNeedsNames);
    if (check.has("table") && !check.table.methods.empty() && !check.has("merge") &&
        std::all_of(plan.runs.begin(), plan.runs.end(),
                    [](const FrameRun& run) { return run.frame.item().method.empty(); }))
        throw CommandError(
            "--table: methods= needs methods (valid: %M in the names of the images)");
    const auto need = [&](const char* command, const char* key, const Strings& asked,
                          std::string sequence::Item::*member) {
        std::set<std::string> there;
        for (const FrameRun& run : plan.runs)
            there.insert(run.frame.item().*member);
        for (const std::string& one : asked)
            if (there.count(one) == 0)
                throw CommandError(std::string(command) + ": " + key + " has \"" + one +
                                   "\" (there are: " + join({there.begin(), there.end()}, ", ") +
                                   ")");
    };
    if (check.has("table") && !check.has("merge"))
        need("--table", "methods", check.table.methods, &sequence::Item::method);
    if (!check.has("figure"))
        return;
    need("--figure", "names", check.figure.names, &sequence::Item::name);
    need("--figure", "methods", check.figure.methods, &sequence::Item::method);
}

void refuse_shot_against_itself(const FramePlan& plan) {
    if (plan.named || !plan.loops || !plan.check.compares_pairs())
        return;
    follow_stack(plan.line, plan.check, [&](const StackedCommand& command) {
        const bool compares =
            command.word.row->group == chain::Group::Compare || command.word.is("against");
        const size_t all = command.stack.size();
        if (!compares || command.pops != 2 || all < 2)
            return;
        const StackedImage &reference = command.stack[all - 2], &test = command.stack[all - 1];
        if (reference.file && test.file && reference.unchanged && test.unchanged)
            refuse_if_same(plan, {*reference.file, *test.file});
    });
}

void try_outputs(const FramePlan& plan) {
    const CheckPlan& check = plan.check;
    sequence::try_places(check.written_places());
    std::set<std::string> folders;
    for (const size_t at : check.outputs) {
        const auto& always = check.always_written;
        if (check.dry_run || std::find(always.begin(), always.end(), at) == always.end())
            continue;
        for (const FrameRun& run : plan.runs) {
            const std::string& file = run.words.at(at);
            const std::string folder =
                std::filesystem::path(fixed_name(plan, at, file)).parent_path().string();
            std::error_code none;
            if (file.find('{') != std::string::npos || !folders.insert(folder).second)
                continue;
            if (!folder.empty() && !std::filesystem::is_directory(folder, none)) {
                throw CommandError("there is no folder \"" + folder + "\" to write \"" + file +
                                   "\" into");
            }
            sequence::try_folder(folder.empty() ? "." : folder, "\"" + file + "\": ");
        }
    }
}

bool commands_are_right(const FramePlan& plan, std::ostream& err, bool worker) {
    const auto& all = plan.line.words;
    const bool lenient =
        plan.line.compat || std::any_of(all.begin(), all.end(),
                                        [](const Word& one) { return one.is("no-error-exit"); });
    if (lenient || plan.runs.empty())
        return true;
    const auto task = [&plan] { return mistakes_of(plan); };
    const std::string mistakes = worker ? in_worker(task) : task();
    err << mistakes << std::flush;
    return mistakes.empty();
}

std::string plan_text(const FramePlan& plan) {
    std::vector<const FrameRun*> missing;
    for (const FrameRun& run : plan.runs)
        if (!is_there(plan, run))
            missing.push_back(&run);
    const size_t asked = plan.runs.size();
    std::string text = "dry run: the command line is right, ";
    if (plan.loops) {
        text += format("{} {}{} asked for, {} there", asked, plan.named ? "case" : "frame",
                       asked == 1 ? "" : "s", asked - missing.size());
        text += missing.empty()
                    ? ""
                    : ", missing: " + (plan.named ? names_text(missing) : numbers_text(missing));
    } else {
        text += missing.empty() ? "its files are there" : "not all of its files are there";
    }
    return text + "\n" + places_text(plan);
}

std::string places_text(const FramePlan& plan) {
    const CheckPlan& check = plan.check;
    Strings places;
    for (const auto& [command, file] : check.written_places())
        if (!file.empty())
            places.push_back(printable(file) + " (--" + command + ")");
    for (const size_t at : check.outputs)
        if (!check.dry_run)
            places.push_back(printable(plan.line.texts[at]) + " (-o)");
    return "dry run: " +
           (places.empty() ? "no result would be written"
                           : "results would be in " + join(places, ", ")) +
           "\n";
}

} // namespace tonetool::runs
