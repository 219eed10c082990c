// What a check of a sequence found: frame by frame, and its verdict.
//
// In JSON (results_json.h) these are objects whose keys are the names of the fields here; nothing
// in them depends on time, host, thread or order of execution, so that the same frames give the
// same bytes however they were split.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tonetool::sequence {

/// What came of a frame or a shot, the better first. Only `Passed` says that a threshold was
/// looked at and held.
enum class Status {
    Passed,
    Measured,     ///< no threshold was asked for
    Warning,      ///< a fault or threshold that does not fail
    Failed,       ///< a threshold was exceeded, or a fault found
    SizeMismatch, ///< reference and test differ in size
    Missing,      ///< a file of the frame does not exist
    Unreadable,   ///< a file of the frame cannot be read, or not to its end
    Error,        ///< anything else that kept the frame from being checked
    Crashed       ///< the process that checked it was ended by a signal
};
/// "passed", "measured", "warning", "failed", "size mismatch", "missing", "unreadable", "error",
/// "crashed".
std::string status_name(Status status);
std::optional<Status> status_of_name(const std::string& name);
/// Of the program: 0, 2 for a warning if `warnings_exit`, 3 for a failure, 1 for all that is worse.
int exit_status(Status status, bool warnings_exit);

enum class Severity { Info, Warning, Error };
/// "info", "warning", "error".
std::string severity_name(Severity severity);
std::optional<Severity> severity_of_name(const std::string& name);

struct Position {
    int x = 0, y = 0;
    bool operator==(const Position& o) const { return x == o.x && y == o.y; }
};

/// A fault of a picture (--qc). An Error fails its frame, a Warning warns of it.
struct Fault {
    std::string code; ///< "nan", "firefly", "blacklayer", ...
    Severity severity = Severity::Error;
    std::string sentence; ///< for people
    std::string layer;    ///< or channel; empty: the whole picture
    std::optional<Position> position;
    std::optional<double> value, threshold; ///< what was measured, and what it may be
};

/// A threshold of one quantity.
struct Threshold {
    std::string quantity; ///< "p99"
    double value = 0;     ///< that was measured
    bool higher_is_better = false;
    std::optional<double> fail, warn;
};

/// Names with numbers, in an order that is the same for all frames.
using Numbers = std::vector<std::pair<std::string, double>>;
using Texts = std::vector<std::pair<std::string, std::string>>;

/// What one command measured of one pair (or picture).
struct Measurement {
    std::string command; ///< "hdrflip", "tmqi", ...
    std::string reference, test;
    Status status = Status::Measured;
    std::vector<Threshold> thresholds; ///< of different quantities: all must hold
    Numbers quantities; ///< the pool of the error map (mean, p99, ...), or the command's own
    std::vector<long long> histogram; ///< of the error map: 100 equal buckets over [0, 1]
    std::optional<Position> worst;    ///< pixel of the largest error
    long long pixels = 0;             ///< compared
    std::vector<double> exposures;    ///< stops, ascending
    Numbers parameters;               ///< ppd, the curve's, max-luminance, counts of bad pixels...
    Texts settings;                   ///< tonemapper, colour spaces, layers, ...
    std::vector<std::string> warnings;
};

/// One frame number (and view).
struct FrameResult {
    int frame = 0;
    std::string view;
    std::optional<int> test_frame; ///< of the test, paired by position with another number
    Status status = Status::Error;
    std::string message;         ///< the first thing that a person must know; empty where passed
    std::string reference, test; ///< files; reference is empty where there is only one sequence
    std::vector<Measurement> measurements; ///< in the order of the command line
    std::vector<Fault> faults;
    std::vector<std::string> warnings; ///< of the run; a frame with one is not passed
    std::string qc;                    ///< what --qc measured, a JSON text; empty without it
    double seconds = 0;                ///< it took; not part of any file
};

/// The luminance that the exposures of a whole shot follow from.
struct ShotExposures {
    double max_luminance = 0;              ///< the maximum of the frames' maxima
    double median_luminance = 0;           ///< the median of the frames' medians
    int frames = 0;                        ///< that were measured
    std::vector<std::string> references{}; ///< the files that were, by frame
    std::string folder{}; ///< of the file that this was read from; not part of any file
    bool operator==(const ShotExposures& o) const {
        return max_luminance == o.max_luminance && median_luminance == o.median_luminance &&
               frames == o.frames && references == o.references;
    }
};

struct ShotResult {
    /// The command line, without what says which frames, where to and how many at a time.
    std::vector<std::string> check;
    std::optional<ShotExposures> exposures;
    std::vector<FrameResult> frames; ///< by number, then view

    // All of these follow from the frames: see conclude().
    Status verdict = Status::Error;
    std::string sentence;      ///< the verdict for people
    std::vector<size_t> worst; ///< indices of the frames that did not pass, the worst first; where
                               ///< all did, of the frame with the largest error
};

/// What is wrong with the frame by its measurements and faults, if `status` says nothing worse
/// already: sets status and message.
void judge(FrameResult& frame);

/// Nothing was measured of the frame, and nothing else is wrong with it.
bool is_unmeasured(const FrameResult& frame);

/// Sorts the frames, finds the faults of --qc anew and fills verdict, sentence and worst. A shot
/// without a frame that was measured is an Error, never passed. A runtime_error if a frame is there
/// twice.
void conclude(ShotResult& shot);

/// A quantity by its name.
std::optional<double> quantity_of(const Measurement& measured, const std::string& name);

/// How bad a frame is beside another of the same status, more being worse: the measured value in
/// units of its threshold, or as it is (below 0 where higher is better) where there is none. A
/// value that is no number is worse than any other.
double badness(const FrameResult& frame);

} // namespace tonetool::sequence
