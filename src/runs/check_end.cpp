// SPDX-License-Identifier: BSD-3-Clause
#include "runs/check_end.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <filesystem>
#include <ostream>
#include <utility>

#include "runs/frame_context.h"
#include "runs/loop.h"
#include "runs/rehearsal.h"
#include "runs/shots.h"
#include "runs/written_over.h"
#include "sequence/frames/file_sequence.h"
#include "sequence/report/report_files.h"
#include "sequence/results/check_files.h"
#include "sequence/results/ci_texts.h"
#include "sequence/results/method_table.h"
#include "sequence/results/shot_exposures.h"
#include "sequence/results/tables.h"
#include "sequence/suite/approvable.h"
#include "sequence/verdict/accepted.h"
#include "sequence/verdict/fault_lines.h"
#include "sequence/verdict/merge.h"
#include "sequence/verdict/part_files.h"
#include "text/error.h"
#include "text/printable.h"
#include "text/text.h"
#include "tonetool/write.h"

namespace tonetool::runs {

namespace {

void write_table(const sequence::ShotResult& shot, const CheckPlan& check,
                 const std::string& file) {
    sequence::write_text(sequence::method_table(shot, check.table, sequence::table_format(file)),
                         file);
    const std::string lacking = sequence::lacking_in_table(shot, check.table);
    if (!lacking.empty())
        throw CommandError("--table: no number of " + lacking);
}

void write_figure(const sequence::ShotResult& shot, const CheckPlan& check,
                  const sequence::PictureStore& pictures, const std::string& file,
                  std::ostream& err) {
    std::string warning, why;
    const OIIO::ImageBuf figure = sequence::figure(shot, pictures, check.figure, warning);
    if (!warning.empty())
        err << "tonetool WARNING: --figure: " << warning << '\n';
    if (!write_image(figure, file, why))
        throw CommandError(why);
}

// Tables for papers, and what continuous integration shows.
void write_for_others(const sequence::ShotResult& shot, const CheckPlan& check, std::ostream& out,
                      Strings& errors) {
    const sequence::CheckFiles files = check.written();
    if (const auto table = files.find("table"); table != files.end())
        sequence::attempt(errors, [&] { write_table(shot, check, table->second); });
    Strings summaries;
    if (const auto summary = files.find("summary"); summary != files.end())
        summaries.push_back(summary->second);
    if (check.has("github")) {
        out << sequence::github_text(shot) << std::flush;
        const std::string of_step(OIIO::Sysutil::getenv("GITHUB_STEP_SUMMARY"));
        if (!of_step.empty() && !check.dry_run)
            summaries.push_back(of_step);
    }
    for (const std::string& file : summaries)
        sequence::attempt(errors, [&] {
            sequence::append_text(sequence::summary_text(shot, check.argument("json")), file);
        });
}

// What there is of --images, without what is of an earlier run.
sequence::CaseFiles images_at_end(const sequence::ShotResult& shot, const CheckPlan& check,
                                  Strings& errors, std::ostream& err) {
    const auto images = case_images(check, shot.check);
    sequence::CaseFiles kept;
    if (!images)
        return kept;
    sequence::attempt(errors, [&] { kept = images->settle(shot); });
    if (const size_t lacking = sequence::lacking_images(shot, kept); lacking > 0) {
        err << "tonetool WARNING: --images: none of " << lacking << " that did not pass in \""
            << printable(check.argument("images"))
            << "\" (valid: the folder that --images had when they were compared)\n";
    }
    return kept;
}

// What a person types next, after a look.
std::string approve_hint(const sequence::ShotResult& shot, const CheckPlan& check) {
    constexpr size_t most = 8;
    const auto cases = approvable_cases(shot);
    if (cases.empty())
        return "";
    if (check.written().count("json") == 0)
        return "to approve images, run this again with --json run.json: it then says the command\n";
    Strings names;
    for (const sequence::FrameResult* frame : cases)
        names.push_back(printable(shell_quoted(frame->name)));
    // A slip in its name would make another.
    const std::string& store = shot.suite->store;
    std::error_code none;
    const std::string made =
        std::filesystem::is_directory(store, none)
            ? ""
            : "there is no folder \"" + printable(store) + "\": approving makes it\n";
    return made + "to approve, after a look: " +
           sequence::approve_line(check.argument("json"),
                                  cases.size() > most ? "CASE..." : join(names, " ")) +
           "\n";
}

} // namespace

Strings words_at(const Strings& words, const std::vector<size_t>& places) {
    Strings found;
    for (size_t at : places)
        found.push_back(words.at(at));
    return found;
}

bool draws(const CheckPlan& check) {
    return !check.dry_run &&
           (check.has("report") || check.has("contactsheet") || check.has("pictures"));
}

std::optional<sequence::CaseImages> case_images(const CheckPlan& check, const Strings& words) {
    if (check.dry_run || !check.has("images"))
        return std::nullopt;
    bool wildcards = true, still = true;
    for (const std::string& word : words) {
        const std::string name = word.substr(std::min(word.find_first_not_of('-'), word.size()));
        if (word != name)
            wildcards = name == "wildcardon" || (wildcards && name != "wildcardoff");
        still &= !wildcards || !sequence::is_pattern(word);
    }
    return sequence::CaseImages(check.argument("images"), still);
}

std::string picture_folder(const CheckPlan& check) {
    return check.dry_run                        ? ""
           : check.has("pictures")              ? check.argument("pictures")
           : check.has("state") && draws(check) ? check.argument("state") + "/pictures"
                                                : "";
}

std::vector<sequence::Acceptance> accepted_by(const CheckPlan& plan, const Strings& check) {
    if (!plan.has("accept"))
        return {};
    const std::string file = plan.argument("accept");
    try {
        const sequence::Acceptances found = sequence::read_acceptances(file);
        sequence::check_same_check(found, check, file);
        return found.accepted;
    } catch (const std::runtime_error& problem) {
        throw CommandError(std::string("--accept: ") + problem.what());
    }
}

void write_statistics(const CheckPlan& check, const std::string& text) {
    const sequence::CheckFiles files = check.written();
    const auto file = files.find("statistics");
    if (file != files.end())
        sequence::write_text(text, file->second);
}

int conclude_check(const sequence::ShotResult& shot, const FramePlan& plan,
                   const sequence::PictureStore& pictures, const std::string& unkept,
                   std::ostream& out, std::ostream& err) {
    out << sequence::faults_text(shot, plan.verbose);
    out << "check: " << status_name(shot.verdict) << ", " << printable(shot.sentence) << std::endl;
    const sequence::CheckFiles files = plan.check.written();
    Strings errors;
    const sequence::CaseFiles images = images_at_end(shot, plan.check, errors, err);
    for (std::string& error : sequence::write_results(shot, files, plan.check.json_records, images))
        errors.push_back(std::move(error));
    if (const auto bad = files.find("bad-frames"); bad != files.end()) {
        const std::string text = sequence::bad_frames_text(shot, plan.check.bad_from);
        sequence::attempt(errors, [&] { sequence::write_text(text, bad->second); });
    }
    out << approve_hint(shot, plan.check);
    write_for_others(shot, plan.check, out, errors);
    if (const auto figure = files.find("figure"); figure != files.end()) {
        const auto draw = [&] { write_figure(shot, plan.check, pictures, figure->second, err); };
        sequence::attempt(errors, [&] {
            try {
                draw();
            } catch (const std::exception& problem) {
                throw CommandError(std::string("--figure: ") + problem.what());
            }
        });
    }
    if (plan.check.has("ctest"))
        out << sequence::ctest_text(shot, images) << std::flush;
    if (!unkept.empty())
        errors.push_back(unkept);
    for (const std::string& complaint : sequence::unused_acceptances(shot))
        err << "tonetool WARNING: --accept: " << printable(complaint) << '\n';
    sequence::PageLimits page = plan.check.page;
    page.json = plan.check.argument("json");
    for (const std::string& complaint :
         sequence::write_reports(shot, pictures, files, page, errors))
        err << "tonetool WARNING: " << printable(complaint) << '\n';
    for (const std::string& error : errors)
        err << "tonetool ERROR: " << printable(error) << '\n';
    const int verdict = exit_status(shot.verdict, plan.warnings_exit);
    const int status = plan.line.compat && verdict == 3 ? 1 : verdict;
    return !errors.empty() ? 1 : plan.check.has("exit-zero") ? 0 : status;
}

namespace {

// The files of the parts, if all can be written that is made of them.
Strings parts_of(const FramePlan& plan) {
    const CheckPlan& check = plan.check;
    Strings named = words_at(plan.line.texts, check.inputs);
    if (named != check.essence) {
        throw CommandError("--merge takes results alone (valid: --merge PART.json ... with --json, "
                           "--csv and the like)");
    }
    sequence::check_places(check.written_places());
    if (check.has("accept")) // a damaged file is told before the parts are read
        (void)sequence::read_acceptances(check.argument("accept"));
    for (const std::string& list : check.part_lists)
        for (const std::string& line : sequence::lines_of(list))
            named.push_back(line);
    Strings parts = sequence::part_files(named);
    refuse_to_write_over(plan, parts);
    sequence::CheckFiles places = check.written_places();
    places.erase("pictures"); // which are read here
    places.erase("images");
    sequence::try_places(places);
    if (check.has("pictures") && !OIIO::Filesystem::is_directory(check.argument("pictures")))
        throw CommandError("--pictures: there is no folder \"" + check.argument("pictures") + "\"");
    return parts;
}

void merge_exposures(const FramePlan& plan, const Strings& parts, std::ostream& out) {
    const bool shots = std::any_of(parts.begin(), parts.end(), is_shot_file);
    const std::string text =
        shots ? merged_shots(parts, plan.check.expected) : sequence::merged_exposures(parts);
    if (plan.check.only_validates)
        out << places_text(plan);
    else
        write_statistics(plan.check, text);
}

} // namespace

int merge_parts(const FramePlan& plan, std::ostream& out, std::ostream& err) {
    const CheckPlan& check = plan.check;
    const Strings parts = parts_of(plan);
    if (check.has("statistics")) {
        merge_exposures(plan, parts, out);
        return 0;
    }
    Strings complaints;
    sequence::ShotResult shot = sequence::merged(parts, check.expected, complaints);
    if (plan.suite && !shot.check.empty() && shot.check != check.expected_check) {
        throw CommandError("the parts are of another suite than \"" + plan.suite->suite().file +
                           "\": " + join(shot.check, " ") + " instead of " +
                           join(check.expected_check, " "));
    }
    if (const auto accepted = accepted_by(check, shot.check); !accepted.empty()) {
        shot.accepted.insert(shot.accepted.begin(), accepted.begin(), accepted.end());
        conclude(shot);
    }
    chain::Session session(out, err,
                           full_command_line(plan.line, plan.line.texts, plan.line.compat));
    for (const std::string& complaint : complaints)
        session.error("merge", complaint);
    if (check.only_validates) {
        const auto& all = shot.frames;
        const auto gone = std::count_if(all.begin(), all.end(), sequence::is_of_no_part);
        out << "dry run: " << all.size() - size_t(gone) << " frames in " << parts.size() << " parts"
            << (gone > 0 ? ", " + std::to_string(gone) + " missing" : "") << "\n"
            << places_text(plan);
        return session.exit_status();
    }
    const sequence::PictureStore pictures(picture_folder(check), check.pictures);
    return worse(session.exit_status(), conclude_check(shot, plan, pictures, "", out, err));
}

} // namespace tonetool::runs
