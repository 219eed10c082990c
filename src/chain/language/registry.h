// SPDX-License-Identifier: BSD-3-Clause
// The commands: one row each. Help, checks and tests are all read from these rows.
#pragma once

#include <deque>
#include <functional>
#include <string>
#include <vector>

#include "text/text.h"

namespace tonetool::chain {

class Call;
struct Session;

struct Modifier {
    std::string key;
    /// What a value looks like: "0|1", "X", "NAME"; "FILE" or "LAYER|FILE" is read, "PREFIX"
    /// written.
    std::string hint;
    std::string help;

    bool writes() const { return hint == "PREFIX"; }
};

/// In the order in which help lists them.
enum class Group {
    General,
    Control,
    Read,
    Write,
    Print,
    Metadata,
    Compare,
    Measure,
    Check,
    Create,
    Arithmetic,
    Geometry,
    Filter,
    Composite,
    Color,
    Channels,
    Stack
};
inline constexpr int kGroupCount = 17;
std::string group_title(Group group);

/// What a command takes and leaves, and where help lists it.
struct Shape {
    Strings names;  ///< without dashes; the first one is the one that messages use
    Strings args;   ///< names of the arguments; "[NAME]" may be left out, only as the last
    int pops = 0;   ///< images taken from the stack
    int pushes = 0; ///< images put on it, or any_number
    Group group = Group::General;
};

using Run = std::function<void(Session&, const Call&)>;
inline constexpr int kAnyNumber = -1;

struct Command : Shape {
    std::vector<Modifier> modifiers;
    std::string help; ///< one line
    Run run = nullptr;
    /// Wait for images that are still to come, as oiiotool does with operators.
    bool postponable = true;
    /// Where the numbers of images depend on a modifier; else nullptr.
    int (*pops_of)(const Call&) = nullptr;
    int (*pushes_of)(const Call&) = nullptr;
    /// --if and the like: seen also where commands are skipped.
    bool control = false;
    std::string operation = {}; ///< of oiiotool's on pixels: see Call::operation
    bool own = false;           ///< not one of oiiotool's: strict with --compat, too
    /// What it sets is the process's and not the chain's.
    bool of_process = false;
    bool manner = false; ///< says how a line runs, not what comes of it
    /// Read from the whole line before it runs; does nothing when its turn comes. "--frames=1-9" is
    /// "--frames 1-9".
    bool whole_line = false;
    /// Each image leaves it with the windows, the number of channels and the data type that it
    /// came with, as do images that are read after it.
    bool keeps_header = false;
    /// A reference and a test become a map of errors: one channel of floats.
    bool makes_map = false;

    /// As messages call it: "hdrflip", "-o".
    std::string label() const;

    /// Its arguments FILE or FILENAME are read, in the groups but Write and Check, or written.
    bool writes() const;
    /// A modifier of that name says where files go.
    bool writes_to(const std::string& key) const;
    /// Something of it remains when the chain has ended.
    bool outlives_chain() const { return of_process || writes(); }
};

/// Whether an argument or modifier of that name or hint is a file, or may be one.
bool names_file(const std::string& hint);

/// The row of a command that sets something of the process, or says how a line runs.
Command of_process(Command row);
Command of_manner(Command row);

/// The row, here or in a table of the commands, of one that keeps headers.
template <class Row>
Row keeping_header(Row row) {
    row.keeps_header = true;
    return row;
}
/// All of them.
std::vector<Command> keeping_headers(std::vector<Command> rows);

/// The row of a command that takes and leaves no image.
Command setting(Group group, Strings names, Strings args, std::string help, Run run,
                std::vector<Modifier> modifiers = {});

/// Rows of the rooms above. Before anything runs: rows are looked up without a lock.
void add_commands(std::vector<Command> rows);

/// All rows.
const std::deque<Command>& all_commands();

/// The row of that name, or nullptr.
const Command* find_command(const std::string& name);

/// "--x" for a name like that one, or "".
std::string nearest_command(const std::string& name);

/// "did you mean --x, --y?" or "see --help".
std::string suggest_command(const std::string& name);

// The families, one file each.
std::vector<Command> general_commands();
std::vector<Command> control_commands();
std::vector<Command> read_commands();
std::vector<Command> write_commands();
std::vector<Command> texture_commands();
std::vector<Command> inspect_commands();
std::vector<Command> color_commands();
std::vector<Command> channel_commands();
std::vector<Command> stack_commands();
std::vector<Command> metadata_commands();
std::vector<Command> create_commands();
std::vector<Command> arithmetic_commands();
std::vector<Command> geometry_commands();
std::vector<Command> filter_commands();
std::vector<Command> composite_commands();
std::vector<Command> ocio_commands();

} // namespace tonetool::chain
