// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/attribute.h.
#include "tonetool/attribute.h"

#include <OpenImageIO/strutil.h>
#include <cmath>

#include "imagebuf/aov/aov_layers.h"
#include "imagebuf/attribute/attribute_tables.h"
#include "imagebuf/options/attribute_options.h"
#include "imagebuf/pixels/bands.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/pixels/planes.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;
using ImageParts = std::vector<const ImageBuf*>;

void check_parts(const ImageParts& parts, const char* who) {
    if (parts.empty())
        throw Refusal(std::string("there is no ") + who);
    for (const ImageBuf* part : parts)
        check_readable(*part, who);
}

std::vector<float> pixels_of_map(const ImageBuf& map) {
    if (map.nchannels() != 1)
        throw Refusal(format("the map has {} channels: must be 1", map.nchannels()));
    std::vector<float> error(size_t(map.roi().npixels()));
    if (!map.get_pixels(map.roi(), OIIO::TypeFloat, error.data()))
        throw Refusal(map.geterror());
    for (const float e : error)
        if (!std::isfinite(e) || e < 0)
            throw Refusal("the map has values that are no errors");
    return error;
}

double mean_of(const std::vector<float>& error, double pixels) {
    double sum = 0;
    for (const float e : error)
        sum += double(e);
    return sum / pixels;
}

void run_attribute(AttributeResult& result, const ImageParts& reference, const ImageParts& test,
                   const AttributeOptions& options, const ImageBuf* map, int nthreads) {
    result = {};
    check_options(options);
    check_parts(reference, "reference");
    check_parts(test, "test");
    AttributeInput input;
    input.open(reference, test, options, map ? map->roi() : OIIO::ROI());
    if (options.memory > 0 && input.bytes() > options.memory)
        throw Refusal(format("memory is {}: the layers of both images need {}",
                             size_text(options.memory), size_text(input.bytes())));
    input.read(nthreads);
    ErrorMeter meter(input, options, input.bytes(), nthreads);
    std::vector<float> error = map ? pixels_of_map(*map) : meter.map();
    for (size_t p = 0; p < error.size(); ++p)
        error[p] = input.counts(p) ? error[p] : 0;
    result.mean = mean_of(error, input.counted());
    ExchangedLights lights = attribute_lights(input, meter, result.mean, options.alone);
    result.lights = std::move(lights.lights);
    result.warnings = input.warnings();
    result.mattes = attribute_mattes(input, error, lights.test, result.warnings);
    result.layers = attribute_layers(input);
    result.manifest_only = input.manifest_only();
    if (result.lights.empty() && result.mattes.empty() && result.layers.empty())
        result.warnings.emplace_back(
            "the images have no light groups, Cryptomattes or other layers "
            "in common, so nothing can be told");
}

std::string percent(double share) {
    return format("{:.0f} %", 100 * share);
}

// "object" of "ViewLayer.CryptoObject", "asset" of "crypto_asset".
std::string word_of_type(const std::string& type) {
    std::string word = lower(split_layer(type).layer_name);
    if (const size_t at = word.find("crypto"); at != std::string::npos)
        word.erase(0, at + 6);
    const size_t begin = word.find_first_not_of("_- ");
    return begin == std::string::npos ? lower(type) : word.substr(begin);
}

std::string sentence_of(const AttributedLight& light) {
    const bool changed = light.finding == "weaker" || light.finding == "stronger";
    return format("light {}: {}{}, explains {} of the error", light.name, light.finding,
                  changed ? format(" by a factor of {:.3g}", light.gain.value_or(0)) : "",
                  percent(light.explains));
}

std::string sentence_of(const std::string& word, const AttributedMatte& matte) {
    std::string how;
    if (matte.finding == "other colour")
        how = format(" ({:.3g}, {:.3g}, {:.3g} times the reference's)", matte.gain[0],
                     matte.gain[1], matte.gain[2]);
    else if (matte.finding == "moved or reshaped" && matte.shift)
        how = format(" ({:+.1f}, {:+.1f} pixels)", (*matte.shift)[0], (*matte.shift)[1]);
    return format("{} {}: {}{}, {} of the error lies under it", word, matte.name, matte.finding,
                  how, percent(matte.mass));
}

std::string sentence_of(const AttributedLayer& layer) {
    if (layer.finding != "changed")
        return format("layer {}: {}{}", layer.name, layer.finding,
                      layer.gain ? format(", {:.3g} times the reference's", *layer.gain) : "");
    std::vector<std::string> under;
    for (const auto& [name, share] : layer.most_under)
        under.push_back(percent(share) + " under " + name);
    return format("layer {}: changed in {} pixel(s){}{}", layer.name, layer.changed,
                  under.empty() ? "" : ", ", OIIO::Strutil::join(under, ", "));
}

} // namespace

namespace ToneAlgo {

bool attribute(AttributeResult& result, const ImageParts& reference, const ImageParts& test,
               std::string& error, const AttributeOptions& options, const ImageBuf* map,
               int nthreads) {
    return contained(error,
                     [&] { run_attribute(result, reference, test, options, map, nthreads); });
}

std::vector<std::string> attribute_findings(const AttributeResult& result) {
    std::vector<std::string> sentences;
    for (const AttributedLight& light : result.lights)
        if (!light.finding.empty())
            sentences.push_back(sentence_of(light));
    for (const AttributedType& type : result.mattes)
        for (const AttributedMatte& matte : type.mattes)
            if (!matte.finding.empty())
                sentences.push_back(sentence_of(word_of_type(type.type), matte));
    for (const AttributedLayer& layer : result.layers)
        if (!layer.finding.empty())
            sentences.push_back(sentence_of(layer));
    return sentences;
}

} // namespace ToneAlgo
} // namespace tonetool
