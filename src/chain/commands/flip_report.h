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

// The same in the few lines that a person reads: what was compared, how, the numbers that matter,
// and what is unusual but no reason for a warning.
std::string brief_text(const std::string& label, const FlipSummary& summary,
                       const std::string& first, const std::string& second);
std::string brief_text(const std::string& label, const ErrorSummary& summary,
                       const std::string& first, const std::string& second);
std::string brief_text(const std::string& label, const TmqiSummary& summary,
                       const std::string& first, const std::string& second);

// The numbers that matter alone: "mean 0.1, p99.9 0.4, max 0.7 at 12,30".
std::string numbers_text(const FlipSummary& summary);
std::string numbers_text(const ErrorSummary& summary);
std::string numbers_text(const TmqiSummary& summary);

/// ", 25 % ignored": the part of the pixels that does not count, where mask= or ignore= was given.
std::string ignored_text(const std::optional<double>& share);

/// How much of a comparison is printed.
enum class Detail {
    Nothing, ///< but what fails or warns
    Line,    ///< of a frame: its verdict, or its numbers where nothing is judged
    Brief,   ///< a few lines
    All      ///< every fact, one a line
};
/// As print= and -v ask for it; of themselves a pair is Brief, a frame Line and a frame of a check
/// Nothing.
Detail detail(const Session& session, const Call& call);

/// Part of the frame's result, where there is a check. judge() adds the threshold to it.
void record(Session& session, const Call& call, sequence::Measurement measurement, size_t test = 0);

/// The verdict of a command with limits as the last line of its report: PASS, WARNING or FAIL, the
/// limits that say so, the worst pixel where there is one, and the test image. Warns, and counts in
/// the session. Whatever is not on the good side of a limit fails. `ignored`: the part of the
/// pixels that does not count, as ignored_text() takes it. Returns whether one of fail= was missed.
bool judge(Session& session, const Call& call, const Limits& limits,
           const std::function<double(const std::string& quantity)>& measure,
           const std::optional<sequence::Position>& worst, size_t test = 0,
           const std::optional<double>& ignored = {});

} // namespace tonetool::chain
