// SPDX-License-Identifier: BSD-3-Clause
// What the commands that compare print, and what their thresholds say.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "imagebuf/options/summary_fields.h"
#include "sequence/results/results.h"

namespace tonetool::chain {

// For summary_fields.h: of the summary, or of the image that is called so.
template <class Summary>
auto fields(Lines& lines, const Summary& summary, const std::string& of = "") {
    return [&lines, &summary, of](const SummaryField& field, auto member) {
        lines.add(key_name(field, of), said(field, summary.*member));
    };
}

// The summary, one fact a line, each with "LABEL: " before it. `first` and `second` are the names
// of the images.
std::string summary_text(const std::string& label, const FlipSummary& summary,
                         const std::string& first, const std::string& second);
std::string summary_text(const std::string& label, const ErrorSummary& summary,
                         const std::string& first, const std::string& second);
std::string summary_text(const std::string& label, const TmqiSummary& summary,
                         const std::string& first, const std::string& second);

/// Part of the frame's result, where there is a check. judge() adds the threshold to it.
void record(Session& session, const Call& call, sequence::Measurement measurement, size_t test = 0);

/// The verdict of a command with limits as the last line of its report: PASS, WARNING or FAIL, the
/// limits that say so, the worst pixel where there is one, and the test image. Warns, and counts in
/// the session. Whatever is not on the good side of a limit fails. Returns whether one of fail= was
/// missed.
bool judge(Session& session, const Call& call, const Limits& limits,
           const std::function<double(const std::string& quantity)>& measure,
           const std::optional<sequence::Position>& worst, size_t test = 0);

} // namespace tonetool::chain
