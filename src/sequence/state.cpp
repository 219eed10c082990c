#include "sequence/state.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "include/tonetool/tonetool.h"
#include "include/tonetool/write.h"
#include "sequence/json_text.h"
#include "sequence/shot_exposures.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;
using OIIO::Strutil::fmt::format;
namespace fs = std::filesystem;

constexpr char state_format[] = "tonetool-state";
constexpr int state_version = 1;

// [name, size, time] of a regular file; null for anything else.
ordered_json stamp(const std::string& name) {
    std::error_code none;
    if (!fs::is_regular_file(name, none)) {
        return nullptr;
    }
    const auto written = fs::last_write_time(name, none).time_since_epoch().count();
    return {name, fs::file_size(name, none), written};
}

// The word, and what stands behind the = of its modifiers.
std::vector<std::string> names_in(const std::string& word) {
    std::vector<std::string> names{word};
    for (const std::string& piece : OIIO::Strutil::splits(word, ":")) {
        const size_t equals = piece.find('=');
        if (equals != std::string::npos) {
            std::string value = piece.substr(equals + 1);
            value = std::string(OIIO::Strutil::strip(value, "'\""));
            names.push_back(value);
        }
    }
    return names;
}

ordered_json stamps_of(const std::vector<std::string>& words) {
    ordered_json stamps = ordered_json::array();
    for (const std::string& word : words) {
        for (const std::string& name : names_in(word)) {
            const ordered_json one = stamp(name);
            if (!one.is_null()) {
                stamps.push_back(one);
            }
        }
    }
    return stamps;
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

std::string State::key(const Origin& origin) {
    const std::string config(OIIO::Sysutil::getenv("OCIO"));
    std::vector<std::string> words = origin.words;
    words.push_back(config);
    // Outputs are no inputs, though the words name them.
    for (const std::string& output : origin.outputs) {
        words.erase(std::remove(words.begin(), words.end(), output), words.end());
    }
    return dumped({{"program", TONETOOL_VERSION},
                   {"words", origin.words},
                   {"rest", origin.rest},
                   {"ocio", config},
                   {"inputs", stamps_of(words)}});
}

std::string State::file(const Item& item) const {
    return m_folder + "/" + m_kind + format(".{:04d}", item.frame) +
           (item.view.empty() ? "" : "." + safe(item.view)) + ".json";
}

std::optional<Kept> State::find(const Item& item, const std::string& key) const {
    if (!OIIO::Filesystem::is_regular(file(item))) {
        return std::nullopt;
    }
    try {
        return parsed(read_text(file(item)), [&](const ordered_json& from) -> std::optional<Kept> {
            check_format(from, state_format, state_version);
            if (from.at("key").get<std::string>() != key) {
                return std::nullopt;
            }
            for (const ordered_json& output : from.at("outputs")) {
                if (stamp(output.at(0).get<std::string>()) != output) {
                    return std::nullopt;
                }
            }
            return Kept{from.at("result").get<std::string>(), from.at("out").get<std::string>(),
                        from.at("err").get<std::string>(), from.at("status").get<int>()};
        });
    } catch (const std::runtime_error&) {
        return std::nullopt; // of another version, or damaged: made anew
    }
}

void State::keep(const Item& item, const std::string& key, const Origin& origin,
                 const Kept& kept) const {
    const std::string text = dumped({{"format", state_format},
                                     {"version", state_version},
                                     {"key", key},
                                     {"outputs", stamps_of(origin.outputs)},
                                     {"status", kept.status},
                                     {"out", kept.out},
                                     {"err", kept.err},
                                     {"result", kept.result}});
    std::string why;
    if (!write_bytes(text, file(item), why)) {
        throw std::runtime_error("--state: " + why);
    }
}

} // namespace tonetool::sequence
