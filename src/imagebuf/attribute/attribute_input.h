// SPDX-License-Identifier: BSD-3-Clause
// What attribute() reads of two files: the picture, light groups, coverages, other layers.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "imagebuf/attribute/cryptomatte.h"
#include "imagebuf/pixels/ignored_pixels.h"
#include "imagebuf/qc/layer_reader.h"
#include "metrics/coverage.h"
#include "tonetool/attribute.h"

namespace tonetool {

/// Interleaved values over the region, of reference and test.
using SidePixels = std::array<std::vector<float>, 2>;

class AttributeInput {
public:
    using Images = std::vector<const OIIO::ImageBuf*>;
    struct Group {
        std::string name;
        SidePixels light; ///< R, G, B in linear Rec.709; empty where the side lacks it
    };
    struct Type {
        std::string name;
        metrics::Coverage coverage[2];
        std::unordered_map<uint32_t, std::string> names;
    };
    struct Layer {
        std::string name, kind;
        size_t channels = 0;
        SidePixels values; ///< of colours in linear Rec.709
    };

    /// Without a region: what hdr_flip() compares.
    void open(const Images& reference, const Images& test, const AttributeOptions& options,
              const OIIO::ROI& region);
    void read(int nthreads);

    const OIIO::ROI& region() const { return m_region; }
    size_t pixels() const { return size_t(m_region.width()) * size_t(m_region.height()); }
    /// Bytes of all that read() keeps, but for coverages.
    uint64_t bytes() const;
    /// Pixels that do not count: no light of groups, no coverage, NaN in colours; the picture has
    /// them.
    const IgnoredPixels& ignored() const { return m_ignored; }
    bool counts(size_t pixel) const { return !m_ignored.any() || m_ignored.all()[pixel] == 0; }
    double counted() const { return double(m_ignored.counted(m_region)); }
    const SidePixels& picture() const { return m_picture; }
    const std::vector<Group>& groups() const { return m_groups; } ///< by name
    /// By name, but that of the objects first.
    const std::vector<Type>& types() const { return m_types; }
    const std::vector<Layer>& layers() const { return m_layers; }
    const std::vector<AttributedManifest>& manifest_only() const { return m_manifest_only; }
    const std::vector<std::string>& warnings() const { return m_warnings; }

private:
    // Channels of a part that go into one place.
    struct Wanted {
        size_t side = 0, part = 0;
        std::vector<int> channels;
        bool light = false;
        std::vector<float>* values = nullptr;
        metrics::Coverage* coverage = nullptr;
    };

    void find_region(const Images& reference, const Images& test, const AttributeOptions& options,
                     const OIIO::ROI& region);
    void want_picture();
    void want_groups();
    void want_types(const Images (&parts)[2]);
    void compare_manifests(const std::map<std::string, CryptomatteType>& reference,
                           const std::map<std::string, CryptomatteType>& test);
    void want_layers();
    void check_ids(size_t side, const Images& parts, const std::string& type,
                   const std::vector<int>& channels) const;
    bool is_cryptomatte(const std::string& layer) const;
    /// Channels of all parts together, which must lie in one part.
    Wanted wanted(size_t side, const std::vector<int>& channels) const;
    void read_rows(int begin, int end, int nthreads);
    void leave_out_ignored();

    LayerReader m_readers[2];
    OIIO::ROI m_region;
    IgnoredPixels m_ignored;
    SidePixels m_picture;
    std::vector<Group> m_groups;
    std::vector<Type> m_types;
    std::vector<Layer> m_layers;
    std::vector<AttributedManifest> m_manifest_only;
    std::vector<std::string> m_warnings;
    std::vector<Wanted> m_wanted;
};

} // namespace tonetool
