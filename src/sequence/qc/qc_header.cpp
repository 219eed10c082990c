// SPDX-License-Identifier: BSD-3-Clause
// Headers that differ from those of the other frames: windows, channels, types, compression,
// metadata.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cstring>
#include <functional>
#include <set>

#include "imagebuf/pixels/names.h"
#include "sequence/qc/qc_shot.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

// Consecutive frames that have the same unusual value.
struct OddRun {
    size_t first, last;
    std::string value, usual;
    size_t usual_frames;
};

using ValueOf = std::function<std::string(const QcFacts&)>;

// The value that most frames have; among equally frequent ones the first.
std::string usual_value(const std::vector<std::string>& values, size_t& frames) {
    std::map<std::string, size_t> count;
    for (const std::string& value : values)
        ++count[value];
    std::string usual;
    frames = 0;
    for (const std::string& value : values) {
        if (count[value] > frames) {
            frames = count[value];
            usual = value;
        }
    }
    return usual;
}

// An attribute that changes often does so by its nature: bounding boxes, times, cameras. A change
// is rare if it happens at most twice there and back, or in a tenth of the frames.
bool changes_often(const std::vector<std::string>& values) {
    size_t changes = 0;
    for (size_t i = 1; i < values.size(); ++i)
        changes += values[i] != values[i - 1];
    return changes > std::max<size_t>(4, values.size() / 5) || changes + 1 >= values.size();
}

std::vector<OddRun> odd_runs(const std::vector<QcFrame*>& frames, const ValueOf& value_of,
                             bool may_vary) {
    std::vector<std::string> values;
    for (const QcFrame* frame : frames)
        values.push_back(value_of(frame->facts));
    if (may_vary && values.size() > 2 && changes_often(values))
        return {};
    size_t frames_with = 0;
    const std::string usual = usual_value(values, frames_with);
    std::vector<OddRun> runs;
    for (size_t i = 0; i < values.size(); ++i) {
        if (values[i] == usual)
            continue;
        if (!runs.empty() && runs.back().last + 1 == i && runs.back().value == values[i])
            runs.back().last = i;
        else
            runs.push_back({i, i, values[i], usual, frames_with});
    }
    return runs;
}

// "frames 3 to 5: " if there are several.
std::string run_text(const std::vector<QcFrame*>& frames, const OddRun& run) {
    return run.first == run.last
               ? ""
               : frames_text(frames[run.first]->number, frames[run.last]->number) + ": ";
}

std::string others_text(const OddRun& run) {
    return format("{} other {}", run.usual_frames, run.usual_frames == 1 ? "frame" : "frames");
}

// "the compression is zip, but none in 17 other frames".
std::string sentence(const std::vector<QcFrame*>& frames, const OddRun& run,
                     const std::string& what) {
    const auto shown = [](const std::string& value) {
        return value.empty() ? std::string("not there") : value;
    };
    return format("{}{} is {}, but {} in {}", run_text(frames, run), what, shown(run.value),
                  shown(run.usual), others_text(run));
}

enum class Change { None, Picture };

void find_odd(QcShot& shot, const std::string& code, const std::string& what,
              const ValueOf& value_of, bool may_vary, Change change) {
    const std::vector<QcFrame*> frames = shot.measured();
    for (const OddRun& run : odd_runs(frames, value_of, may_vary)) {
        shot.add(*frames[run.first], code, sentence(frames, run, what));
        if (change == Change::Picture)
            mark_change(frames, run.first, run.last);
    }
}

std::string of_parts(const QcFacts& facts,
                     const std::function<std::string(const QcPart&)>& text_of) {
    std::vector<std::string> texts;
    for (const QcPart& part : facts.parts)
        texts.push_back(text_of(part));
    const bool same =
        std::adjacent_find(texts.begin(), texts.end(), std::not_equal_to<>()) == texts.end();
    return same ? texts.front() : OIIO::Strutil::join(texts, " ");
}

using Types = std::map<std::string, std::string>;

Types types_of(const QcFacts& facts) {
    return {facts.channels.begin(), facts.channels.end()};
}

