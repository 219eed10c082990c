// SPDX-License-Identifier: BSD-3-Clause
// The doors to command lines: the program, recipes and Python run them here.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <iosfwd>
#include <string>
#include <vector>

#include "chain/language/policy.h"
#include "text/text.h"

namespace tonetool::runs {

/// The commands of all rooms are in the registry from now on. `run` and `evaluate` see to it; other
/// readers of the registry call it first.
void know_all_commands();

/// Run the words of a command line (without the program's name) from left to right. Returns the
/// exit status: 0 passed; 1 an error; 2 only warnings, with --warnings-exit; 3 a threshold was
/// exceeded. No exception leaves it.
///
/// `workers`: frames of a check run in processes of their own, copies of this one, so that a crash
/// in a library loses one frame. Not for programs that have started threads.
int run(const Strings& words, std::ostream& out, std::ostream& err, bool workers = false);

/// An image that a chain has left.
struct Left {
    std::string name;  ///< the file, or what it was made from
    std::string label; ///< that --label gave it, or ""
    /// The subimages as they are in memory, without MIP levels below the largest.
    std::vector<OIIO::ImageBuf> subimages;
    /// The data type that each would be written with.
    std::vector<OIIO::TypeDesc> formats;
};

struct Evaluation {
    int status = 0;          ///< as `run` returns it
    std::string error;       ///< what went wrong first, in one line; empty if nothing did
    std::string out, err;    ///< what was printed
    Strings warnings;        ///< one each
    std::vector<Left> stack; ///< the top is the last; empty where something was an error
    Strings files;           ///< that were read or looked for, as they were opened
};

/// Run the words for the images that they leave, on a stack that `images` are on (the top is the
/// last). Wildcards must fit one frame. No exception leaves it.
Evaluation evaluate(const Strings& words, std::vector<OIIO::ImageBuf> images,
                    const chain::Policy& policy = {});

} // namespace tonetool::runs
