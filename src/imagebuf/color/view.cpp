// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/view.h"

#include <OpenImageIO/sysutil.h>
#include <algorithm>

#include "imagebuf/color/view_config.h"
#include "imagebuf/pixels/colorimetry.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

// What the header's tag names, unless that says only "linear" and chromaticities say more.
std::string tagged_space(const ChosenView& chosen, const OIIO::ImageSpec& header) {
    const std::string tag = header.get_string_attribute("oiio:ColorSpace");
    if (says_only_linear(tag) && header.find_attribute("chromaticities"))
        return {};
    const auto space = known_space(chosen, tag);
    return space ? space->getName() : "";
}

std::string valid_sources(const ChosenView& chosen) {
    return "; pass from= one of: " + OIIO::Strutil::join(scene_spaces(chosen), ", ");
}

std::string space_of_image(const ChosenView& chosen, const OIIO::ImageSpec& header) {
    if (const std::string tagged = tagged_space(chosen, header); !tagged.empty())
        return tagged;
    const auto with_its_own_names = [&](const std::string& why) {
        return why.substr(0, why.find("; pass from=")) + valid_sources(chosen);
    };
    const ColorSpace space =
        refusing_as(with_its_own_names, [&] { return find_space(header, ""); });
    const std::vector<std::string> names = interchange_names(space.name);
    if (const std::string found = find_scene_space(chosen, names); !found.empty())
        return found;
    const std::string tried =
        names.empty() ? "" : " (looked for " + OIIO::Strutil::join(names, ", ") + ")";
    throw Refusal("configuration \"" + chosen.file +
                  "\" has no space for an image of colour space " + space.name + tried +
                  valid_sources(chosen));
}

std::string find_source(const ChosenView& chosen, const std::string& wanted,
                        const OIIO::ImageSpec& header) {
    if (wanted.empty())
        return space_of_image(chosen, header);
    const auto space = known_space(chosen, wanted);
    if (!space)
        throw Refusal(unknown_name("colour space", wanted, scene_spaces(chosen)));
    return space->getName();
}

} // namespace

std::string config_file(const ViewOptions& options) {
    return options.config.empty() ? std::string(OIIO::Sysutil::getenv("OCIO")) : options.config;
}

struct ViewTransform::State {
    ocio::ConstCPUProcessorRcPtr processor;
};

void ViewTransform::open(const ViewOptions& options, const std::string& from,
                         const OIIO::ImageSpec& header) {
    const QuietOcio quiet;
    const ChosenView chosen = choose_view(options);
    const std::string source = find_source(chosen, from, header);
    const auto state = std::make_shared<State>();
    state->processor = make_processor(chosen, through_view(chosen, source));
    m_state = state;
    m_display = chosen.display;
    m_view = chosen.view;
    m_space = chosen.space;
    m_from = source;
}

void ViewTransform::apply(float* rgb, ptrdiff_t count) const {
    if (count <= 0)
        return;
    ocio::PackedImageDesc pixels(rgb, long(count), 1, 3);
    m_state->processor->apply(pixels);
}

} // namespace tonetool
