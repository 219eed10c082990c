// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/tone/cgtmo_guides.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "imagebuf/aov/camera.h"
#include "imagebuf/pixels/checks.h"
#include "imagebuf/pixels/parallel.h"
#include "imagebuf/tone/cgtmo_plan.h"
#include "metrics/refusal.h"
#include "tonemap/footprint.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;

struct Slot {
    const char* name;
    std::string GuideOptions::*asked;
    std::optional<GuideChannels> GBufferNames::*found;
};
constexpr Slot kSlots[] = {{"position", &GuideOptions::position, &GBufferNames::position},
                           {"normal", &GuideOptions::normal, &GBufferNames::normal},
                           {"albedo", &GuideOptions::albedo, &GBufferNames::albedo},
                           {"depth", &GuideOptions::depth, &GBufferNames::depth}};

// Nothing but one guide.
GuideOptions only(const Slot& slot, const std::string& layer) {
    GuideOptions out{"none", "none", "none", "none", ""};
    out.*slot.asked = layer;
    return out;
}

void append(std::vector<std::string>& to, const std::vector<std::string>& from) {
    to.insert(to.end(), from.begin(), from.end());
}

} // namespace

GBufferNames LocalGuides::find_in_files(GuideOptions& asked) const {
    GBufferNames names;
    for (const Slot& slot : kSlots) {
        const std::string file = asked.*slot.asked;
        if (!is_file(file))
            continue;
        auto image = std::make_shared<ImageBuf>(file);
        if (!image->init_spec(file, 0, 0))
            throw Refusal(format("{} file \"{}\": {}", slot.name, file, image->geterror()));
        auto found = find_gbuffer(image->spec(), only(slot, "")).*slot.found;
        // A file of one layer needs no name for it.
        const auto no_layer = [&](const std::string&) {
            return format("{} file \"{}\" has no {} layer", slot.name, file, slot.name);
        };
        if (!found)
            found = refusing_as(no_layer,
                                [&] { return find_gbuffer(image->spec(), only(slot, "R,G,B")); }).*
                    slot.found;
        found->file = std::move(image);
        found->layer = file;
        names.*slot.found = found;
        asked.*slot.asked = "none";
    }
    return names;
}

// Renderers that write a part for each layer.
void LocalGuides::find_in_parts(const GuideOptions& asked, GBufferNames& names) const {
    const std::string file(m_image.name());
    if (m_image.nsubimages() < 2 || !is_file(file))
        return;
    for (int part = 0; part < m_image.nsubimages(); ++part) {
        if (part == m_image.subimage())
            continue;
        auto image = std::make_shared<ImageBuf>(file, part, 0);
        GuideOptions missing = asked;
        for (const Slot& slot : kSlots)
            if (names.*slot.found)
                missing.*slot.asked = "none";
        if (!image->init_spec(file, part, 0))
            return;
        GBufferNames there = find_gbuffer(image->spec(), missing);
        for (const Slot& slot : kSlots)
            if (auto& found = there.*slot.found) {
                found->file = image;
                names.*slot.found = found;
            }
    }
}

GBufferNames LocalGuides::find(const std::string& beauty) const {
    GuideOptions asked{m_options.position, m_options.normal, m_options.albedo, m_options.depth,
                       beauty};
    GBufferNames in_files = find_in_files(asked);
    GBufferNames names = find_gbuffer(m_image.spec(), asked);
    for (const Slot& slot : kSlots)
        if (in_files.*slot.found)
            names.*slot.found = in_files.*slot.found;
    find_in_parts(asked, names);
    return names;
}

void LocalGuides::read(tonemap::LocalOperator& what, CgTmoSummary& summary) {
    m_view.stride = m_view.width = m_region.width();
    m_view.height = m_region.height();
    const GBufferNames names = find(summary.layer);
    m_guides = read_gbuffer(m_pixels, names, m_region, m_nthreads);
    append(summary.warnings, m_guides.warnings);
    summary.notes = names.notes;
    if (names.depth && m_guides.has_depth())
        summary.depth = names.depth->layer;
    if (!m_guides.has_position() && m_guides.has_depth() && m_options.position != "none")
        position_of_depth(summary);
    show(names, summary);
    stand_in(what, summary);
    find_footprint(what, summary);
}

void LocalGuides::show(const GBufferNames& names, CgTmoSummary& summary) {
    const auto use = [](const std::vector<float>(&plane)[3], const float*(&view)[3],
                        const std::optional<GuideChannels>& found, std::string& layer) {
        if (plane[0].empty())
            return;
        for (size_t c = 0; c < 3; ++c)
            view[c] = plane[c].data();
        if (found)
            layer = found->layer.empty() ? "plain" : found->layer;
    };
    use(m_guides.position, m_view.position, names.position, summary.position);
    use(m_guides.normal, m_view.normal, names.normal, summary.normal);
    use(m_guides.albedo, m_view.albedo, names.albedo, summary.albedo);
    if (!m_guides.background.empty())
        m_view.background = m_guides.background.data();
    summary.background = std::count_if(m_guides.background.begin(), m_guides.background.end(),
                                       [](uint8_t b) { return b != 0; });
}

