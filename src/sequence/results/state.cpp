// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/state.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <filesystem>
#include <map>
#include <mutex>
#include <regex>
#include <set>
#include <stdexcept>

#include "sequence/results/json_text.h"
#include "sequence/results/shot_exposures.h"
#include "tonetool/tonemap.h"
#include "tonetool/tonetool.h"
#include "tonetool/write.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;
namespace fs = std::filesystem;

constexpr char kStateFormat[] = "tonetool-state";
constexpr int kStateVersion = 3;

ordered_json json_of(const Stamp& stamp) {
    return {stamp.file, stamp.device, stamp.inode, stamp.size, stamp.written, stamp.changed};
}

Stamp stamp_from(const ordered_json& from) {
    return {from.at(0).get<std::string>(), from.at(1).get<uint64_t>(), from.at(2).get<uint64_t>(),
            from.at(3).get<uint64_t>(),    from.at(4).get<int64_t>(),  from.at(5).get<int64_t>()};
}

ordered_json json_of(const Stamps& stamps) {
    ordered_json all = ordered_json::array();
    for (const Stamp& stamp : stamps)
        all.push_back(json_of(stamp));
    return all;
}

bool are_current(const ordered_json& stamps) {
    return std::all_of(stamps.begin(), stamps.end(), [](const ordered_json& from) {
        const Stamp stamp = stamp_from(from);
        return stamp_of(stamp.file) == stamp;
    });
}

// LUTs are read by OpenColorIO and not by the chain, with the configuration that refers to them.
void note_luts(const std::string& config) {
    std::vector<std::string> files;
    std::string why;
    if (files_behind(config).empty() && ToneAlgo::color_config_files(config, files, why)) {
        files.push_back(config);
        note_files_behind(config, files);
    }
}

// All files that were read for the files of a run: recipes and configurations read others.
Stamps stamps_behind(const Stamps& inputs) {
    Stamps all;
    std::vector<std::string> names;
    for (const Stamp& input : inputs)
        names.push_back(input.file);
    for (size_t i = 0; i < names.size(); ++i) {
        if (OIIO::Strutil::iends_with(names[i], ".ocio"))
            note_luts(names[i]);
        for (const std::string& name : ToneAlgo::lut_references(names[i]))
            note_files_behind(names[i], {name});
        for (const std::string& name : files_behind(names[i])) {
            if (std::find(names.begin(), names.end(), name) == names.end()) {
                names.push_back(name);
                all.push_back(stamp_of(name));
            }
        }
    }
    return all;
}

std::set<std::string> variables_in(const std::string& config) {
    static const std::regex variable(R"(\$\{?(\w+)|%(\w+)%)");
    std::set<std::string> names;
    std::string text;
    OIIO::Filesystem::read_text_file(config, text);
    for (std::sregex_iterator match(text.begin(), text.end(), variable), end; match != end; ++match)
        names.insert((*match)[1].matched ? (*match)[1] : (*match)[2]);
    return names;
}

// The environment variables that configurations among the files name, with their values. A
// configuration is read again only if it has changed.
ordered_json variables_of(const Stamps& inputs) {
    static std::mutex mutex;
    static std::map<std::string, std::pair<Stamp, std::set<std::string>>> known;
    const std::lock_guard<std::mutex> lock(mutex);
    ordered_json values = ordered_json::object();
    for (const Stamp& input : inputs) {
        if (!OIIO::Strutil::iends_with(input.file, ".ocio"))
            continue;
        auto& [stamp, names] = known[input.file];
        if (stamp != input) {
            names = variables_in(input.file);
            stamp = input;
        }
        for (const std::string& name : names)
            values[name] = std::string(OIIO::Sysutil::getenv(name));
    }
    return values;
}

bool are_set(const ordered_json& variables) {
    return std::all_of(variables.items().begin(), variables.items().end(), [](const auto& one) {
        return OIIO::Sysutil::getenv(one.key()) == one.value().template get<std::string>();
    });
}

