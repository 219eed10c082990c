// --state: what finished frames came to, kept so that a run that was killed goes on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sequence/file_sequence.h"

namespace tonetool::sequence {

/// What one run of the command line left.
struct Kept {
    std::string result;   ///< a JSON text: a FrameResult or an exposure sample
    std::string out, err; ///< what it printed
    int status = 0;
};

/// What the result of one frame follows from. It is computed anew when any of it has changed.
struct Origin {
    std::vector<std::string> words;   ///< of the command line, with this frame's names
    std::string rest;                 ///< anything else, the shot's exposures
    std::vector<std::string> outputs; ///< files that the run has written
};

/// A folder of one file per frame, each written beside its place and renamed.
class State {
public:
    /// Makes the folder if it is not there; a runtime_error if that fails. `kind` begins the names
    /// of the files: "frame", "exposures".
    State(std::string folder, std::string kind);

    /// Sizes and times of all files that the words name, before the run: `key` for the other two.
    static std::string key(const Origin& origin);
    /// What was kept of the frame under that key, if its outputs are as the run left them.
    std::optional<Kept> find(const Item& item, const std::string& key) const;
    /// A runtime_error if it cannot be written.
    void keep(const Item& item, const std::string& key, const Origin& origin,
              const Kept& kept) const;

    /// The file of a frame: always in the folder, whatever its view is called.
    std::string file(const Item& item) const;

private:
    std::string m_folder, m_kind;
};

} // namespace tonetool::sequence
