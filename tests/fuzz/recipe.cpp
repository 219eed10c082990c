// SPDX-License-Identifier: BSD-3-Clause
// The text of a recipe.
#include "recipe/recipe.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace tonetool;
    size_t bytes = 0;
    try {
        for (const std::string& word :
             recipe::parse("tonetool 1\n" + fuzz::text_of(data, size), {{"frame", "7"}}))
            bytes += word.size();
    } catch (const recipe::RecipeError& problem) {
        fuzz::require(*problem.what() != '\0', "an error has a text");
    }
    fuzz::require(bytes <= (32 << 20), "a recipe does not grow without an end");
    return 0;
}
