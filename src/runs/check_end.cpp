#include "runs/check_end.h"

#include <OpenImageIO/filesystem.h>
#include <ostream>

#include "runs/loop.h"
#include "sequence/check_files.h"
#include "sequence/merge.h"
#include "sequence/qc.h"
#include "sequence/report_files.h"
#include "sequence/shot_exposures.h"
#include "text/error.h"
#include "text/printable.h"

namespace tonetool::runs {

Strings words_at(const Strings& words, const std::vector<size_t>& places) {
    Strings found;
    for (size_t at : places) {
        found.push_back(words.at(at));
    }
    return found;
}

bool draws(const CheckPlan& check) {
    return check.has("report") || check.has("contactsheet") || check.has("pictures");
}

std::string picture_folder(const CheckPlan& check) {
    return check.has("pictures")                ? check.argument("pictures")
           : check.has("state") && draws(check) ? check.argument("state") + "/pictures"
                                                : "";
}

int conclude_check(const sequence::ShotResult& shot, const FramePlan& plan,
                   const sequence::PictureStore& pictures, std::ostream& out, std::ostream& err) {
    out << sequence::faults_text(shot);
    out << "check: " << status_name(shot.verdict) << ", " << printable(shot.sentence) << std::endl;
    Strings errors = sequence::write_results(shot, plan.check.words);
    for (const std::string& complaint :
         sequence::write_reports(shot, pictures, plan.check.words, errors)) {
        err << "tonetool WARNING: " << printable(complaint) << '\n';
    }
    for (const std::string& error : errors) {
        err << "tonetool ERROR: " << printable(error) << '\n';
    }
    const int verdict = exit_status(shot.verdict, plan.warnings_exit);
    const int status = plan.compat && verdict == 3 ? 1 : verdict;
    return errors.empty() ? status : 1;
}

int merge_parts(const Strings& words, const FramePlan& plan, std::ostream& out, std::ostream& err) {
    const CheckPlan& check = plan.check;
    const Strings parts = words_at(words, check.inputs);
    if (parts != check.essence) {
        throw CommandError("--merge takes results alone (valid: --merge PART.json ... with --json, "
                           "--csv and the like)");
    }
    sequence::check_places(check.words);
    if (check.has("statistics")) {
        sequence::write_text(sequence::merged_exposures(parts), check.argument("statistics"));
        return 0;
    }
    Strings complaints;
    const sequence::ShotResult shot = sequence::merged(parts, check.expected, complaints);
    chain::Session session(out, err, full_command_line(words, plan.compat));
    for (const std::string& complaint : complaints) {
        session.error("merge", complaint);
    }
    if (check.has("pictures") && !OIIO::Filesystem::is_directory(check.argument("pictures"))) {
        throw CommandError("--pictures: there is no folder \"" + check.argument("pictures") + "\"");
    }
    const sequence::PictureStore pictures(picture_folder(check));
    return worse(session.exit_status(), conclude_check(shot, plan, pictures, out, err));
}

} // namespace tonetool::runs
