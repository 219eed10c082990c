#include "chain/commands/light_args.h"

#include "text/error.h"

namespace tonetool::chain {

std::vector<Modifier> light_modifiers() {
    return {{"lights", "FILE", "table of lights, .csv or .json"},
            {"lightunit", "luminance|power|X",
             "of the table: the image's, powers, or times X the image's (luminance)"},
            {"index", "contribution|power",
             "a pixel's light: which gives most, or of those that give 1 % the largest in the "
             "table (contribution)"},
            {"groups", "NAME,...", "light groups, by name or layer (found)"}};
}

LightOptions light_options(const Call& call) {
    LightOptions options;
    options.table = call.text("lights").value_or("");
    options.unit = call.text("lightunit").value_or(options.unit);
    options.index = call.text("index").value_or(options.index);
    if (auto groups = call.text("groups"))
        options.groups = split(*groups, ',');
    if (call.has("lightunit") && options.table.empty())
        throw CommandError("lightunit= needs a table of lights (lights=)");
    return options;
}

} // namespace tonetool::chain
