// SPDX-License-Identifier: BSD-3-Clause
// Recipes that read recipes: who reads whom on this thread.
#pragma once

#include <string>

#include "text/text.h"

namespace tonetool::recipe {

/// While it is alive, its recipe is being run on this thread.
class Nesting {
public:
    /// A RecipeError where the recipe is already being run, or too many are.
    explicit Nesting(const std::string& file);
    ~Nesting();
    Nesting(const Nesting&) = delete;
    Nesting& operator=(const Nesting&) = delete;

    bool is_outermost() const;

    /// What it reads is read for those around it, too.
    void note_files(const Strings& files);
    const Strings& files() const;

    /// An error of a recipe that this one reads comes through here with what was put before it on
    /// its way; the text of the innermost alone, and by which recipe it was reached.
    std::string trimmed(const std::string& error) const;
};

} // namespace tonetool::recipe
