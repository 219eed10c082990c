// SPDX-License-Identifier: BSD-3-Clause
// How the temporary files of outputs are called, beside their targets.
#pragma once

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <cstdint>
#include <string>
#include <unistd.h>

namespace tonetool {

/// Eight digits that tell this machine's temporary files from those of others that write to the
/// same folder: their processes cannot be looked for here.
inline const std::string& machine_tag() {
    static const std::string tag = [] {
        char name[256] = "";
        (void)::gethostname(name, sizeof name - 1);
        uint32_t hash = 2166136261U; // FNV-1a
        for (const char* c = name; *c; ++c)
            hash = (hash ^ static_cast<unsigned char>(*c)) * 16777619U;
        return OIIO::Strutil::fmt::format("{:08x}", hash);
    }();
    return tag;
}

/// ".shot.exr.4711-0-89abcdef.exr": the extension stays, some writers look at it.
inline std::string temporary_name(const std::string& base, long process, unsigned counter,
                                  const std::string& machine = machine_tag()) {
    return "." + base + OIIO::Strutil::fmt::format(".{}-{}-{}", process, counter, machine) +
           OIIO::Filesystem::extension(base);
}

/// ".shot.exr.4711-0-89abcdef.0123abcd.temp.exr": how make_texture calls what it opens when it is
/// told to write such a file. Returns the name without that.
inline std::string without_texture_part(const std::string& name) {
    static const std::string kEnd = ".temp";
    const std::string tail = OIIO::Filesystem::extension(name);
    for (const std::string& extension : {tail, std::string()}) {
        const std::string stem = name.substr(0, name.size() - extension.size());
        const size_t added = 9 + kEnd.size(); // ".%%%%%%%%.temp"
        if (stem.size() > added && stem[stem.size() - added] == '.' &&
            stem.compare(stem.size() - kEnd.size(), kEnd.size(), kEnd) == 0)
            return stem.substr(0, stem.size() - added) + extension;
    }
    return name;
}

/// What a temporary file's name says.
struct TemporaryName {
    std::string base; ///< "shot.exr"; empty where it is the name of another file
    std::string machine;
};

inline TemporaryName parse_temporary_name(const std::string& file) {
    const std::string name = without_texture_part(file);
    const auto all_of = [](const std::string& text, const char* valid) {
        return !text.empty() && text.find_first_not_of(valid) == std::string::npos;
    };
    const std::string tail = OIIO::Filesystem::extension(name);
    // Without an extension of its base what looks like one is the numbers.
    for (const std::string& extension : {tail, std::string()}) {
        const std::string stem = name.substr(0, name.size() - extension.size());
        const size_t dot = stem.rfind('.');
        if (dot == std::string::npos || dot < 2 || stem[0] != '.')
            continue;
        const std::string base = stem.substr(1, dot - 1), numbers = stem.substr(dot + 1);
        const size_t first = numbers.find('-'), second = numbers.rfind('-');
        if (first == std::string::npos || first == second ||
            OIIO::Filesystem::extension(base) != extension)
            continue;
        const std::string machine = numbers.substr(second + 1);
        if (all_of(numbers.substr(0, first), "0123456789") &&
            all_of(numbers.substr(first + 1, second - first - 1), "0123456789") &&
            machine.size() == 8 && all_of(machine, "0123456789abcdef"))
            return {base, machine};
    }
    return {};
}

} // namespace tonetool
