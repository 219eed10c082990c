// SPDX-License-Identifier: BSD-3-Clause
// The commands: one row each, written with Row. Help, checks and tests are all read from these
// rows.
#pragma once

#include <deque>
#include <functional>
#include <optional>
#include <string>
#include <utility>
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
    bool of_curve = false; ///< a parameter of single tone curves

    bool writes() const { return hint == "PREFIX"; }
};
using Modifiers = std::vector<Modifier>;
/// One list of them all.
Modifiers concatenated(const std::vector<Modifiers>& lists);

/// In the order in which help lists them: what the program is for comes first.
enum class Group {
    Compare,
    Check,
    Measure,
    Color,
    Read,
    Write,
    Print,
    Channels,
    Geometry,
    Arithmetic,
    Filter,
    Composite,
    Create,
    Metadata,
    Stack,
    Control,
    General
};
inline constexpr int kGroupCount = 17;
std::string group_title(Group group);

using Run = std::function<void(Session&, const Call&)>;
using Count = int (*)(const Call&);
/// What a command measures of all frames of a shot before it runs in one of them.
struct ShotNeed {
    std::string mode;   ///< "shot", "eye", "smooth"; empty: nothing
    bool asked = false; ///< by name; else where there are several frames
    std::string lack;   ///< why what it would measure is not in the statistics of a shot
};
using ShotNeedOf = ShotNeed (*)(const Call&);
inline void do_nothing(Session&, const Call&) {}
inline constexpr int kAnyNumber = -1;

struct Command {
    Strings names;  ///< without dashes; the first one is the one that messages use
    Strings args;   ///< names of the arguments; "[NAME]" may be left out, only as the last
    int pops = 0;   ///< images taken from the stack
    int pushes = 0; ///< images put on it, or kAnyNumber
    Group group = Group::General;
    Modifiers modifiers;
    std::string help; ///< one line
    Run run = nullptr;
    Run check = nullptr; ///< reads the modifiers as `run` does, before there is an image
    /// Wait for images that are still to come, as oiiotool does with operators.
    bool postponable = true;
    /// Where the numbers of images depend on a modifier; else nullptr.
    Count pops_of = nullptr;
    Count pushes_of = nullptr;
    ShotNeedOf shot_need = nullptr; ///< nullptr: it measures nothing of shots
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
    /// It has subimages= and allsubimages=, behind its other modifiers.
    bool of_subimages = false;
    Strings frequent = {}; ///< modifiers that help names first
    /// A reference and a test become a map of errors: one channel of floats.
    bool makes_map = false;

    /// As messages call it: "hdrflip", "-o".
    std::string label() const;

    /// Its arguments FILE or FILENAME are read, in the groups but Write and Check, or written.
    bool writes() const;
    /// A modifier of that name says where files go.
    bool writes_to(const std::string& key) const;
    /// It ends in a verdict whatever its modifiers are: fails, unless it passes.
    bool always_judges = false;

    bool takes_all = false; ///< all images of the stack, by itself
    /// Something of it remains when the chain has ended.
    bool outlives_chain() const { return of_process || writes(); }
};

/// An argument that is a file which a command of comparisons writes.
inline constexpr char kLimitsArgument[] = "LIMITS";

/// The hint of a modifier that is a file where it has a '.' or a '/', else a name.
inline constexpr char kCurveHint[] = "NAME|FILE";

/// Whether an argument or modifier of that name or hint is a file, or may be one.
bool names_file(const std::string& hint);
/// The same of a value of that modifier.
bool value_names_file(const Modifier& modifier, const std::string& value);

/// A row as it is written: command("label NAME", "Label the current image", label).images(1, 1).
class Row {
public:
    Row(const std::string& usage, std::string help, Run run);

    /// Taken from the stack and put on it; without this none are.
    Row& images(int pops, int pushes) {
        return set(&Command::pops, pops).set(&Command::pushes, pushes);
    }
    /// Of one call, where a modifier says how many.
    Row& images_of(Count pops, Count pushes = nullptr) {
        return set(&Command::pops_of, pops).set(&Command::pushes_of, pushes);
    }
    Row& modifier(const std::string& key, const std::string& hint, const std::string& help) {
        return modifiers(Modifiers{{key, hint, help}});
    }
    template <class... Lists>
    Row& modifiers(const Lists&... lists) {
        return set(&Command::modifiers, concatenated({m_command.modifiers, lists...}));
    }
    /// Instead of the family's.
    Row& in(Group group) {
        m_group = group;
        return *this;
    }
    Row& operation(std::string name) { return set(&Command::operation, std::move(name)); }
    Row& measures_shots(ShotNeedOf need) { return set(&Command::shot_need, need); }
    Row& at_once() { return set(&Command::postponable, false); }
    Row& control() { return set(&Command::control, true); }
    Row& of_process() { return set(&Command::of_process, true); }
    Row& manner() { return set(&Command::manner, true); }
    Row& whole_line() {
        return set(&Command::whole_line, true).set(&Command::run, Run(do_nothing));
    }
    Row& checked(Run check) { return set(&Command::check, std::move(check)); }
    Row& keeps_header() { return set(&Command::keeps_header, true); }
    Row& makes_map() { return set(&Command::makes_map, true); }
    Row& takes_all() { return set(&Command::takes_all, true).images(0, kAnyNumber); }
    Row& judges() { return set(&Command::always_judges, true); }
    /// "fail,layer": the modifiers that are used most, in the order in which help names them.
    Row& frequent(const std::string& keys) { return set(&Command::frequent, split(keys, ',')); }
    Row& of_subimages() { return set(&Command::of_subimages, true); }

    Command finished(Group group_of_family, bool own) const;

private:
    template <class T>
    Row& set(T Command::*member, T value) {
        m_command.*member = std::move(value);
        return *this;
    }

    Command m_command;
    std::optional<Group> m_group;
};

using Rows = std::vector<Row>;

/// `usage`: names and arguments, "no-clobber|noclobber", "resize GEOM". What is read from the whole
/// line has no `run`.
inline Row command(const std::string& usage, std::string help, Run run = nullptr) {
    return {usage, std::move(help), std::move(run)};
}

/// A family's rows, which help lists in that group unless they name another; `own`: none of
/// oiiotool's. Before anything runs: rows are looked up without a lock.
void add_commands(Group group, const Rows& rows, bool own = false);

/// All rows.
const std::deque<Command>& all_commands();

/// The row of that name, or nullptr.
const Command* find_command(const std::string& name);

/// "--x" for a name like that one, or "".
std::string nearest_command(const std::string& name);

/// "did you mean --x, --y?" or "see --help".
std::string suggest_command(const std::string& name);

} // namespace tonetool::chain
