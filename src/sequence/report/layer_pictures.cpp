// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/layer_pictures.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

#include "sequence/report/bytes.h"
#include "sequence/report/encoded.h"
#include "sequence/report/reduced.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::ImageSpec;

constexpr size_t kMostLayers = 4;

enum class Show { Light, Numbers, Ids };

// At most three channels of a layer, at every so many pixels.
struct Samples {
    int width = 0, height = 0;
    Show show = Show::Numbers;
    std::vector<float> values; ///< three for each pixel
};

struct Place {
    int subimage = 0;
    std::vector<int> channels;
};

bool is_of(const std::string& channel, const std::string& layer) {
    return channel == layer || (channel.size() > layer.size() && channel[layer.size()] == '.' &&
                                channel.compare(0, layer.size(), layer) == 0);
}

// A part gives its name to channels that have none of a layer.
std::optional<Place> place_of(OIIO::ImageInput& in, const std::string& layer) {
    for (int subimage = 0; in.seek_subimage(subimage, 0); ++subimage) {
        const ImageSpec spec = in.spec(subimage, 0);
        if (spec.deep)
            continue;
        const std::string part = spec.get_string_attribute("oiio:subimagename");
        Place place{subimage, {}};
        for (int c = 0; c < spec.nchannels; ++c) {
            const std::string& name = spec.channelnames[size_t(c)];
            const std::string last = name.substr(name.rfind('.') + 1);
            const bool alpha = OIIO::Strutil::iequals(last, "A") && !place.channels.empty();
            if ((is_of(name, layer) || is_of(part + "." + name, layer)) && !alpha)
                place.channels.push_back(c);
        }
        if (!place.channels.empty())
            return place;
    }
    return std::nullopt;
}

Show show_of(const ImageSpec& spec, const Place& place, const std::string& layer) {
    if (OIIO::Strutil::icontains(layer, "crypto"))
        return Show::Ids;
    const std::string& name = spec.channelnames[size_t(place.channels[0])];
    const bool red = OIIO::Strutil::iequals(name.substr(name.rfind('.') + 1), "R");
    return red && place.channels.size() >= 3 ? Show::Light : Show::Numbers;
}

// The order of R, G, B in a file is that of the alphabet where it has not been put right.
std::array<int, 3> shown_channels(const ImageSpec& spec, const Place& place, Show show) {
    const auto at = [&](size_t i) {
        return place.channels[std::min(i, place.channels.size() - 1)];
    };
    std::array<int, 3> shown{at(0), at(1), at(2)};
    if (place.channels.size() < 3 || show == Show::Ids)
        shown = {at(0), at(0), at(0)};
    const auto last = [&](int c) { return spec.channelnames[size_t(c)].back(); };
    if (show == Show::Light && last(shown[0]) == 'B')
        std::swap(shown[0], shown[2]);
    return shown;
}

std::optional<Samples> samples_of(const std::string& file, const std::string& layer) {
    const auto in = file.empty() ? nullptr : OIIO::ImageInput::open(file);
    const auto place = in ? place_of(*in, layer) : std::nullopt;
    if (!place) {
        (void)OIIO::geterror();
        return std::nullopt;
    }
    const ImageSpec spec = in->spec(place->subimage, 0);
    const auto [low, high] = std::minmax_element(place->channels.begin(), place->channels.end());
    const int first = *low, count = *high + 1 - first;
    std::vector<float> pixels(size_t(spec.width) * size_t(spec.height) * size_t(count));
    if (spec.depth > 1 ||
        !in->read_image(place->subimage, 0, first, first + count, OIIO::TypeFloat, pixels.data()))
        return std::nullopt;
    const PixelSize size = fitted(spec.roi(), kLayerSide);
    Samples samples{size.width, size.height, show_of(spec, *place, layer), {}};
    const std::array<int, 3> shown = shown_channels(spec, *place, samples.show);
    for (int y = 0; y < size.height; ++y) {
        for (int x = 0; x < size.width; ++x) {
            const auto from = [](int at, int to, int all) {
                return size_t((2 * at + 1) * all / (2 * to));
            };
            const size_t pixel = from(y, size.height, spec.height) * size_t(spec.width) +
                                 from(x, size.width, spec.width);
            for (const int c : shown)
                samples.values.push_back(pixels[pixel * size_t(count) + size_t(c - first)]);
        }
    }
    return samples;
}

struct Range {
    float low = 0, high = 1;
};

// What renderers write where there is nothing does not count.
Range range_of(const Samples& samples) {
    constexpr float nothing = 1e9f;
    std::vector<float> values;
    for (const float value : samples.values)
        if (std::isfinite(value) && std::abs(value) < nothing)
            values.push_back(value);
    if (values.empty())
        return {};
    const auto at = [&](double share) {
        const auto place = values.begin() + long(share * double(values.size() - 1));
        std::nth_element(values.begin(), place, values.end());
        return *place;
    };
    Range range{samples.show == Show::Light ? 0 : at(0.01), at(0.99)};
    if (!(range.high > range.low))
        range.high = range.low + 1;
    return range;
}

// Neighbouring IDs get colours that are easy to tell apart.
std::array<float, 3> color_of_id(float value) {
    uint32_t id = 0;
    std::memcpy(&id, &value, sizeof id);
    id = (id ^ id >> 16) * 0x7feb352dU;
    id = (id ^ id >> 15) * 0x846ca68bU;
    const auto part = [&](int shift) { return float(id >> shift & 255U) / 255; };
    return {part(0), part(8), part(16)};
}

std::string picture_uri(const Samples& samples, const Range& range) {
    ImageBuf picture(ImageSpec(samples.width, samples.height, 3, OIIO::TypeFloat));
    for (int y = 0; y < samples.height; ++y) {
        for (int x = 0; x < samples.width; ++x) {
            const float* value =
                &samples.values[3 * (size_t(y) * size_t(samples.width) + size_t(x))];
            std::array<float, 3> shown{};
            for (size_t c = 0; c < 3; ++c)
                shown[c] =
                    std::clamp((value[c] - range.low) / (range.high - range.low), 0.0f, 1.0f);
            const bool finite =
                std::all_of(value, value + 3, [](float v) { return std::isfinite(v); });
            if (samples.show == Show::Ids)
                shown = color_of_id(value[0]);
            else if (!finite)
                shown = {1, 0, 1};
            picture.setpixel(x, y, shown.data());
        }
    }
    return data_uri(samples.show == Show::Light ? srgb_bytes(picture) : picture, Encoding::Png);
}

} // namespace

std::string layer_pictures_json(const FrameResult& frame) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const Fault& fault : frame.faults) {
        const auto is_there = [&](const auto& one) { return one["layer"] == fault.layer; };
        if (fault.layer.empty() || fault.severity == Severity::Info || list.size() == kMostLayers ||
            std::any_of(list.begin(), list.end(), is_there))
            continue;
        const auto reference = samples_of(frame.reference, fault.layer);
        const auto test = samples_of(frame.test, fault.layer);
        if (!reference && !test)
            continue;
        const Range range = range_of(reference ? *reference : *test);
        list.push_back({{"layer", fault.layer},
                        {"reference", reference ? picture_uri(*reference, range) : ""},
                        {"test", test ? picture_uri(*test, range) : ""}});
    }
    return list.empty() ? "" : one_line(list);
}

} // namespace tonetool::sequence
