// SPDX-License-Identifier: BSD-3-Clause
// The public functions of include/tonetool/against.h.
#include "tonetool/against.h"

#include <algorithm>

#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/names.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/qc/against_scan.h"
#include "imagebuf/qc/qc_header.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;
using Images = std::vector<const ImageBuf*>;

AgainstFile file_of(const AgainstScan& scan, size_t side, const Images& parts) {
    AgainstFile file;
    for (const ImageBuf* part : parts)
        file.parts.push_back(part_facts(*part));
    file.channels = channel_facts(scan.side(side).reader.spec(), parts);
    file.layers = scan.names(side);
    file.moment = scan.side(side).moment();
    return file;
}

void compare(AgainstFacts& facts, const Images& approved, const Images& parts,
             const AgainstOptions& options, int nthreads) {
    if (approved.empty() || parts.empty())
        throw Refusal("there is no image");
    for (const auto& [layer, kind] : options.kinds) {
        const std::vector<std::string> valid = ToneAlgo::against_kinds();
        if (std::find(valid.begin(), valid.end(), kind) == valid.end())
            throw Refusal("layer " + layer + ": " + unknown_name("kind", kind, valid));
    }
    for (const ImageBuf* part : approved)
        check_readable(*part, "approved");
    for (const ImageBuf* part : parts)
        check_readable(*part, "source");
    AgainstScan scan(options);
    scan.open(approved, parts, nthreads);
    scan.run();
    facts = {};
    facts.approved = file_of(scan, 0, approved);
    facts.file = file_of(scan, 1, parts);
    facts.layers = scan.results();
    facts.unused = scan.unused();
}

} // namespace

namespace ToneAlgo {

std::vector<std::string> against_kinds() {
    return {"position", "normal", "depth", "vector", "id", "albedo", "color", "group", "data"};
}

bool against_facts(AgainstFacts& facts, const Images& approved, const Images& parts,
                   std::string& error, const AgainstOptions& options, int nthreads) {
    return contained(error, [&] { compare(facts, approved, parts, options, nthreads); });
}

} // namespace ToneAlgo
} // namespace tonetool
