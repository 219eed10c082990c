// SPDX-License-Identifier: BSD-3-Clause
// The results of a check: those of each frame, and the verdict of the shot.
//
// In JSON (results_json.h) these are objects whose keys are the names of the fields here; nothing
// in them depends on time, host, thread or order of execution, so the same frames give the same
// bytes however they were split.
#pragma once

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "sequence/frames/item.h"
#include "tonetool/export.h"

namespace tonetool::sequence {

struct QcRecord;

/// The status of a frame or a shot, the best first. Only `Passed` says that a threshold was tested
/// and held.
enum class Status {
    Passed,
    Measured,     ///< no threshold was asked for
    Skipped,      ///< of a suite, which says why: never looked at, and never passed
    Warning,      ///< a fault or threshold that does not fail
    Failed,       ///< a threshold was exceeded, or a fault found
    SizeMismatch, ///< reference and test differ in size
    Missing,      ///< a file of the frame does not exist
    Unreadable,   ///< a file of the frame cannot be read, or not to its end
    Error,        ///< anything else that kept the frame from being checked
    Crashed       ///< the process that checked it was ended by a signal
};
/// "passed", "measured", "skipped", "warning", "failed", "size mismatch", "missing", "unreadable",
/// "error", "crashed".
std::string status_name(Status status);
std::optional<Status> status_of_name(const std::string& name);
/// Of all frames: the worst that is not skipped; an Error where nothing else is there.
Status verdict_of(const std::vector<Status>& frames);
/// A frame that did not pass, and that nothing says to leave out.
bool has_problem(Status status);
/// The exit status of the program: 0, 2 for a warning if `warnings_exit`, 3 for a failure, 1 for
/// everything worse.
int exit_status(Status status, bool warnings_exit);

enum class Severity { Info, Warning, Error };
/// "info", "warning", "error".
std::string severity_name(Severity severity);
std::optional<Severity> severity_of_name(const std::string& name);

struct Position {
    int x = 0, y = 0;
    bool operator==(const Position& o) const { return x == o.x && y == o.y; }
};

/// "320x180+0+0": a window of x, y, width and height.
std::string window_text(const std::array<int, 4>& window);

/// A fault of an image (--qc, --against). The severity Error fails the frame, Warning gives it a
/// warning.
struct Fault {
    std::string code; ///< "nan", "firefly", "blacklayer", ...
    Severity severity = Severity::Error;
    std::string sentence; ///< the message for people
    std::string layer;    ///< layer or channel; empty: the whole image
    std::optional<Position> position;
    std::optional<double> value, threshold;        ///< the measured value and its limit
    std::optional<std::array<int, 4>> rectangle{}; ///< x, y, width, height of a place
    std::string command{};                         ///< that found it, if it is not --qc
};

/// A threshold of one quantity.
struct Threshold {
    std::string quantity; ///< "p99"
    double value = 0;     ///< the measured value
    bool higher_is_better = false;
    std::optional<double> fail, warn;
    /// `fail` follows from all frames of the shot (fail=auto): not set until they are there, NaN
    /// where they are too few or too unlike each other for a limit.
    bool automatic = false;
};

/// Pairs of names and numbers, in an order that is the same for all frames.
using Numbers = std::vector<std::pair<std::string, double>>;
using Texts = std::vector<std::pair<std::string, std::string>>;

/// The measurement of one command on one pair (or image).
struct Measurement {
    std::string command; ///< "hdrflip", "tmqi", ...
    std::string reference, test;
    Status status = Status::Measured;
    /// Thresholds of different quantities, all of which must hold.
    std::vector<Threshold> thresholds;
    /// Pooled values of the error map (mean, p99, ...), or the command's own quantities.
    Numbers quantities;
    std::vector<long long> histogram; ///< histogram of the error map: 100 equal buckets over [0, 1]
    std::optional<Position> worst;    ///< the pixel of the largest error
    long long pixels = 0;             ///< number of compared pixels
    std::vector<double> exposures;    ///< stops, ascending
    Numbers parameters;               ///< ppd, the curve's, max-luminance, counts of bad pixels...
    Texts settings;                   ///< tonemapper, colour spaces, layers, ...
    /// Of a command that does not measure an error but tells noise from change: "different",
    /// "equal" or "not enough samples", what it means, and what was found.
    std::string verdict, sentence;
    std::vector<std::string> evidence;
    std::vector<std::string> warnings;
    std::string attribution; ///< whose error it is, as JSON (attribution.h); empty: not asked for
};

/// An approved image that a case was compared with, though another fits better.
struct Tried {
    std::string file;
    std::string status; ///< that the case would have
    double badness = 0; ///< badness() of it
};

/// What a suite says of one of its cases.
struct SuiteCase {
    /// The words of its check, where its rows change those of the suite.
    std::vector<std::string> check;
    int line = 0;             ///< of the row that set its limit; 0: of no row
    std::string why;          ///< of its rows
    std::string sha256;       ///< of the test's file, where images are approved
    std::string key;          ///< of the approved image, where it has one
    std::vector<Tried> tried; ///< beside the approved image that is the reference
};

/// The suite that the cases are of.
struct SuiteOrigin {
    std::string name;   ///< "lookdev"; empty: it has none
    std::string file;   ///< as it was opened
    std::string sha256; ///< of its text
    std::string store;  ///< the folder of its approved images; empty: it has none
    std::string key;    ///< of --key
    int test_line = 0;  ///< where it says which images are tested
};

/// One frame number (and view).
struct FrameResult {
    int frame = 0;
    std::string view;
    std::string name{}, method{};  ///< of a named case (%N, %M), which `frame` is 0 of without #
    std::optional<int> test_frame; ///< the test's number, if it is paired by position and differs
    Status status = Status::Error;
    std::string message;         ///< the first problem, for people; empty if the frame passed
    std::string reference, test; ///< files; `reference` is empty if there is only one sequence
    std::vector<Measurement> measurements; ///< in the order of the command line
    std::vector<Fault> faults;
    /// Warnings of the run; a frame with a warning has not passed.
    std::vector<std::string> warnings;
    std::string qc;      ///< the facts that --qc measured, as JSON; empty without --qc
    std::string against; ///< the same of --against
    /// Why --against has judged nothing of it, and so does not pass it; conclude() finds it.
    std::string unjudged{};
    /// What `qc` says, where conclude() was to keep it: parts are judged twice, alone and joined.
    std::shared_ptr<QcRecord> record;
    SuiteCase of_suite{};
    double seconds = 0; ///< time of the run; not part of any file

