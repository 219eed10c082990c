// What one command line knows while it runs: the stack, the settings, what was found.
#pragma once

#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "chain/image.h"

namespace tonetool::chain {

/// A data type as -d and datatype= name it.
struct NamedType {
    OIIO::TypeDesc type;
    int bits = 0;
};

/// What -d, --compression and the like ask of the outputs that follow.
struct OutputSettings {
    std::optional<NamedType> type;
    std::map<std::string, NamedType> type_of_channel;
    std::set<std::string> matched_channels; ///< those of the above that some output had
    std::string compression;
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
    OutputSettings output;

    bool verbose = false, quiet = false, warnings_exit = false;
    bool info = false, info_verbose = false, stats = false;

    std::string color_config; ///< file of the OpenColorIO configuration; empty: $OCIO
    uint64_t memory = 0;      ///< bound of the comparisons in bytes; 0: none was given

    // What the exit status is made from.
    bool produced = false; ///< something was written, printed or measured
    int errors = 0, warnings = 0, failures = 0;

    /// The name of an operator that waits for images; empty if none does.
    std::string waiting;

    /// Reads what the stack and the labels still have to read from a file about to be replaced.
    void keep_pixels_of(const std::string& filename);

    void push(ImagePtr image) { stack.push_back(std::move(image)); }

    void error(const std::string& where, const std::string& what);
    void warning(const std::string& where, const std::string& what);
    /// A line of a measurement: not under -q.
    void report(const std::string& line);
    /// A line that was asked for by name, or a failure: also under -q.
    void print(const std::string& line);

    /// 1 any error, 3 a threshold exceeded, 2 only warnings and --warnings-exit, else 0.
    int exit_status() const;
};

} // namespace tonetool::chain
