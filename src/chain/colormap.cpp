#include "chain/colormap.h"

#include <OpenImageIO/imagebufalgo.h>
#include <algorithm>

#include "chain/call.h"
#include "chain/error.h"

namespace tonetool::chain {

namespace {

const Strings& map_names() {
    static const Strings names = {"inferno", "viridis",  "magma",    "turbo",
                                  "plasma",  "blue-red", "spectrum", "heat"};
    return names;
}

bool is_list(const std::string& map) {
    return map.find(',') != std::string::npos;
}

std::vector<float> knots_of(const std::string& list) {
    std::vector<float> knots;
    for (const std::string& word : split(list, ',')) {
        knots.push_back(static_cast<float>(checked_number("colour", word, {-1e6, 1e6})));
    }
    if (knots.size() < 6 || knots.size() % 3 != 0) {
        throw CommandError("\"" + list + "\" has " + std::to_string(knots.size()) +
                           " numbers (valid: two or more RGB triples)");
    }
    return knots;
}

} // namespace

void check_colormap(const std::string& map) {
    if (is_list(map)) {
        knots_of(map);
    } else {
        check_choice("colour map", map, map_names());
    }
}

OIIO::ImageBuf colored(const OIIO::ImageBuf& pixels, const std::string& map) {
    check_colormap(map);
    int channel = pixels.nchannels() < 3 ? 0 : -1;
    OIIO::ImageBuf result;
    if (is_list(map)) {
        std::vector<float> knots = knots_of(map);
        int count = static_cast<int>(knots.size() / 3);
        result = OIIO::ImageBufAlgo::color_map(pixels, channel, count, 3, knots);
    } else {
        result = OIIO::ImageBufAlgo::color_map(pixels, channel, map);
    }
    if (result.has_error()) {
        throw CommandError(result.geterror());
    }
    OIIO::ImageSpec& spec = result.specmod();
    spec.channelnames = {"R", "G", "B"};
    spec.alpha_channel = -1;
    spec.z_channel = -1;
    spec.attribute("oiio:ColorSpace", "sRGB");
    spec.erase_attribute("chromaticities");
    return result;
}

} // namespace tonetool::chain