// The names that only `usual` has with a minus, and those that only `facts` has with a plus.
std::vector<std::string> channel_difference(const QcFacts& facts, const QcFacts& usual) {
    const Types here = types_of(facts), there = types_of(usual);
    std::vector<std::string> names;
    for (const auto& channel : there)
        if (here.count(channel.first) == 0)
            names.push_back("-" + channel.first);
    for (const auto& channel : here)
        if (there.count(channel.first) == 0)
            names.push_back("+" + channel.first);
    return names;
}

std::string channel_names(const QcFacts& facts) {
    std::string names;
    for (const auto& [name, type] : facts.channels)
        names += name + "\n";
    return names;
}

// Whether the channel belongs to a layer that `facts` lacks.
bool is_of_lost_layer(const std::string& channel, const QcFacts& facts, const QcFacts& usual) {
    return std::any_of(usual.layers.begin(), usual.layers.end(), [&](const QcLayer& layer) {
        const std::string& name = layer.name;
        return !name.empty() && !find_layer(facts, name) &&
               channel.compare(0, name.size(), name) == 0;
    });
}

bool lacks_only_layers(const QcFacts& facts, const QcFacts& usual) {
    const Types here = types_of(facts), there = types_of(usual);
    const bool more = std::any_of(here.begin(), here.end(), [&](const auto& channel) {
        return there.count(channel.first) == 0;
    });
    return !more && here.size() < there.size() &&
           std::all_of(there.begin(), there.end(), [&](const auto& channel) {
               return here.count(channel.first) > 0 ||
                      is_of_lost_layer(channel.first, facts, usual);
           });
}

// "A, B, C and 7 more".
std::string shortened(const std::vector<std::string>& names) {
    constexpr size_t most = 4;
    const size_t shown = names.size() > most + 1 ? most : names.size();
    std::string text;
    for (size_t i = 0; i < shown; ++i)
        text += (i > 0 ? ", " : "") + names[i];
    return shown < names.size() ? format("{} and {} more", text, names.size() - shown) : text;
}

// The first frame that has the usual value of a run.
const QcFrame* usual_frame(const std::vector<QcFrame*>& frames, const OddRun& run,
                           const ValueOf& value_of) {
    return *std::find_if(frames.begin(), frames.end(),
                         [&](const QcFrame* frame) { return value_of(frame->facts) == run.usual; });
}

void find_odd_channels(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.measured();
    for (const OddRun& run : odd_runs(frames, channel_names, false)) {
        QcFrame& frame = *frames[run.first];
        const QcFacts& usual = usual_frame(frames, run, channel_names)->facts;
        if (lacks_only_layers(frame.facts, usual))
            continue;
        const std::vector<std::string> names = channel_difference(frame.facts, usual);
        shot.add(frame, "channels",
                 format("{}the channels are not those of {}: {}", run_text(frames, run),
                        others_text(run),
                        names.empty() ? "their order is another" : shortened(names)));
    }
}

// Compares only channels that all frames have.
void find_odd_types(QcShot& shot) {
    const std::vector<QcFrame*> frames = shot.measured();
    std::map<std::string, size_t> count;
    for (const QcFrame* frame : frames)
        for (const auto& channel : frame->facts.channels)
            ++count[channel.first];
    const ValueOf value_of = [&](const QcFacts& facts) {
        std::string text;
        for (const auto& [name, type] : types_of(facts))
            text += count[name] == frames.size() ? name + " " + type + "\n" : "";
        return text;
    };
    for (const OddRun& run : odd_runs(frames, value_of, false)) {
        QcFrame& frame = *frames[run.first];
        const Types usual = types_of(usual_frame(frames, run, value_of)->facts);
        std::vector<std::string> names;
        for (const auto& [name, type] : types_of(frame.facts)) {
            const auto other = usual.find(name);
            if (other != usual.end() && other->second != type)
                names.push_back(format("{} is {}, not {}", name, type, other->second));
        }
        shot.add(frame, "type",
                 format("{}data types are not those of {}: {}", run_text(frames, run),
                        others_text(run), shortened(names)));
    }
}

