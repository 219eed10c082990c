// SPDX-License-Identifier: BSD-3-Clause
// What one command line knows while it runs: the stack, the settings, what was found.
#pragma once

#include <functional>
#include <iosfwd>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "chain/language/policy.h"
#include "chain/session/outcome.h"
#include "chain/session/settings.h"
#include "chain/session/stack.h"
#include "sequence/frames/file_stamp.h"
#include "sequence/frames/item.h"
#include "tonetool/cgtmo.h"
#include "tonetool/shot_numbers.h"

namespace tonetool::sequence {
struct ExposureSample;
struct FramePainter;
struct FrameResult;
struct ShotExposures;
} // namespace tonetool::sequence

namespace tonetool::chain {

/// What the frame loop has put in place of wildcards.
struct Frame {
    int number = 0, padding = 0;
    std::string view;
    bool loops = false;
    std::vector<size_t> stills{};  ///< places of words that --wildcardoff says to be the same
    std::vector<size_t> varying{}; ///< of those that are others in other frames
    std::vector<size_t> found{};   ///< of names found on the disk, in which nothing is evaluated
    std::string name{}, method{};  ///< of a named case

    sequence::Item item() const { return {number, view, name, method}; }
};

/// The frames of a command line, which may run at the same time, must not write one file.
class WrittenFiles {
public:
    /// A CommandError if another frame has written the file.
    void claim(const std::string& filename, const sequence::Item& frame);

private:
    std::mutex m_mutex;
    std::map<std::string, sequence::Item> m_frame_of;
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

/// Where a check collects what commands find, and what it tells them; null outside a check.
struct CheckPart {
    sequence::FrameResult* result = nullptr;   ///< collects the measurements of commands
    sequence::FramePainter* painter = nullptr; ///< with a report: draws its images
    std::string absent{};     ///< the frame of the approved version, if there is none
    std::string why_absent{}; ///< what is said of it where its name says nothing; else empty
    bool between = false;     ///< and that has earlier and later ones
    /// The range of exposures=shot or of a file; while the range is still being measured, the place
    /// for the frame's sample.
    const sequence::ShotExposures* shot = nullptr;
    sequence::ExposureSample* sample = nullptr;
};

/// Another frame of the shot, as a command needs it, and the files that it was made of.
struct ShotFrame {
    SteadyFrame frame;
    Strings files{};
};

/// What is known of all frames when one of them runs.
struct ShotPart {
    /// The statistics that commands have measured, by the places of their words.
    std::map<size_t, ShotStatistics> measured;
    /// While a command still measures: where it is, and the place for the frame's light.
    size_t at = 0;
    FrameLight* light = nullptr;
    /// While the frame is made for others: the place for it, of the command at `at`.
    ShotFrame* frame = nullptr;
    /// What the command at this place needs of another frame; null: there are no others.
    std::function<ShotFrame(size_t at, int number)> find;
};

struct Session {
    Session(std::ostream& out_stream, std::ostream& err_stream, std::string command)
        : out(out_stream),
          err(err_stream),
          command_line(std::move(command)) {}

    Settings settings;
    Stack stack;
    Outcome outcome;

    // What it runs in.
    std::ostream& out;
    std::ostream& err;
    std::string command_line;
    Flow flow;
    Frame frame;
    Policy policy{false, "", 0};
    sequence::FileLog files; ///< that were read or looked for, as they were opened
    /// The words at one place of the command line in all frames.
    std::function<Strings(size_t at)> in_all_frames;
    bool for_images = false; ///< what is left on the stack is the result
    /// What was not compared must not be passed: an image that no command used is an error.
    bool judges = false;
    CheckPart check;
    ShotPart shot;
    /// Which frame has written which file, of all frames of the command line in this process.
    std::shared_ptr<WrittenFiles> written;

    /// Says that this frame writes that file; a CommandError if another one has, which --compat
    /// lets pass as oiiotool does.
    void claim(const std::string& filename);

    /// Where a file is that the chain names.
    std::string file(const std::string& name);

    /// What is computed is written in the widest type of all images that were read for it.
    void note_format(Image& image);

    /// What outputs are told; `where` is the command that their warnings name.
    Writer writer(const std::string& where);

    /// Where errors and warnings go.
    std::ostream& complaints() { return settings.complains_to_out ? out : err; }
    /// `ends`: unless --no-error-exit, the command line ends with it.
    void error(const std::string& where, const std::string& what, bool ends = true);
    void warning(const std::string& where, const std::string& what);
    /// A warning if the image has subimages beyond the first, which a command looks at.
    void warn_of_other_parts(const std::string& where, const Image& image);
    /// A line of a measurement: not under -q.
    void report(const std::string& line);
    /// A line that was asked for by name, or a failure: also under -q.
    void print(const std::string& line);

    /// What error() and warning() print.
    std::string message(const char* kind, const std::string& where, const std::string& what) const;

    int exit_status() const { return outcome.exit_status(settings); }
};

/// The OpenColorIO configuration, loaded with its first use.
OIIO::ColorConfig& color_config(Session& session);

} // namespace tonetool::chain
