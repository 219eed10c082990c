// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/view_config.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <cctype>
#include <mutex>
#include <sstream>

#include "imagebuf/color/view.h"
#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using Names = std::vector<std::string>;

// OpenColorIO has one level of logging for the process.
std::mutex g_quiet_lock;
int g_quiet = 0;
ocio::LoggingLevel g_level = ocio::LOGGING_LEVEL_DEFAULT;

bool same_name(const std::string& a, const std::string& b) {
    return OIIO::Strutil::iequals(a, b);
}

// As the list spells it.
bool find_name(const Names& names, std::string& name) {
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&](const std::string& n) { return same_name(n, name); });
    if (found == names.end())
        return false;
    name = *found;
    return true;
}

// Of a profile that is newer than this OpenColorIO, which may say no more than a parser does.
std::string version_remark(const std::string& file) {
    std::string text, version;
    if (!OIIO::Filesystem::read_text_file(file, text))
        return {};
    for (const auto& line : OIIO::Strutil::splitsv(text, "\n"))
        if (OIIO::Strutil::starts_with(line, "ocio_profile_version:"))
            version = OIIO::Strutil::strip(line.substr(line.find(':') + 1));
    const int hex = ocio::GetVersionHex();
    const int major = hex >> 24, minor = (hex >> 16) & 0xff;
    const Names parts = OIIO::Strutil::splits(version, ".");
    if (parts.empty() || !OIIO::Strutil::string_is_int(parts[0]))
        return {};
    const int profile_major = OIIO::Strutil::stoi(parts[0]);
    const int profile_minor = parts.size() > 1 ? OIIO::Strutil::stoi(parts[1]) : 0;
    if (profile_major < major || (profile_major == major && profile_minor <= minor))
        return {};
    return format("it is of profile version {}, and OpenColorIO {} reads versions up to {}.{}",
                  version, ocio::GetVersion(), major, minor);
}

// Without the words that the message around it says already.
std::string loading_error(const std::string& file, const char* what) {
    std::string remark = version_remark(file);
    if (!remark.empty())
        return remark;
    const std::string text = one_line(what);
    const std::string start = "Error: Loading the OCIO profile '" + file + "' failed. ";
    return OIIO::Strutil::starts_with(text, start) ? text.substr(start.size()) : text;
}

void choose_display(const std::string& wanted, ChosenView& chosen) {
    const ocio::Config& config = *chosen.config;
    Names active, all;
    for (int i = 0; i < config.getNumDisplays(); ++i)
        active.emplace_back(config.getDisplay(i));
    for (int i = 0; i < config.getNumDisplaysAll(); ++i)
        all.emplace_back(config.getDisplayAll(i));
    chosen.display = wanted.empty() ? config.getDefaultDisplay() : wanted;
    if (chosen.display.empty())
        throw Refusal("configuration \"" + chosen.file + "\" has no displays");
    if (!find_name(all, chosen.display))
        throw Refusal(unknown_name("display", chosen.display, active));
}

void choose_view_of_display(const std::string& wanted, ChosenView& chosen) {
    const ocio::Config& config = *chosen.config;
    const char* display = chosen.display.c_str();
    Names active, all;
    for (int i = 0; i < config.getNumViews(display); ++i)
        active.emplace_back(config.getView(display, i));
    all = active;
    for (const auto type : {ocio::VIEW_DISPLAY_DEFINED, ocio::VIEW_SHARED})
        for (int i = 0; i < config.getNumViews(type, display); ++i)
            all.emplace_back(config.getView(type, display, i));
    chosen.view = wanted.empty() ? config.getDefaultView(display) : wanted;
    if (chosen.view.empty())
        throw Refusal("display \"" + chosen.display + "\" has no views");
    if (!find_name(all, chosen.view))
        throw Refusal(unknown_name("view", chosen.view, active) + " (of display \"" +
                      chosen.display + "\")");
}

// The space of the view's result; shared views may mean that of each display.
void find_result_space(ChosenView& chosen) {
    const std::string name =
        chosen.config->getDisplayViewColorSpaceName(chosen.display.c_str(), chosen.view.c_str());
    chosen.space = name == ocio::OCIO_VIEW_USE_DISPLAY_NAME ? chosen.display : name;
    const auto space = known_space(chosen, chosen.space);
    if (!space)
        throw Refusal(format("view \"{}\" of display \"{}\" wants the colour space \"{}\", which "
                             "configuration \"{}\" does not have",
                             chosen.view, chosen.display, chosen.space, chosen.file));
    chosen.space = space->getName();
    chosen.display_space = space->getReferenceSpaceType() == ocio::REFERENCE_SPACE_DISPLAY;
}