    Item item() const { return {frame, view, name, method}; }
};

/// The luminances that the exposures of a whole shot follow from.
struct ShotExposures {
    double max_luminance = 0;              ///< the maximum of the frames' maxima
    double median_luminance = 0;           ///< the median of the frames' medians
    int frames = 0;                        ///< number of measured frames
    std::vector<std::string> references{}; ///< the measured files, by frame
    std::string folder{}; ///< folder of the file that this was read from; not part of any file
    bool operator==(const ShotExposures& o) const {
        return max_luminance == o.max_luminance && median_luminance == o.median_luminance &&
               frames == o.frames && references == o.references;
    }
};

/// That somebody has looked at the faults of a frame and lets them pass (--accept).
struct Acceptance {
    int frame = 0;
    std::string view;
    std::string code;  ///< of the faults
    std::string layer; ///< empty: in any
    std::string by, why;
    std::string name{}, method{}; ///< of a named case

    Item item() const { return {frame, view, name, method}; }
};

struct ShotResult {
    /// The canonical command line: without the words that only say which frames run, how many at a
    /// time, and where results go.
    std::vector<std::string> check;
    std::optional<ShotExposures> exposures;
    std::vector<FrameResult> frames; ///< sorted by number, then view

    // conclude() computes all of these from the frames.
    Status verdict = Status::Error;
    std::string sentence; ///< the verdict for people
    /// Indices of the frames that did not pass, the worst first; where all did, of the frame with
    /// the largest error.
    std::vector<size_t> worst;

    std::vector<Acceptance> accepted{}; ///< that conclude() heeds
    std::optional<SuiteOrigin> suite{};
    size_t cases = 0; ///< that there are, where --only chose some of them; else 0
    /// Name and version of what measured; empty where a file says none.
    std::string program = std::string("tonetool ") + version();
};

/// Sets status and message of a frame from its measurements and faults, unless its status is
/// already worse.
void judge(FrameResult& frame);

/// Whether a test of the frame has said neither yes nor no, and nothing is worse: it has not
/// passed, whatever its status.
bool is_undecided(const FrameResult& frame);

/// Whether its frames are cases with names.
bool is_named(const ShotResult& shot);

/// That of the suite; "check" where nothing names it.
std::string check_name(const ShotResult& shot);

/// Those of its frames.
std::vector<Status> statuses_of(const ShotResult& shot);

/// Whether nothing was measured of the frame although nothing is wrong with it.
bool is_unmeasured(const FrameResult& frame);

/// Sorts the frames, finds the faults of --qc and --against anew but for what is accepted, and
/// fills verdict, sentence and worst. A shot without any measured frame is an Error, never Passed.
/// Throws a runtime_error if a frame is there twice. `keep_records`: those of --qc, for the next
/// time.
void conclude(ShotResult& shot, bool keep_records = false);

/// A quantity by its name.
std::optional<double> quantity_of(const Measurement& measured, const std::string& name);

/// The rank of a frame among those of the same status, higher being worse: the measured value in
/// units of its threshold; without a threshold the value itself, negated where higher is better.
/// NaN is worse than any other value.
double badness(const FrameResult& frame);

/// Whether it is one image, of a command line without frames.
bool is_still(const ShotResult& shot);

} // namespace tonetool::sequence