void LocalGuides::stand_in(tonemap::LocalOperator& what, CgTmoSummary& summary) {
    const bool none = !m_view.position[0] && !m_view.normal[0] && !m_view.albedo[0];
    if (none && what.edges && !m_options.strict) {
        summary.notes.push_back("no guide among the layers: distance alone tells neighbours");
        return;
    }
    const std::tuple<const char*, bool> guides[] = {
        {"position", !m_view.position[0] && m_options.position != "none"},
        {"normal", !m_view.normal[0] && m_options.normal != "none"},
        {"albedo", !m_view.albedo[0] && m_options.albedo != "none"}};
    for (const auto& [name, missing] : guides) {
        if (!missing)
            continue;
        const std::string lack = format("no {} among the layers", name);
        if (m_options.strict)
            throw Refusal(lack + "; " + name + "= names one, \"none\" does without");
        summary.warnings.push_back(lack + ": its term is left out");
    }
    if (none && !what.edges && what.luminance_sigma == 0) {
        what.luminance_sigma = kLuminanceSigma;
        summary.warnings.push_back(
            format("without a guide only luminance tells edges: lumsigma={}", kLuminanceSigma));
    }
}

// Points on the rays of a camera that looks along the depth.
void LocalGuides::position_of_depth(CgTmoSummary& summary) {
    auto camera = find_camera(m_image.spec(), m_options.fov);
    const std::string lack =
        format("no position among the layers: it is made of \"{}\"", summary.depth);
    if (m_options.strict && !camera)
        throw Refusal(
            "no position among the layers, and its depth would need a field of view (fov=)");
    if (!camera) {
        camera = find_camera(m_image.spec(), kUsualView);
        summary.warnings.push_back(
            format("{} and a field of view of {} degrees (fov=)", lack, kUsualView));
    } else {
        summary.notes.push_back(lack);
    }
    const size_t size = m_guides.depth.size();
    for (auto& plane : m_guides.position)
        plane.resize(size);
    const OIIO::ImageSpec& spec = m_image.spec();
    const double middle_x = spec.full_x + 0.5 * spec.full_width - 0.5;
    const double middle_y = spec.full_y + 0.5 * spec.full_height - 0.5;
    make_parallel(m_nthreads)(m_region.height(), [&](int64_t row) {
        for (int col = 0; col < m_region.width(); ++col) {
            const size_t i = size_t(row) * size_t(m_region.width()) + size_t(col);
            const double z = double(m_guides.depth[i]);
            const double step = camera->parallel ? camera->step : camera->step * z;
            m_guides.position[0][i] = float((m_region.xbegin + col - middle_x) * step);
            m_guides.position[1][i] = float((m_region.ybegin + int(row) - middle_y) * step);
            m_guides.position[2][i] = float(z);
        }
    });
    m_of_depth = true;
    summary.position = "of " + summary.depth;
}

void LocalGuides::camera_footprints() {
    const auto camera = find_camera(m_image.spec(), m_options.fov);
    if (!camera)
        throw Refusal(
            "footprint=camera: the image has no worldToCamera and worldToNDC; fov= gives the "
            "horizontal field of view");
    if (!camera->parallel && !camera->to_camera && !m_guides.has_depth())
        throw Refusal(
            "footprint=camera: neither a depth layer nor worldToCamera tells how far pixels are");
    make_parallel(m_nthreads)(m_region.height(), [&](int64_t row) {
        for (int x = 0; x < m_region.width(); ++x) {
            const size_t i = size_t(row) * size_t(m_region.width()) + size_t(x);
            double z = camera->parallel ? 1 : 0;
            if (!camera->parallel && m_guides.has_depth())
                z = double(m_guides.depth[i]);
            else if (!camera->parallel)
                z = (Imath::V3d(m_guides.position[0][i], m_guides.position[1][i],
                                m_guides.position[2][i]) *
                     *camera->to_camera)
                        .z;
            m_footprints[i] = m_guides.background[i] ? 0 : float(std::abs(z) * camera->step);
        }
    });
}

void LocalGuides::find_footprint(tonemap::LocalOperator& what, CgTmoSummary& summary) {
    if (!m_view.position[0])
        return;
    if (const auto given = number_of(m_options.footprint)) {
        summary.footprint = what.terms.footprint = *given;
        check_range(*given, 1e-15, 1e15, "footprint");
        return;
    }
    check_one_of("footprint", m_options.footprint, {"pixel", "global", "camera", "a number"});
    m_footprints.resize(size_t(m_region.width()) * size_t(m_region.height()));
    m_footprints.expect_all_written();
    if (m_options.footprint == "camera") {
        camera_footprints();
    } else {
        tonemap::footprints(m_view,
                            m_guides.half_positions ? tonemap::kHalfStep : tonemap::kFloatStep,
                            m_footprints.data(), make_parallel(m_nthreads));
    }
    summary.footprint =
        tonemap::median_footprint(m_footprints.data(), m_region.width(), m_region.height());
    what.terms.footprint = summary.footprint > 0 ? summary.footprint : 1;
    if (m_options.footprint != "global")
        m_view.footprint = m_footprints.data();
}

} // namespace tonetool
