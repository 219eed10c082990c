#include "imagebuf/lights/light_maximum.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>

#include "imagebuf/pixels/checks.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;

bool same_window(const OIIO::ROI& a, const OIIO::ROI& b) {
    return a.xbegin == b.xbegin && a.xend == b.xend && a.ybegin == b.ybegin && a.yend == b.yend;
}

// Takes the light if it is brighter.
void take(LightMaximum::Found& found, double luminance, const std::string& light, bool measured) {
    if (luminance <= found.luminance)
        return;
    found.luminance = luminance;
    found.light = light;
    found.measured = measured;
}

} // namespace

bool LightMaximum::read_table(std::string& error) {
    return m_options.table.empty() || m_table.read(m_options.table, m_options.unit, error);
}

bool LightMaximum::open_index(std::optional<IndexLayer>& layer, std::string& error) {
    const std::string& asked = m_options.layer;
    if (!is_file(asked)) {
        ColorChoice choice;
        return ToneAlgo::find_color(deciding_spec(m_image), m_beauty, choice, error) &&
               find_index_layer(m_image.spec(), asked, choice.layer, layer, error);
    }
    ImageBuf file(asked);
    if (!file.init_spec(asked, 0, 0)) {
        error = format("light index file \"{}\": {}", asked, file.geterror());
        return false;
    }
    const OIIO::ImageSpec& spec = file.spec();
    if (!same_window(spec.roi_full(), m_image.roi_full())) {
        error =
            format("light index file \"{}\" is {}x{}, the image is {}x{}", asked, spec.full_width,
                   spec.full_height, m_image.spec().full_width, m_image.spec().full_height);
        return false;
    }
    if (!find_index_layer(spec, "", "", layer, error))
        return false;
    // A file of one channel needs no name for it.
    if (!layer && spec.nchannels == 1)
        layer = IndexLayer{"", 0};
    if (!layer) {
        error = format("light index file \"{}\" has no layer that is called so (valid: "
                       "lightindex, M, light_id, or one channel)",
                       asked);
        return false;
    }
    layer->layer = asked;
    m_index_file = std::move(file);
    return true;
}

bool LightMaximum::by_table(std::optional<Found>& out, std::string& why, std::string& error) {
    std::optional<IndexLayer> layer;
    if (m_options.layer != "groups" && !open_index(layer, error))
        return false;
    return layer ? by_layer(*layer, out, why, error) : by_named_groups(out, why, error);
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

bool LightMaximum::by_layer(const IndexLayer& layer, std::optional<Found>& out, std::string& why,
                            std::string& error) {
    IndexCounts counts;
    if (!count_indices(index_image(), layer, counts, error))
        return false;
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
    return finish(std::move(found), out, why,
                  counts.pixels.empty() ? "the index layer holds no index"
                                        : "no index of the image has a luminance");
}

bool LightMaximum::scan(std::string& error) {
    if (m_scan)
        return true;
    LightScan scan;
    if (!open_scan(m_image, m_beauty, m_options, table(), m_image.roi(), m_nthreads, scan, error) ||
        (!scan.groups().empty() && !scan.run(nullptr, error)))
        return false;
    m_scan = std::move(scan);
    return true;
}

bool LightMaximum::maximum_of(size_t group, double& value, std::string& error) const {
    value = m_scan->groups()[group].maximum;
    return m_percentile >= 100 || m_scan->percentile(group, m_percentile / 100, value, error);
}

bool LightMaximum::by_named_groups(std::optional<Found>& out, std::string& why,
                                   std::string& error) {
    if (!scan(error))
        return false;
    const auto& groups = m_scan->groups();
    if (groups.empty()) {
        why = "no light index and no light groups among the layers";
        return true;
    }
    const auto lights = lights_of(m_table, groups);
    if (std::all_of(lights.begin(), lights.end(), [](const Light* light) { return !light; })) {
        std::vector<std::string> names;
        for (const ScannedGroup& group : groups)
            names.push_back(group.group.name);
        why = format("none of the light groups ({}) is in \"{}\" ({})",
                     OIIO::Strutil::join(names, ", "), m_table.file(), m_table.list());
        return true;
    }
    Found found;
    found.index = "groups";
    found.warnings = m_scan->warnings();
    for (size_t g = 0; g < groups.size(); ++g)
        if (groups[g].pixels > 0 && !take_group(g, lights[g], found, error))
            return false;
    return finish(std::move(found), out, why, "no light group has a luminance");
}

// By the table, or where it has none, by the layer.
bool LightMaximum::take_group(size_t group, const Light* light, Found& found, std::string& error) {
    const std::string& name = m_scan->groups()[group].group.name;
    if (light && light->luminance) {
        take(found, *light->luminance, name, false);
        return true;
    }
    double measured = 0;
    if (!maximum_of(group, measured, error))
        return false;
    take(found, measured, name, true);
    const std::string lack =
        light
            ? format("light {} has no luminance in \"{}\", {}", name, m_table.file(), light->lacks)
            : format("light group \"{}\" is not in \"{}\"", name, m_table.file());
    found.lacks.push_back(lack + format(": the maximum of its layer, {:.6g}, is taken", measured));
    return true;
}

bool LightMaximum::by_groups(std::optional<Found>& out, std::string& why, std::string& error) {
    if (!scan(error))
        return false;
    if (m_scan->groups().empty()) {
        why = "no light groups among the layers";
        return true;
    }
    Found found;
    found.index = "groups";
    for (size_t g = 0; g < m_scan->groups().size(); ++g) {
        double measured = 0;
        if (m_scan->groups()[g].pixels == 0)
            continue;
        if (!maximum_of(g, measured, error))
            return false;
        take(found, measured, m_scan->groups()[g].group.name, true);
    }
    found.warnings = m_scan->warnings();
    found.additive = m_scan->additive();
    return finish(std::move(found), out, why, "all light groups are black");
}

bool LightMaximum::finish(Found found, std::optional<Found>& out, std::string& why,
                          const char* none) const {
    if (found.luminance > 0) {
        out = std::move(found);
        return true;
    }
    why = none;
    if (!found.lacks.empty())
        why += " (" + found.lacks.front() + ")";
    return true;
}

} // namespace tonetool
