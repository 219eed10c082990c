// SPDX-License-Identifier: BSD-3-Clause
#include "program/doctor.h"

#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <cstdio>
#include <cstdlib>
#include <dlfcn.h>
#include <filesystem>

#include "chain/session/call.h"
#include "chain/session/session.h"
#include "text/error.h"

namespace tonetool {

namespace {

namespace fs = std::filesystem;

constexpr char kPluginName[] = "tone.imageio.so";
constexpr char kPluginSuffix[] = ".imageio.so";

// What a command of the shell prints; empty if it cannot be run.
std::string output_of(const std::string& command) {
    std::string text;
    if (std::FILE* pipe = popen((command + " 2>/dev/null").c_str(), "r")) {
        char buffer[4096];
        for (size_t n = 0; (n = std::fread(buffer, 1, sizeof buffer, pipe)) > 0;)
            text.append(buffer, n);
        pclose(pipe);
    }
    return std::string(OIIO::Strutil::strip(text));
}

// Installed, or in the folder of a build; empty if it is in neither.
std::string own_plugin() {
    const fs::path program = fs::path(OIIO::Sysutil::this_program_path()).parent_path();
    for (const char* place : {TONETOOL_INSTALLED_PLUGIN, "../tone.imageio"}) {
        std::error_code problem;
        const fs::path file = fs::canonical(program / place / kPluginName, problem);
        if (!problem)
            return file.string();
    }
    return "";
}

Strings folders_of(const char* variable) {
    const char* value = std::getenv(variable);
    return value && *value ? split(value, ':') : Strings();
}

// Where OpenImageIO looks, of the versions that have this one's plugins.
Strings searched_folders() {
    Strings all = folders_of("OIIO_LIBRARY_PATH");
    Strings more;
    for (const std::string& option : folders_of("OPENIMAGEIO_OPTIONS"))
        if (OIIO::Strutil::starts_with(option, "plugin_searchpath="))
            more.push_back(option.substr(option.find('=') + 1));
    const Strings other = OIIO_VERSION < 20500   ? folders_of("LD_LIBRARY_PATH")
                          : OIIO_VERSION < 20600 ? Strings()
                                                 : folders_of("OPENIMAGEIO_PLUGIN_PATH");
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), other.begin(), other.end());
    return all;
}

// What is wrong with a plugin where it is; empty if nothing is.
std::string fault_of(const fs::path& file) {
    void* library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library) {
        const char* why = dlerror();
        return "cannot be loaded: " + std::string(why ? why : "unknown error");
    }
    const auto* version = static_cast<const int*>(dlsym(library, "tone_imageio_version"));
    if (!version)
        return "is not tonetool's plugin";
    if (*version != OIIO_PLUGIN_VERSION) {
        return "is of plugin version " + std::to_string(*version) + ", not " +
               std::to_string(OIIO_PLUGIN_VERSION);
    }
    const std::string name = file.filename().string();
    return name == kPluginName ? "" : "is named so, but must be named " + std::string(kPluginName);
}

// Faults of all plugins in a folder that are ours, or should be; one line each.
Strings faults_in(const std::string& folder) {
    std::error_code problem;
    if (!fs::is_directory(folder, problem))
        return {"\"" + folder + "\" is no folder"};
    Strings faults;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, problem)) {
        const std::string name = entry.path().filename().string();
        if (OIIO::Strutil::ends_with(name, kPluginSuffix)) {
            const std::string fault = fault_of(entry.path());
            const bool other = fault == "is not tonetool's plugin" && name != kPluginName;
            if (!fault.empty() && !other)
                faults.push_back(entry.path().string() + " " + fault);
        }
    }
    return faults;
}

bool is_of_this_version(const std::string& version) {
    const Strings numbers = split(version, '.');
    return numbers.size() >= 2 && numbers[0] == std::to_string(OIIO_VERSION_MAJOR) &&
           numbers[1] == std::to_string(OIIO_VERSION_MINOR);
}

std::string why_not_found(const std::string& version, const Strings& folders) {
    if (!is_of_this_version(version)) {
        return "oiiotool is of OpenImageIO " + version +
               ", the plugin of " OIIO_VERSION_STRING
               " (valid: a tonetool that was built with the same)";
    }
    Strings faults;
    for (const std::string& folder : folders) {
        const Strings more = faults_in(folder);
        faults.insert(faults.end(), more.begin(), more.end());
    }
    if (!faults.empty())
        return join(faults, "; ");
    return folders.empty() ? "OIIO_LIBRARY_PATH is not set"
                           : "no " + std::string(kPluginName) + " in " + join(folders, ", ");
}

// The line is for a shell.
std::string mending_line(const std::string& plugin) {
    const std::string folder = fs::path(plugin).parent_path().string();
    return "export OIIO_LIBRARY_PATH=" + shell_quoted(folder) +
           "${OIIO_LIBRARY_PATH:+:$OIIO_LIBRARY_PATH}";
}

void run_doctor(chain::Session& session, const chain::Call& call) {
    session.outcome.produced = true;
    const std::string plugin = own_plugin();
    const std::string program = output_of("command -v oiiotool");
    const std::string version = program.empty() ? "" : output_of("oiiotool --version");
    const Strings folders = searched_folders();
    Lines lines(call.row().label());
    lines.add("plugin", plugin.empty() ? "none" : plugin);
    lines.add("plugin-version",
              std::to_string(OIIO_PLUGIN_VERSION) + ", OpenImageIO " OIIO_VERSION_STRING);
    lines.add("oiiotool", program.empty() ? "none" : program + ", OpenImageIO " + version);
    lines.add("searched", folders.empty() ? "nothing" : join(folders, ", "));
    session.print(lines.text);
    if (program.empty())
        throw CommandError("there is no oiiotool on the PATH");
    if (output_of("oiiotool --list-formats").find("tone : tone") != std::string::npos) {
        session.print(call.row().label() + ": oiiotool reads recipes");
        return;
    }
    session.print(call.row().label() + ": oiiotool does not read recipes");
    const std::string why = why_not_found(version, folders);
    if (plugin.empty())
        throw CommandError(why + "; and the plugin is not installed with this program");
    throw CommandError(why + "; this line mends it:\n" + mending_line(plugin));
}

} // namespace

chain::Rows doctor_commands() {
    return {chain::command("doctor",
                           "Tell whether oiiotool reads recipes by the plugin, and if not why",
                           run_doctor)
                .of_process()};
}

} // namespace tonetool
