#include "imagebuf/color/view.h"

#include <OpenImageIO/sysutil.h>
#include <algorithm>

#include "imagebuf/color/view_config.h"
#include "imagebuf/pixels/colorimetry.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"

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

bool space_of_image(const ChosenView& chosen, const OIIO::ImageSpec& header, std::string& from,
                    std::string& error) {
    from = tagged_space(chosen, header);
    if (!from.empty())
        return true;
    ColorSpace space;
    if (!find_space(header, "", space, error)) {
        // Its own names are not those of the configuration.
        error.resize(std::min(error.size(), error.find("; pass from=")));
        error += valid_sources(chosen);
        return false;
    }
    const std::vector<std::string> names = interchange_names(space.name);
    from = find_scene_space(chosen, names);
    if (!from.empty())
        return true;
    const std::string tried =
        names.empty() ? "" : " (looked for " + OIIO::Strutil::join(names, ", ") + ")";
    error = "configuration \"" + chosen.file + "\" has no space for an image of colour space " +
            space.name + tried + valid_sources(chosen);
    return false;
}

bool find_source(const ChosenView& chosen, const std::string& wanted, const OIIO::ImageSpec& header,
                 std::string& from, std::string& error) {
    if (wanted.empty())
        return space_of_image(chosen, header, from, error);
    const auto space = known_space(chosen, wanted);
    if (space)
        from = space->getName();
    else
        error = unknown_name("colour space", wanted, scene_spaces(chosen));
    return space != nullptr;
}

} // namespace

std::string config_file(const ViewOptions& options) {
    return options.config.empty() ? std::string(OIIO::Sysutil::getenv("OCIO")) : options.config;
}

struct ViewTransform::State {
    ocio::ConstCPUProcessorRcPtr processor;
};

bool ViewTransform::open(const ViewOptions& options, const std::string& from,
                         const OIIO::ImageSpec& header, std::string& error) {
    return contained(error, [&](std::string& why) {
        const QuietOcio quiet;
        ChosenView chosen;
        std::string source;
        if (!choose_view(options, chosen, why) || !find_source(chosen, from, header, source, why))
            return false;
        const auto state = std::make_shared<State>();
        if (!make_processor(chosen, through_view(chosen, source), state->processor, why))
            return false;
        m_state = state;
        m_display = chosen.display;
        m_view = chosen.view;
        m_space = chosen.space;
        m_from = source;
        return true;
    });
}

void ViewTransform::apply(float* rgb, ptrdiff_t count) const {
    if (count <= 0)
        return;
    ocio::PackedImageDesc pixels(rgb, long(count), 1, 3);
    m_state->processor->apply(pixels);
}

} // namespace tonetool
