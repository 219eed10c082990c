// SPDX-License-Identifier: BSD-3-Clause
// What one command line knows while it runs: the stack, the settings, what was found.
#pragma once

#include <OpenImageIO/color.h>
#include <ctime>
#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "chain/images/inspect.h"
#include "chain/images/output.h"
#include "chain/language/policy.h"
#include "sequence/frames/file_stamp.h"
#include "sequence/results/diff_limits.h"
#include "text/text.h"

namespace tonetool::chain {
struct CheckPart;
} // namespace tonetool::chain

namespace tonetool::chain {

/// What the frame loop has put in place of wildcards.
struct Frame {
    int number = 0, padding = 0;
    std::string view;
    bool loops = false;
    std::vector<size_t> stills{};  ///< places of words that --wildcardoff says to be the same
    std::vector<size_t> varying{}; ///< of those that are others in other frames
    std::vector<size_t> found{};   ///< of names found on the disk, in which nothing is evaluated
};

/// The frames of a command line, which may run at the same time, must not write one file.
class WrittenFiles {
public:
    /// A CommandError if a frame of another number or view has written the file.
    void claim(const std::string& filename, int number, const std::string& view);

private:
    std::mutex m_mutex;
    std::map<std::string, std::pair<int, std::string>> m_frame_of; ///< number and view
};

/// An --if, --while or --for that is not ended yet.
struct Block {
    std::string kind;
    size_t begin = 0;                    ///< index of its first word
    bool running = true;                 ///< its commands are executed
    bool outside = true;                 ///< those around it are
    std::string variable{};              ///< of a for
    double value = 0, end = 0, step = 1; ///< of a for
};

struct Flow {
    size_t next = 0;    ///< index of the next word
    size_t command = 0; ///< and of the command's own
    std::vector<Block> blocks;
    bool running() const { return blocks.empty() || blocks.back().running; }
};

struct Session {
    Session(std::ostream& out_stream, std::ostream& err_stream, std::string command)
        : out(out_stream),
          err(err_stream),
          command_line(std::move(command)) {}

    std::ostream& out;
    std::ostream& err;
    std::string command_line;

    std::vector<ImagePtr> stack; ///< the top is the last
    std::map<std::string, ImagePtr> labels;
    OIIO::ParamValueList variables; ///< of --set and --for
    Frame frame;
    Policy policy{false, "", 0};
    sequence::FileLog files; ///< that were read or looked for, as they were opened
    /// The words at one place of the command line in all frames.
    std::function<Strings(size_t at)> in_all_frames;
    Flow flow;

    bool compat = false;        ///< lenient as oiiotool is
    bool all_subimages = false; ///< -a: and all MIP levels
    bool dry_run = false, no_clobber = false, update = false, debug = false, runstats = false;
    bool verbose = false, quiet = false, warnings_exit = false, error_exit = true;
    bool evaluate = true;    ///< {expressions} are replaced by their values
    bool for_images = false; ///< what is left on the stack is the result
    bool autocc = false, autocc_unpremult = false, autoorient = false;
    bool complains_to_out = false; ///< errors and warnings go to the standard output
    bool metamerge = false;        ///< results have the metadata of all inputs

    ReadOptions input;
    std::string missing_file = "error"; ///< or what stands in for it: "black", "checker"
    ReadTypes types;
    std::optional<OIIO::ImageSpec> first_header; ///< of the image read first
    std::time_t newest_input = 0;
    OutputSettings output;
    std::set<std::string> matched_channels; ///< those of -d CHAN=TYPE that some output had

    std::map<std::string, double> seconds; ///< that commands took, for --runstats
    sequence::DiffLimits diff;
    std::string unused_limit; ///< the option that set one of them which no --diff has looked at yet
    Listing list;             ///< what is printed of files as they are read

    std::string color_config; ///< file of the OpenColorIO configuration; empty: $OCIO
    std::shared_ptr<OIIO::ColorConfig> ocio; ///< what is in it, once it is needed
    uint64_t memory = 0; ///< bound of the comparisons in bytes; 0: none was given
    int parallel = 1;    ///< frames that share that memory

    // What the exit status is made from.
    bool produced = false;         ///< something was written, printed or measured
    bool produced_by_name = false; ///< --echo and the like: also of images that no command used
    bool wrote = false;            ///< -o has
    bool differs = false;          ///< a --diff has failed
    bool aborted = false;          ///< by an error
    bool misused = false;          ///< --compat: cannot be taken apart, --help is the answer
    int errors = 0, warnings = 0, failures = 0;
    std::string first_error;
    Strings warning_texts;
    CheckPart* check = nullptr; ///< of a check: what its commands find goes there

    /// The name of an operator that waits for images; empty if none does.
    std::string waiting;

    /// What was not compared must not be passed: an image that no command used is an error.
    bool judges = false;
    /// Which frame has written which file, of all frames of the command line in this process.
    std::shared_ptr<WrittenFiles> written;
    Strings claimed; ///< by this frame
    /// Says that this frame writes that file; a CommandError if another one has, which --compat
    /// lets pass as oiiotool does.
    void claim(const std::string& filename);

    /// Where a file is that the chain names.
    std::string file(const std::string& name);

    /// Reads what the stack and the labels still have to read from a file about to be replaced.
    void keep_pixels_of(const std::string& filename);

    /// Files are described when they are read.
    bool listing() const { return list.info || list.stats || list.hash || list.dump; }

    /// What is computed is written in the widest type of all images that were read for it.
    void note_format(Image& image);

    /// What outputs are told; `where` is the command that their warnings name.
    Writer writer(const std::string& where);

    void push(ImagePtr image) { stack.push_back(std::move(image)); }

    /// Where errors and warnings go.
    std::ostream& complaints() { return complains_to_out ? out : err; }
    /// `ends`: unless --no-error-exit, the command line ends with it.
    void error(const std::string& where, const std::string& what, bool ends = true);
    void warning(const std::string& where, const std::string& what);
    /// A warning if the image has subimages beyond the first, which a command looks at.
    void warn_of_other_parts(const std::string& where, const Image& image);
    /// A line of a measurement: not under -q.
    void report(const std::string& line);
    /// A line that was asked for by name, or a failure: also under -q.
    void print(const std::string& line);

    /// 1 any error, 3 a threshold exceeded, 2 only warnings and --warnings-exit, else 0.
    int exit_status() const;
};

/// The OpenColorIO configuration, loaded with its first use.
OIIO::ColorConfig& color_config(Session& session);

} // namespace tonetool::chain
