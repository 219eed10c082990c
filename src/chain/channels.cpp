#include "chain/channels.h"

#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>

#include "chain/call.h"
#include "chain/error.h"

namespace tonetool::chain {

namespace {

struct Selection {
    std::vector<int> sources; // -1: the value
    std::vector<float> values;
    Strings names;

    void add(int source, float value, const std::string& name) {
        sources.push_back(source);
        values.push_back(value);
        names.push_back(name);
    }
};

int required_channel(const OIIO::ImageSpec& spec, const std::string& name) {
    int index = channel_index(spec, name);
    if (index < 0) {
        throw CommandError("Unknown channel name \"" + name + "\" (actual channels: \"" +
                           join(spec.channelnames, ",") + "\")");
    }
    return index;
}

void add_plain(Selection& selection, const OIIO::ImageSpec& spec, const std::string& word) {
    int index = channel_index(spec, word);
    if (index < 0 && parse_integer(word)) {
        index = checked_integer("channel index", word, {0.0, spec.nchannels - 1.0});
    }
    index = index < 0 ? required_channel(spec, word) : index;
    selection.add(index, 0, spec.channelnames[static_cast<size_t>(index)]);
}

void add_assigned(Selection& selection, const OIIO::ImageSpec& spec, const std::string& name,
                  const std::string& source) {
    if (parse_number(source) && channel_index(spec, source) < 0) {
        double value = checked_number("channel value", source, {-3e38, 3e38});
        selection.add(-1, static_cast<float>(value), name);
    } else {
        selection.add(required_channel(spec, source), 0, name);
    }
}

} // namespace

int channel_index(const OIIO::ImageSpec& spec, const std::string& name) {
    int index = spec.channelindex(name);
    for (int c = 0; index < 0 && c < spec.nchannels; ++c) {
        if (OIIO::Strutil::iequals(spec.channelnames[static_cast<size_t>(c)], name)) {
            index = c;
        }
    }
    return index;
}

OIIO::ImageBuf select_channels(const OIIO::ImageBuf& pixels, const std::string& list) {
    const OIIO::ImageSpec& spec = pixels.spec();
    Selection selection;
    for (const std::string& word : split(list, ',')) {
        size_t equals = word.find('=');
        if (word.empty()) {
            throw CommandError("empty channel name in \"" + list + "\"");
        }
        if (equals == std::string::npos) {
            add_plain(selection, spec, word);
        } else {
            add_assigned(selection, spec, word.substr(0, equals), word.substr(equals + 1));
        }
    }
    OIIO::ImageBuf chosen =
        OIIO::ImageBufAlgo::channels(pixels, static_cast<int>(selection.sources.size()),
                                     selection.sources, selection.values, selection.names);
    if (chosen.has_error()) {
        throw CommandError(chosen.geterror());
    }
    return chosen;
}

} // namespace tonetool::chain