void check_looks(const std::string& looks, const ChosenView& chosen) {
    Names known;
    for (int i = 0; i < chosen.config->getNumLooks(); ++i)
        known.emplace_back(chosen.config->getLookNameByIndex(i));
    bool any = false;
    for (std::string look : OIIO::Strutil::splits(
             OIIO::Strutil::replace(OIIO::Strutil::replace(looks, "|", ",", true), ":", ",", true),
             ",")) {
        look = OIIO::Strutil::strip(look);
        if (!look.empty() && (look[0] == '+' || look[0] == '-'))
            look = OIIO::Strutil::strip(look.substr(1));
        if (look.empty())
            continue;
        any = true;
        if (!chosen.config->getLook(look.c_str()))
            throw Refusal(unknown_name("look", look, known));
    }
    if (!any)
        throw Refusal("looks \"" + looks + "\" name no look");
}

// A view of the same making in an edited configuration. Stock oiiotool 2.4.7 drops looks silently.
void add_looks(const std::string& looks, ChosenView& chosen) {
    const char* display = chosen.display.c_str();
    const ocio::ConfigRcPtr config = chosen.config->createEditableCopy();
    const std::string transform = config->getDisplayViewTransformName(display, chosen.view.c_str());
    chosen.looked_at = chosen.view + " with looks";
    if (transform.empty())
        config->addDisplayView(display, chosen.looked_at.c_str(), chosen.space.c_str(),
                               looks.c_str());
    else
        config->addDisplayView(display, chosen.looked_at.c_str(), transform.c_str(),
                               chosen.space.c_str(), looks.c_str(), "", "");
    chosen.config = config;
}

// Names behind '$', in "${}" and between '%' signs.
Names variables_in(const std::string& text) {
    Names names;
    for (size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '$' && text[i] != '%')
            continue;
        const size_t begin = i + (text.compare(i, 2, "${") == 0 ? 2 : 1);
        size_t end = begin;
        while (end < text.size() &&
               (std::isalnum(static_cast<unsigned char>(text[end])) || text[end] == '_'))
            ++end;
        const bool closed = text[i] == '$' || (end < text.size() && text[end] == '%');
        const std::string name = text.substr(begin, end - begin);
        if (closed && !name.empty() && std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    }
    return names;
}

// Variables that the configuration declares, or refers to anywhere.
Names variables_of(const ocio::Config& config, std::string& text) {
    std::ostringstream out;
    config.serialize(out);
    text = out.str();
    Names names = variables_in(text);
    for (int i = 0; i < config.getNumEnvironmentVars(); ++i)
        if (const std::string name = config.getEnvironmentVarNameByIndex(i);
            std::find(names.begin(), names.end(), name) == names.end())
            names.push_back(name);
    return names;
}

// OpenColorIO takes any name and lets it be.
void check_context(const ViewOptions& options, const ocio::Config& config,
                   const std::string& start) {
    if (options.context.empty())
        return;
    std::string text;
    const Names known = variables_of(config, text);
    for (const auto& [name, value] : options.context)
        text += " " + value; // which may refer to others
    for (const auto& [name, value] : options.context) {
        if (name.empty())
            throw Refusal("a context variable of value \"" + value + "\" has no name");
        const bool declared = std::find(known.begin(), known.end(), name) != known.end();
        const auto used = [&, n = name](const std::string& in) {
            return text.find(in) != std::string::npos;
        };
        // "$SHOT_v2" is SHOT, too, where that is the longest name that is set.
        if (declared || used("$" + name) || used("${" + name + "}") || used("%" + name + "%"))
            continue;
        throw Refusal(start + unknown_name("context variable", name, known));
    }
}

} // namespace

ChosenView open_config(const ViewOptions& options) {
    ChosenView chosen;
    chosen.file = config_file(options);
    const std::string named = options.config.empty() ? " (from the environment variable OCIO)" : "";
    if (chosen.file.empty())
        throw Refusal(
            "no configuration of OpenColorIO: name a file, or set the environment variable OCIO");
    const std::string start = "configuration \"" + chosen.file + "\"" + named + ": ";
    const bool built_in = OIIO::Strutil::contains(chosen.file, "://");
    if (!built_in && !OIIO::Filesystem::is_regular(chosen.file))
        throw Refusal(start +
                      (OIIO::Filesystem::exists(chosen.file) ? "is not a file" : "does not exist"));
    try {
        chosen.config = ocio::Config::CreateFromFile(chosen.file.c_str());
    } catch (const ocio::Exception& e) {
        throw Refusal(start + loading_error(chosen.file, e.what()));
    }
    check_context(options, *chosen.config, start);
    const ocio::ContextRcPtr context = chosen.config->getCurrentContext()->createEditableCopy();
    for (const auto& [name, value] : options.context)
        context->setStringVar(name.c_str(), value.c_str());
    chosen.context = context;
    return chosen;
}

