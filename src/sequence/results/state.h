// --state: what finished frames came to, kept so that a run that was killed goes on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sequence/frames/file_sequence.h"
#include "sequence/frames/file_stamp.h"

namespace tonetool::sequence {

/// What one run of the command line left.
struct Kept {
    std::string result;   ///< a JSON text: a FrameResult or an exposure sample
    std::string out, err; ///< what it printed
    int status = 0;
    std::vector<std::string> written{}; ///< files
};

/// What the result of one frame follows from. It is computed anew when any of it has changed.
struct Origin {
    std::vector<std::string> words; ///< of the command line, with this frame's names
    std::string rest;               ///< anything else, the shot's exposures
};

/// A folder of one file per frame, each written beside its place and renamed. A symbolic link in
/// place of such a file is not followed: reading takes it for none, writing refuses it.
class State {
public:
    /// Makes the folder if it is not there; a runtime_error if that fails. `kind` begins the names
    /// of the files: "frame", "exposures".
    State(std::string folder, std::string kind);

    /// What was kept of the frame, if it came of the same words and all files that its run opened
    /// and wrote are as they were: by device, inode, size and times.
    std::optional<Kept> find(const Item& item, const Origin& origin) const;
    /// `inputs`: what the run has opened, what stands behind recipes and configurations is added.
    /// Nothing is kept where one of them has changed since the run began. A runtime_error if it
    /// cannot be written.
    void keep(const Item& item, const Origin& origin, const FileLog& inputs,
              const Kept& kept) const;

    /// The file of a frame: always in the folder, whatever its view is called.
    std::string file(const Item& item) const;

private:
    std::string m_folder, m_kind;
};

} // namespace tonetool::sequence
