// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/nesting.h"

#include <algorithm>
#include <filesystem>
#include <vector>

#include "recipe/picture.h"
#include "sequence/frames/file_stamp.h"

namespace tonetool::recipe {

namespace {

struct Running {
    std::string path, name;
    Strings files;
};

thread_local std::vector<Running> running;
thread_local std::string innermost_error;

} // namespace

Nesting::Nesting(const std::string& file) {
    std::error_code ignored;
    const std::string path = std::filesystem::weakly_canonical(file, ignored).string();
    const std::string named = "recipe \"" + file + "\"";
    const auto same = [&](const Running& one) { return one.path == path; };
    if (std::any_of(running.begin(), running.end(), same)) {
        Strings names;
        for (auto one = std::find_if(running.begin(), running.end(), same); one != running.end();
             ++one)
            names.push_back(one->name);
        innermost_error = named + " reads itself" +
                          (names.size() > 1 ? ": " + join(names, " -> ") + " -> " + file : "");
        throw RecipeError(innermost_error);
    }
    if (running.size() == kMostNested) {
        innermost_error = named + ": recipes are nested deeper than " +
                          std::to_string(kMostNested) + ", the most that there may be";
        throw RecipeError(innermost_error);
    }
    running.push_back({path, file, {}});
}

Nesting::~Nesting() {
    sequence::note_files_behind(running.back().name, running.back().files);
    running.pop_back();
}

bool Nesting::is_outermost() const {
    return running.size() == 1;
}

void Nesting::note_files(const Strings& files) {
    for (Running& one : running)
        one.files.insert(one.files.end(), files.begin(), files.end());
}

const Strings& Nesting::files() const {
    return running.back().files;
}

std::string Nesting::trimmed(const std::string& error) const {
    const bool passes_on =
        !innermost_error.empty() && error.find(innermost_error) != std::string::npos;
    const std::string own = "recipe \"" + running.back().name + "\": " + error;
    const std::string text =
        !passes_on
            ? own
            : innermost_error +
                  (is_outermost() && innermost_error.find(running.back().name) == std::string::npos
                       ? " (read for \"" + running.back().name + "\")"
                       : "");
    innermost_error = is_outermost() ? "" : passes_on ? innermost_error : own;
    return text;
}

} // namespace tonetool::recipe
