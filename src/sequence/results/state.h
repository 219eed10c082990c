// SPDX-License-Identifier: BSD-3-Clause
// --state: the results of finished frames, kept so that a killed run can be continued.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sequence/frames/file_sequence.h"
#include "sequence/frames/file_stamp.h"

namespace tonetool::sequence {

/// The output of one run of the command line.
struct Kept {
    std::string result;   ///< a JSON text: a FrameResult or an exposure sample
    std::string out, err; ///< the printed text
    int status = 0;
    std::vector<std::string> written{}; ///< files
};

/// Everything that the result of one frame depends on, beside files. The frame is checked anew when
/// any of it has changed.
struct Origin {
    std::vector<std::string> words; ///< words of the command line, with this frame's names
    std::string rest;               ///< anything else, such as the shot's exposures
};

/// A folder with one file per frame, each written to a temporary name and renamed. A symbolic link
/// in place of such a file is not followed: reading ignores it, writing refuses it.
class State {
public:
    /// Makes the folder if it is missing; throws a runtime_error if that fails. `kind` is the
    /// beginning of the file names: "frame", "exposures".
    State(std::string folder, std::string kind);

    /// The kept output of a frame, if it came from the same words and all files that its run opened
    /// or wrote are unchanged by device, inode, size and times.
    std::optional<Kept> find(const Item& item, const Origin& origin) const;
    /// `inputs` are the files that the run has opened; the files that recipes and configurations
    /// read are added. Nothing is kept if one of them has changed since the run began. Throws a
    /// runtime_error if the file cannot be written.
    void keep(const Item& item, const Origin& origin, const FileLog& inputs,
              const Kept& kept) const;

    /// The file of a frame: always inside the folder, whatever the name of the view.
    std::string file(const Item& item) const;

private:
    std::string m_folder, m_kind;
};

} // namespace tonetool::sequence
