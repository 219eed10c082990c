// SPDX-License-Identifier: BSD-3-Clause
// The light of each pixel by its index: from a layer, or from the light groups.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <map>
#include <optional>
#include <string>

#include "imagebuf/lights/light_scan.h"
#include "imagebuf/lights/light_table.h"
#include "tonetool/lights.h"

namespace tonetool {

struct IndexLayer {
    std::string layer;
    int channel = -1;
};

/// The layer of that name, or one that is called as such layers are ("": not finding one is no
/// error).
std::optional<IndexLayer> find_index_layer(const OIIO::ImageSpec& spec, const std::string& name,
                                           const std::string& beauty);

struct IndexCounts {
    std::map<int, int64_t> pixels; ///< by index, 0 or more
    int64_t negative = 0;          ///< no light
    int64_t invalid = 0;           ///< NaN, infinite, or beyond any index
    int64_t between = 0;           ///< off a whole number by more than 0.01, as filters make them
};

IndexCounts count_indices(const OIIO::ImageBuf& image, const IndexLayer& layer);

/// The lights of a table as a list of groups has them: by name, or where the table has no name of
/// any of them, by their place. Null where there is none.
std::vector<const Light*> lights_of(const LightTable& table,
                                    const std::vector<ScannedGroup>& groups);

/// Opens the groups that the options ask for, ranked as they say; none is no error.
LightScan open_scan(const OIIO::ImageBuf& image, const PixelOptions& beauty,
                    const LightOptions& options, const LightTable* table, OIIO::ROI region,
                    int nthreads);

} // namespace tonetool
