// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lights/light_maximum.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/pixels/checks.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;

// Takes the light if it is brighter.
void take(LightMaximum::Found& found, double luminance, const std::string& light, bool measured) {
    if (luminance <= found.luminance)
        return;
    found.luminance = luminance;
    found.light = light;
    found.measured = measured;
}

} // namespace

void LightMaximum::read_table() {
    if (!m_options.table.empty())
        m_table.read(m_options.table, m_options.unit);
}

std::optional<IndexLayer> LightMaximum::open_index() {
    const std::string& asked = m_options.layer;
    if (!is_file(asked))
        return find_index_layer(m_image.spec(), asked,
                                chosen_color(deciding_spec(m_image), m_beauty).layer);
    ImageBuf file(asked);
    if (!file.init_spec(asked, 0, 0))
        throw Refusal(format("light index file \"{}\": {}", asked, file.geterror()));
    const OIIO::ImageSpec& spec = file.spec();
    if (!same_window(spec.roi_full(), m_image.roi_full()))
        throw Refusal(format("light index file \"{}\" is {}x{}, the image is {}x{}", asked,
                             spec.full_width, spec.full_height, m_image.spec().full_width,
                             m_image.spec().full_height));
    auto layer = find_index_layer(spec, "", "");
    // A file of one channel needs no name for it.
    if (!layer && spec.nchannels == 1)
        layer = IndexLayer{"", 0};
    if (!layer)
        throw Refusal(format("light index file \"{}\" has no layer that is called so (valid: "
                             "lightindex, M, light_id, or one channel)",
                             asked));
    layer->layer = asked;
    m_index_file = std::move(file);
    return layer;
}

std::optional<LightMaximum::Found> LightMaximum::by_table(std::string& why) {
    const auto layer = m_options.layer != "groups" ? open_index() : std::nullopt;
    return layer ? by_layer(*layer, why) : by_named_groups(why);
}

// By the names that light_index() left, where there are some.
const Light* LightMaximum::light_at(int index) const {
    std::vector<std::string> names;
    const std::string all = index_image().spec().get_string_attribute("lightindex:names");
    if (!all.empty())
        OIIO::Strutil::split(all, names, ",");
    const Light* light =
        size_t(index) < names.size() ? m_table.find(names[size_t(index)]) : nullptr;
    return light ? light : m_table.find(index);
}

std::optional<LightMaximum::Found> LightMaximum::by_layer(const IndexLayer& layer,
                                                          std::string& why) {
    const IndexCounts counts = count_indices(index_image(), layer);
    Found found;
    found.index = layer.layer;
    for (const auto& [index, pixels] : counts.pixels) {
        const Light* light = light_at(index);
        if (light && light->luminance)
            take(found, *light->luminance, light->shown(), false);
        else
            found.lacks.push_back(
                light ? format("light {} has no luminance: {}", light->shown(), light->lacks)
                      : format("index {} of \"{}\" ({} pixels) is not in \"{}\" ({})", index,
                               layer.layer, pixels, m_table.file(), m_table.list()));
    }
    constexpr size_t most = 4;
    if (const size_t all = found.lacks.size(); all > most) {
        found.lacks.resize(most);
        found.lacks.push_back(format("and so are {} more indices", all - most));
    }
    if (counts.invalid > 0)
        found.warnings.push_back(format("{} pixel(s) of \"{}\" are not an index and are left out",
                                        counts.invalid, layer.layer));
    if (counts.between > 0)
        found.warnings.push_back(format("{} pixel(s) of \"{}\" are not whole numbers: an index "
                                        "must not be filtered",
                                        counts.between, layer.layer));
    return finish(std::move(found), why,
                  counts.pixels.empty() ? "the index layer holds no index"
                                        : "no index of the image has a luminance");
}

void LightMaximum::scan() {
    if (m_scan)
        return;
    LightScan scan = open_scan(m_image, m_beauty, m_options, table(), m_image.roi(), m_nthreads);
    if (!scan.groups().empty())
        scan.run(nullptr);
    m_scan = std::move(scan);
}

double LightMaximum::maximum_of(size_t group) const {
    return m_percentile >= 100 ? m_scan->groups()[group].maximum
                               : m_scan->percentile(group, m_percentile / 100);
}

std::optional<LightMaximum::Found> LightMaximum::by_named_groups(std::string& why) {
    scan();
    const auto& groups = m_scan->groups();
    if (groups.empty()) {
        why = "no light index and no light groups among the layers";
        return std::nullopt;
    }
    const auto lights = lights_of(m_table, groups);
    if (std::all_of(lights.begin(), lights.end(), [](const Light* light) { return !light; })) {
        std::vector<std::string> names;
        for (const ScannedGroup& group : groups)
            names.push_back(group.group.name);
        why = format("none of the light groups ({}) is in \"{}\" ({})",
                     OIIO::Strutil::join(names, ", "), m_table.file(), m_table.list());
        return std::nullopt;
    }
    Found found;
    found.index = "groups";
    found.warnings = m_scan->warnings();
    for (size_t g = 0; g < groups.size(); ++g)
        if (groups[g].pixels > 0)
            take_group(g, lights[g], found);
    return finish(std::move(found), why, "no light group has a luminance");
}

// By the table, or where it has none, by the layer.
void LightMaximum::take_group(size_t group, const Light* light, Found& found) {
    const std::string& name = m_scan->groups()[group].group.name;
    if (light && light->luminance) {
        take(found, *light->luminance, name, false);
        return;
    }
    const double measured = maximum_of(group);
    take(found, measured, name, true);
    const std::string lack =
        light
            ? format("light {} has no luminance in \"{}\", {}", name, m_table.file(), light->lacks)
            : format("light group \"{}\" is not in \"{}\"", name, m_table.file());
    found.lacks.push_back(lack + format(": the maximum of its layer, {:.6g}, is taken", measured));
}

std::optional<LightMaximum::Found> LightMaximum::by_groups(std::string& why) {
    scan();
    if (m_scan->groups().empty()) {
        why = "no light groups among the layers";
        return std::nullopt;
    }
    Found found;
    found.index = "groups";
    for (size_t g = 0; g < m_scan->groups().size(); ++g)
        if (m_scan->groups()[g].pixels > 0)
            take(found, maximum_of(g), m_scan->groups()[g].group.name, true);
    found.warnings = m_scan->warnings();
    found.additive = m_scan->additive();
    return finish(std::move(found), why, "all light groups are black");
}

std::optional<LightMaximum::Found> LightMaximum::finish(Found found, std::string& why,
                                                        const char* none) {
    if (found.luminance > 0)
        return found;
    why = none;
    if (!found.lacks.empty())
        why += " (" + found.lacks.front() + ")";
    return std::nullopt;
}

} // namespace tonetool
