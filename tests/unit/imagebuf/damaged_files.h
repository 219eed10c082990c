// SPDX-License-Identifier: BSD-3-Clause
// Files that cannot be read whole, each in its own way.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "files.h"

namespace tonetool {

struct DamagedFile {
    std::string path;
    bool layers = false; ///< what is left of it says that it has light groups
    bool named = true;   ///< whether every error names it: what else is wrong is no read error
    bool large = false;  ///< OpenImageIO would ask for the memory
};

inline std::string bytes_of(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

inline std::string write_bytes_to(const std::string& path, const std::string& bytes) {
    std::ofstream(path, std::ios::binary).write(bytes.data(), std::streamsize(bytes.size()));
    return path;
}

template <class Number>
std::string packed(std::initializer_list<Number> numbers) {
    std::string bytes;
    for (Number number : numbers)
        bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
    return bytes;
}

/// The header of an EXR file of float R, G, B with this data window, its chunks `rows` high.
inline std::string exr_header(std::array<int32_t, 4> window, char compression) {
    const auto attribute = [](const std::string& name, const std::string& type,
                              const std::string& value) {
        return name + '\0' + type + '\0' + packed<uint32_t>({uint32_t(value.size())}) + value;
    };
    std::string channels;
    for (const char* name : {"B", "G", "R"})
        channels += name + std::string(1, '\0') + packed<int32_t>({2, 0, 1, 1});
    const std::string box = packed<int32_t>({window[0], window[1], window[2], window[3]});
    return packed<uint32_t>({20000630, 2}) + attribute("channels", "chlist", channels + '\0') +
           attribute("compression", "compression", std::string(1, compression)) +
           attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box) +
           attribute("lineOrder", "lineOrder", std::string(1, '\0')) +
           attribute("pixelAspectRatio", "float", packed<float>({1})) +
           attribute("screenWindowCenter", "v2f", packed<float>({0, 0})) +
           attribute("screenWindowWidth", "float", packed<float>({1})) + '\0';
}

/// Writes them into a folder. All but one-line headers are 64 x 32 pixels.
class DamagedFiles {
public:
    explicit DamagedFiles(const Folder& folder) : m_folder(folder) {
        cut_exr();
        cut_others();
        strange_exr();
        no_images();
    }

    const std::vector<DamagedFile>& all() const { return m_files; }
    /// What a whole one is.
    static ImageBuf whole() { return noise(make_spec(64, 32, {"R", "G", "B"}), 11, 0.2); }

private:
    static ImageBuf with_lights() {
        return noise(make_spec(64, 32,
                               {"R", "G", "B", "lg_key.R", "lg_key.G", "lg_key.B", "lg_sky.R",
                                "lg_sky.G", "lg_sky.B"}),
                     12, 0.2);
    }

    void add(const std::string& name, const std::string& bytes, bool layers = false) {
        m_files.push_back({write_bytes_to(m_folder / name, bytes), layers, true, false});
    }

    std::string written(const std::string& name, const ImageBuf& image, const FileLook& look) {
        return bytes_of(write_file(m_folder / ("whole_" + name), image, look));
    }

    void cut_exr() {
        const std::string plain = written("plain.exr", with_lights(), {OIIO::TypeFloat, "none", 0});
        for (double share : {0.3, 0.6, 0.95})
            add("plain" + std::to_string(share) + ".exr",
                plain.substr(0, size_t(double(plain.size()) * share)), true);
        add("last_byte.exr", plain.substr(0, plain.size() - 1), true);
        const std::string zip = written("zip.exr", with_lights(), {OIIO::TypeHalf, "zip", 0});
        add("zip.exr", zip.substr(0, zip.size() * 3 / 4), true);
        std::string broken = zip;
        for (size_t i = broken.size() / 2; i < broken.size() / 2 + 400; ++i)
            broken[i] = char(0x5a);
        add("broken_chunk.exr", broken, true);
        add("in_header.exr", zip.substr(0, 120));
        const std::string tiles = written("tiles.exr", with_lights(), {OIIO::TypeHalf, "zip", 16});
        const size_t offsets = tiles.find("type") + 64;
        add("tiles.exr", tiles.substr(0, tiles.size() * 2 / 3), true);
        add("tile_offsets.exr", tiles.substr(0, std::max(offsets, tiles.size() / 20)));
    }

    void cut_others() {
        for (const char* name : {"a.tif", "a.png", "a.jpg", "a.hdr"}) {
            const bool real = std::strcmp(name, "a.hdr") == 0;
            const std::string bytes =
                written(name, whole(), {real ? OIIO::TypeFloat : OIIO::TypeUInt8, "zip", 0});
            for (double share : {0.01, 0.5})
                add(std::to_string(share) + name,
                    bytes.substr(0, size_t(double(bytes.size()) * share)));
        }
        ImageBuf planar = whole();
        planar.specmod().attribute("planarconfig", "separate");
        const std::string strips = written("planar.tif", planar, {OIIO::TypeFloat, "zip", 0});
        // Its directory lies behind the pixels: a hole instead of an end.
        std::string hole = strips;
        for (size_t i = hole.size() / 2; i < hole.size() / 2 + 600; ++i)
            hole[i] = char(0x77);
        add("planar.tif", hole);
    }

    void strange_exr() {
        std::string chroma = written("chroma.exr", whole(), {OIIO::TypeFloat, "none", 0});
        size_t at = chroma.find("chlist") + 11;
        for (int channel = 0; channel < 3; ++channel) {
            const size_t numbers = chroma.find('\0', at) + 1;
            const int32_t step = channel == 1 ? 1 : 2;
            chroma.replace(numbers + 8, 8, packed<int32_t>({step, step}));
            at = numbers + 16;
        }
        add("chroma.exr", chroma);
        const std::string no_offsets(size_t(400) * 8, '\0');
        add("promises.exr", exr_header({0, 0, 599999, 4999}, 3) + no_offsets);
        m_files.back() = {m_files.back().path, false, false, true};
        add("high.exr", exr_header({0, 0, 63, 1 << 29}, 3) + no_offsets);
        m_files.back() = {m_files.back().path, false, false, true};
        add("absurd.exr", exr_header({-(1 << 30), -(1 << 30), 1 << 30, 1 << 30}, 3) + no_offsets);
        add("edge.exr", exr_header({INT32_MAX - 63, 0, INT32_MAX, 31}, 0) + no_offsets);
        add("backwards.exr", exr_header({64, 32, 0, 0}, 0) + no_offsets);
        std::string deep = bytes_of(TESTIMAGES_DIR "/deep.exr");
        add("deep.exr", deep.substr(0, deep.size() / 3));
        std::string latin = written("latin.exr", whole(), {OIIO::TypeFloat, "none", 0});
        latin.replace(latin.find(std::string("G\0", 2), latin.find("chlist")), 1, "\xfc");
        add("latin\xe9.exr", latin.substr(0, latin.size() / 2));
        m_files.back().named = false; // there is no G
        const std::string plain = written("umlaut.exr", whole(), {OIIO::TypeFloat, "none", 0});
        add("umlaut\xfc.exr", plain.substr(0, plain.size() / 2));
    }

    void no_images() {
        add("zero.exr", "");
        add("zero.png", "");
        add("text.exr", "This is no image.\n");
        add("three_bytes.tif", "II*");
        m_files.push_back({m_folder / "missing.exr", false, true, false});
    }

    const Folder& m_folder;
    std::vector<DamagedFile> m_files;
};

} // namespace tonetool
