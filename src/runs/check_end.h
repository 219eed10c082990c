// SPDX-License-Identifier: BSD-3-Clause
// What a check comes to: its files and its last line, of frames that ran or of parts that are
// joined.
#pragma once

#include <iosfwd>
#include <optional>

#include "runs/frames.h"
#include "sequence/report/case_images.h"
#include "sequence/report/report_store.h"
#include "sequence/results/results.h"

namespace tonetool::runs {

/// The words at these places.
Strings words_at(const Strings& words, const std::vector<size_t>& places);

/// Pictures are drawn of the frames.
bool draws(const CheckPlan& check);
/// Where they are kept; empty: in memory.
std::string picture_folder(const CheckPlan& check);

/// The images of --images; nullopt where there are to be none. `words`: of the check.
std::optional<sequence::CaseImages> case_images(const CheckPlan& check, const Strings& words);

/// What --accept lets pass, if it is there; a runtime_error where its file is damaged or of another
/// check than this one.
std::vector<sequence::Acceptance> accepted_by(const CheckPlan& plan, const Strings& check);

/// Prints the verdict of a check, then writes its files, those that can be written: none with
/// -n. `unkept`: what could not be kept of the frames, which is an error, too. The exit status.
int conclude_check(const sequence::ShotResult& shot, const FramePlan& plan,
                   const sequence::PictureStore& pictures, const std::string& unkept,
                   std::ostream& out, std::ostream& err);

/// The measured exposures as the file of --statistics, which -n does not write.
void write_statistics(const CheckPlan& check, const std::string& text);

/// --merge: the results of parts of a shot as one.
int merge_parts(const FramePlan& plan, std::ostream& out, std::ostream& err);

} // namespace tonetool::runs
