// SPDX-License-Identifier: BSD-3-Clause
// The commands of a check that measure, and what their numbers are.
#pragma once

#include <string>

namespace tonetool::sequence {

/// What a command's numbers are.
enum class Scoring {
    Map,       ///< the pool of an error map, 0 to 1
    Error,     ///< an error metric's measure, and the pool of its map
    Index,     ///< of TMQI
    Values,    ///< of the pixels' differences, held to --fail and its like
    Perceived, ///< the same, but which pixels differ is told by eye
    Verdict    ///< one of three, of --biascheck
};

struct MeasuringCommand {
    const char* name;
    Scoring scoring;
    const char* quantity; ///< of a limit without a name; nullptr: the first that it has

    /// Compares the numbers of two images.
    bool compares_values() const {
        return scoring == Scoring::Values || scoring == Scoring::Perceived;
    }
    /// The quantity of a limit without a name; `metric` is that of --errormap.
    std::string first_quantity(const std::string& metric) const;
};

inline constexpr MeasuringCommand kMeasuringCommands[] = {
    {"hdrflip", Scoring::Map, nullptr},      {"ldrflip", Scoring::Map, nullptr},
    {"flipdiff", Scoring::Map, "max"},       {"filmstrip", Scoring::Map, nullptr},
    {"errormap", Scoring::Error, nullptr},   {"tmqi", Scoring::Index, nullptr},
    {"diff", Scoring::Values, nullptr},      {"pdiff", Scoring::Perceived, nullptr},
    {"biascheck", Scoring::Verdict, "bound"}};

/// nullptr for a command that measures nothing.
const MeasuringCommand* measuring_command(const std::string& name);

/// Whether more of a quantity of a command is better: of a metric in dB of --errormap, and of all
/// that --tmqi finds. Of anything else less is.
bool higher_is_better(const std::string& command, const std::string& quantity);

} // namespace tonetool::sequence
