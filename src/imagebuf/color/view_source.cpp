#include "imagebuf/color/view_source.h"

#include <OpenImageIO/filesystem.h>
#include <ctime>
#include <mutex>

#include "imagebuf/color/view_config.h"
#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"

namespace tonetool {
namespace {

// Of the last space that was asked for: a comparison asks for the same one many times.
struct Kept {
    std::string config, from;
    std::vector<std::pair<std::string, std::string>> context;
    std::time_t written = 0;
    ColorSpace space;
};
std::mutex g_kept_lock;
Kept g_kept;

bool open_space(const PixelOptions& options, ColorSpace& space, std::string& error) {
    const QuietOcio quiet;
    ChosenView chosen;
    ViewOptions of_config;
    of_config.config = options.config;
    of_config.context = options.context;
    if (!open_config(of_config, chosen, error))
        return false;
    const auto found = known_space(chosen, options.from);
    if (!found) {
        error = unknown_name("colour space", options.from, scene_spaces(chosen));
        return false;
    }
    const SceneBridge bridge = find_bridge(chosen, options.from);
    const auto group = ocio::GroupTransform::Create();
    const auto to_bridge = ocio::ColorSpaceTransform::Create();
    to_bridge->setSrc(found->getName());
    to_bridge->setDst(bridge.space.c_str());
    group->appendTransform(to_bridge);
    group->appendTransform(matrix_transform(bridge.to_rec709, 1));
    ocio::ConstCPUProcessorRcPtr processor;
    if (!make_processor(chosen, group, processor, error))
        return false;
    space = {};
    space.name = found->getName();
    space.convert = [processor](float* rgb, ptrdiff_t count) {
        ocio::PackedImageDesc pixels(rgb, long(count), 1, 3);
        processor->apply(pixels);
    };
    return true;
}

} // namespace

bool config_space(const PixelOptions& options, ColorSpace& space, std::string& error) {
    return contained(error, [&](std::string& why) {
        const std::lock_guard<std::mutex> hold(g_kept_lock);
        const Kept asked{options.config,
                         options.from,
                         options.context,
                         OIIO::Filesystem::last_write_time(options.config),
                         {}};
        const bool same = asked.config == g_kept.config && asked.from == g_kept.from &&
                          asked.context == g_kept.context && asked.written == g_kept.written;
        if (!same) {
            Kept next = asked;
            if (!open_space(options, next.space, why))
                return false;
            g_kept = next;
        }
        space = g_kept.space;
        return true;
    });
}

} // namespace tonetool
