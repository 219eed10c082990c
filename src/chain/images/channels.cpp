// SPDX-License-Identifier: BSD-3-Clause
#include "chain/images/channels.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>

#include "chain/language/values.h"
#include "text/error.h"

namespace tonetool::chain {

namespace {

struct Selection {
    std::vector<int> sources; // -1: the constant value
    std::vector<float> values;
    Strings names;

    void add(int source, float value, const std::string& name) {
        sources.push_back(source);
        values.push_back(value);
        names.push_back(name);
    }
};

int required_channel(const OIIO::ImageSpec& spec, const std::string& name, const Warn& lenient) {
    int index = channel_index(spec, name);
    if (index < 0 && lenient) {
        lenient("Unknown channel name \"" + name + "\", filling with 0 (actual channels: \"" +
                join(spec.channelnames, ",") + "\")");
    } else if (index < 0) {
        throw CommandError("Unknown channel name \"" + name + "\" (actual channels: \"" +
                           join(spec.channelnames, ",") + "\")");
    }
    return index;
}

void add_plain(Selection& selection, const OIIO::ImageSpec& spec, const std::string& word,
               const Warn& lenient) {
    int index = channel_index(spec, word);
    if (index < 0 && parse_integer(word)) {
        const int asked = *parse_integer(word);
        index = lenient ? (asked < spec.nchannels ? asked : -1)
                        : checked_integer("channel index", word, {0.0, spec.nchannels - 1.0});
    } else if (index < 0 && !(lenient && word.empty())) {
        index = required_channel(spec, word, lenient);
    }
    selection.add(index, 0, "");
}

void add_assigned(Selection& selection, const OIIO::ImageSpec& spec, const std::string& name,
                  const std::string& source, const Warn& lenient) {
    if (parse_number(source) && channel_index(spec, source) < 0) {
        double value = checked_number("channel value", source, {-3e38, 3e38});
        selection.add(-1, static_cast<float>(value), name);
    } else {
        selection.add(required_channel(spec, source, lenient), 0, name);
    }
}

} // namespace

int channel_index(const OIIO::ImageSpec& spec, const std::string& name) {
    int index = spec.channelindex(name);
    for (int c = 0; index < 0 && c < spec.nchannels; ++c)
        if (OIIO::Strutil::iequals(std::string(spec.channel_name(c)), name))
            index = c;
    return index;
}

OIIO::ImageBuf select_channels(const OIIO::ImageBuf& pixels, const std::string& list,
                               const Warn& lenient) {
    const OIIO::ImageSpec& spec = pixels.spec();
    if (list.empty())
        throw CommandError("0-channel images not supported");
    Selection selection;
    const bool letters = (list == "RGB" || list == "RGBA") && channel_index(spec, list) < 0;
    const std::string names = !letters ? list : list == "RGB" ? "R,G,B" : "R,G,B,A";
    for (const std::string& part : split(names, ',')) {
        const std::string word = OIIO::Strutil::strip(part);
        size_t equals = word.find('=');
        if (equals == std::string::npos)
            add_plain(selection, spec, word, lenient);
        else
            add_assigned(selection, spec, word.substr(0, equals), word.substr(equals + 1), lenient);
    }
    OIIO::ImageBuf chosen =
        OIIO::ImageBufAlgo::channels(pixels, static_cast<int>(selection.sources.size()),
                                     selection.sources, selection.values, selection.names);
    if (chosen.has_error())
        throw CommandError(chosen.geterror());
    return chosen;
}

} // namespace tonetool::chain