std::string safe(const std::string& view) {
    std::string name;
    for (const char c : view) {
        const bool plain = OIIO::Strutil::contains("-_", OIIO::string_view(&c, 1)) ||
                           (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') ||
                           (c >= 'a' && c <= 'z');
        name += plain ? std::string(1, c) : format("%{:02X}", int(static_cast<unsigned char>(c)));
    }
    return name;
}

std::string ocio_variable() {
    return std::string(OIIO::Sysutil::getenv("OCIO"));
}

// Of a case: a name that no frame's file has, and that a folder can hold.
std::string case_part(const Item& item) {
    constexpr size_t most = 180;
    const std::string whole = "@" + safe(item.name) + "@" + safe(item.method);
    return !item.named() ? ""
           : whole.size() <= most
               ? whole
               : whole.substr(0, most) + format("@{:016x}", OIIO::Strutil::strhash(whole));
}

std::string key_of(const Origin& origin) {
    return dumped({{"program", TONETOOL_VERSION},
                   {"words", origin.words},
                   {"rest", origin.rest},
                   {"ocio", ocio_variable()}});
}

} // namespace

State::State(std::string folder, std::string kind)
    : m_folder(std::move(folder)),
      m_kind(std::move(kind)) {
    std::error_code why;
    fs::create_directories(m_folder, why);
    std::error_code none;
    if (!fs::is_directory(m_folder, none)) {
        throw std::runtime_error("--state: cannot make the folder \"" + m_folder + "\"" +
                                 (why ? ": " + why.message() : ", which is a file"));
    }
}

std::string State::file(const Item& item) const {
    return m_folder + "/" + m_kind + case_part(item) + format(".{:04d}", item.frame) +
           (item.view.empty() ? "" : "." + safe(item.view)) + ".json";
}

std::optional<Kept> State::find(const Item& item, const Origin& origin) const {
    std::error_code none;
    if (fs::symlink_status(file(item), none).type() != fs::file_type::regular)
        return std::nullopt;
    try {
        return parsed(read_text(file(item)), [&](const ordered_json& from) -> std::optional<Kept> {
            check_format(from, kStateFormat, kStateVersion);
            if (from.at("key").get<std::string>() != key_of(origin) ||
                !are_current(from.at("inputs")) || !are_current(from.at("outputs")) ||
                !are_set(from.at("variables")))
                return std::nullopt;
            Kept kept{from.at("result").get<std::string>(), from.at("out").get<std::string>(),
                      from.at("err").get<std::string>(), from.at("status").get<int>()};
            for (const ordered_json& output : from.at("outputs"))
                kept.written.push_back(stamp_from(output).file);
            return kept;
        });
    } catch (const std::runtime_error&) {
        return std::nullopt; // another version, or damaged: the frame is checked anew
    }
}

void State::keep(const Item& item, const Origin& origin, const FileLog& inputs,
                 const Kept& kept) const {
    FileLog log = inputs;
    if (!ocio_variable().empty())
        log.note(ocio_variable());
    const Stamps behind = stamps_behind(log.stamps());
    // A file that changed while the frame was checked may have been read before or after the
    // change.
    if (!is_current(log.stamps()) || !are_older(behind, inputs.begun()))
        return;
    Stamps all = log.stamps();
    all.insert(all.end(), behind.begin(), behind.end());
    Stamps outputs;
    for (const std::string& output : kept.written)
        outputs.push_back(stamp_of(output));
    const std::string text = dumped({{"format", kStateFormat},
                                     {"version", kStateVersion},
                                     {"key", key_of(origin)},
                                     {"inputs", json_of(all)},
                                     {"outputs", json_of(outputs)},
                                     {"variables", variables_of(all)},
                                     {"status", kept.status},
                                     {"out", kept.out},
                                     {"err", kept.err},
                                     {"result", kept.result}});
    std::string why;
    if (!write_bytes(text, file(item), why, Links::Refuse))
        throw std::runtime_error("--state: " + why);
}

} // namespace tonetool::sequence