// Attributes that differ in every frame of a shot by their meaning, in lower case without
// punctuation.
bool varies_by_nature(const std::string& name) {
    std::string word;
    for (char c : lower(name))
        word += std::isalnum(static_cast<unsigned char>(c)) ? std::string(1, c) : "";
    for (const char* part :
         {"datetime",  "capdate",          "timecode",     "keycode",  "rendertime", "frame",
          "worldto",   "tocamera",         "totoscreen",   "hostname", "memory",     "chunkcount",
          "caption",   "imagedescription", "documentname", "uuid",     "uniqueid",   "stats",
          "thumbnail", "envmap",           "imagecounter", "history"})
        if (word.find(part) != std::string::npos && word.find("framespersecond") != 0)
            return true;
    for (const char* end : {"host", "node", "task", "job", "ctime", "mtime", "seed", "id"})
        if (OIIO::Strutil::ends_with(word, end))
            return true;
    return word == "time" || word == "date" || word == "samples";
}

// How many numbers a value consists of; 0 if it is text.
size_t numbers_in(std::string value) {
    for (char& c : value)
        c = std::strchr(",;()[]{}", c) ? ' ' : c;
    const std::vector<std::string> words = OIIO::Strutil::splits(value);
    return std::all_of(words.begin(), words.end(), OIIO::Strutil::string_is_float) ? words.size()
                                                                                   : 0;
}

// A matrix is animated, and so may be each number of a camera; its name may not.
bool is_animated(const std::string& name, const std::string& value) {
    constexpr size_t matrix = 8;
    const size_t numbers = numbers_in(value);
    const bool is_long = value.find(" characters, SHA-1 ") != std::string::npos;
    return numbers > matrix ||
           (lower(name).find("camera") != std::string::npos && (numbers > 0 || is_long));
}

// The tasks of a farm leave their values in chunks of frames: each value has one run.
bool is_of_chunks(const std::vector<std::string>& values) {
    constexpr size_t enough = 3;
    size_t changes = 0;
    for (size_t i = 1; i < values.size(); ++i)
        changes += values[i] != values[i - 1];
    return changes >= enough &&
           std::set<std::string>(values.begin(), values.end()).size() == changes + 1;
}

void find_odd_metadata(QcShot& shot) {
    std::set<std::string> names;
    for (const QcFrame* frame : shot.measured()) {
        for (const QcPart& part : frame->facts.parts)
            for (const auto& [name, value] : part.metadata)
                names.insert(name);
    }
    for (const std::string& name : names) {
        if (varies_by_nature(name))
            continue;
        const ValueOf value_of = [&](const QcFacts& facts) {
            return of_parts(facts, [&](const QcPart& part) {
                const auto value = part.metadata.find(name);
                return value == part.metadata.end() ? std::string() : value->second;
            });
        };
        std::vector<std::string> values;
        bool animated = false;
        for (const QcFrame* frame : shot.measured()) {
            values.push_back(value_of(frame->facts));
            animated = animated || is_animated(name, values.back());
        }
        if (!animated && !is_of_chunks(values))
            find_odd(shot, "metadata", name, value_of, true, Change::None);
    }
}

} // namespace

void find_odd_headers(QcShot& shot) {
    const auto of_part = [](const auto& text_of) {
        return [text_of](const QcFacts& facts) { return of_parts(facts, text_of); };
    };
    find_odd(shot, "displaywindow", "the display window",
             of_part([](const QcPart& part) { return window_text(part.display); }), false,
             Change::Picture);
    find_odd(shot, "datawindow", "the data window",
             of_part([](const QcPart& part) { return window_text(part.data); }), true,
             Change::Picture);
    find_odd(shot, "compression", "the compression",
             of_part([](const QcPart& part) { return part.compression; }), false, Change::None);
    find_odd_channels(shot);
    find_odd_types(shot);
    find_odd_metadata(shot);
}

} // namespace tonetool::sequence