QuietOcio::QuietOcio() {
    const std::lock_guard<std::mutex> hold(g_quiet_lock);
    if (g_quiet++ > 0)
        return;
    g_level = ocio::GetLoggingLevel();
    ocio::SetLoggingLevel(ocio::LOGGING_LEVEL_NONE);
}

QuietOcio::~QuietOcio() {
    const std::lock_guard<std::mutex> hold(g_quiet_lock);
    if (--g_quiet == 0)
        ocio::SetLoggingLevel(g_level);
}

ChosenView choose_view(const ViewOptions& options) {
    ChosenView chosen = open_config(options);
    choose_display(options.display, chosen);
    choose_view_of_display(options.view, chosen);
    find_result_space(chosen);
    chosen.looked_at = chosen.view;
    if (!options.looks.empty()) {
        check_looks(options.looks, chosen);
        add_looks(options.looks, chosen);
    }
    return chosen;
}

ocio::ConstTransformRcPtr through_view(const ChosenView& chosen, const std::string& from) {
    const auto transform = ocio::DisplayViewTransform::Create();
    transform->setSrc(from.c_str());
    transform->setDisplay(chosen.display.c_str());
    transform->setView(chosen.looked_at.c_str());
    return transform;
}

ocio::ConstCPUProcessorRcPtr make_processor(const ChosenView& chosen,
                                            const ocio::ConstTransformRcPtr& transform) {
    try {
        return chosen.config->getProcessor(chosen.context, transform, ocio::TRANSFORM_DIR_FORWARD)
            ->getDefaultCPUProcessor();
    } catch (const ocio::Exception& e) {
        throw Refusal(format("view \"{}\" of display \"{}\", configuration \"{}\": {}", chosen.view,
                             chosen.display, chosen.file, one_line(e.what())));
    }
}

ocio::ConstColorSpaceRcPtr known_space(const ChosenView& chosen, const std::string& name) {
    return name.empty() ? nullptr : chosen.config->getColorSpace(name.c_str());
}

std::string find_scene_space(const ChosenView& chosen, const std::vector<std::string>& names) {
    for (const std::string& name : names)
        if (const auto space = known_space(chosen, name);
            space && !space->isData() &&
            space->getReferenceSpaceType() == ocio::REFERENCE_SPACE_SCENE)
            return space->getName();
    return {};
}

std::vector<std::string> scene_spaces(const ChosenView& chosen) {
    const auto visible = ocio::COLORSPACE_ACTIVE;
    const auto scene = ocio::SEARCH_REFERENCE_SPACE_SCENE;
    Names names;
    for (int i = 0; i < chosen.config->getNumColorSpaces(scene, visible); ++i)
        names.emplace_back(chosen.config->getColorSpaceNameByIndex(scene, visible, i));
    return names;
}

ocio::MatrixTransformRcPtr matrix_transform(const Matrix3& m, double scale) {
    double values[16] = {};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            values[4 * i + j] = m[i][j] * scale;
    values[15] = 1;
    auto transform = ocio::MatrixTransform::Create();
    transform->setMatrix(values);
    return transform;
}

namespace {

// The space that the others are defined by, which has no transform of its own.
std::string reference_space(const ChosenView& chosen) {
    for (const std::string& name : scene_spaces(chosen)) {
        const auto space = chosen.config->getColorSpace(name.c_str());
        if (space && !space->isData() && !space->getTransform(ocio::COLORSPACE_DIR_TO_REFERENCE) &&
            !space->getTransform(ocio::COLORSPACE_DIR_FROM_REFERENCE))
            return name;
    }
    return {};
}

} // namespace

SceneBridge find_bridge(const ChosenView& chosen, const std::string& from) {
    const auto by_name = [&](const std::string& known) {
        return SceneBridge{find_scene_space(chosen, interchange_names(known)),
                           known_to_rec709(known)};
    };
    if (const SceneBridge rec709 = by_name("rec709"); !rec709.space.empty())
        return rec709;
    if (const std::string aces = find_scene_space(chosen, {ocio::ROLE_INTERCHANGE_SCENE});
        !aces.empty())
        return {aces, known_to_rec709("aces2065-1")};
    for (const std::string& known : linear_spaces())
        if (const SceneBridge bridge = by_name(known); !bridge.space.empty())
            return bridge;
    if (const auto xyz = known_space(chosen, ocio::ROLE_INTERCHANGE_DISPLAY))
        return {xyz->getName(), xyz_to_rec709()};
    if (from.empty())
        return {};
    SceneBridge stand_in;
    stand_in.space =
        find_scene_space(chosen, {ocio::ROLE_SCENE_LINEAR, ocio::ROLE_RENDERING,
                                  ocio::ROLE_REFERENCE, reference_space(chosen), from});
    return stand_in;
}

std::string one_line(const char* message) {
    return OIIO::Strutil::join(OIIO::Strutil::splits(message), " ");
}

} // namespace tonetool
