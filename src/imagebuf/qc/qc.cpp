// SPDX-License-Identifier: BSD-3-Clause
// The public function of include/tonetool/qc.h.
#include "tonetool/qc.h"

#include <OpenImageIO/strutil.h>
#include <cmath>

#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/planes.h"
#include "imagebuf/qc/qc_header.h"
#include "imagebuf/qc/qc_scan.h"
#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::ImageBuf;

QcCount count_of(const metrics::Hits& hits) {
    QcCount count;
    count.pixels = hits.pixels;
    for (const metrics::Hit& hit : hits.first)
        count.first.push_back(
            {int(hit.x), int(hit.y), std::isfinite(hit.value) ? hit.value : 0, 0});
    return count;
}

QcLayer layer_of(const QcScan::Layer& from) {
    const metrics::LayerScan& scan = from.scan;
    QcLayer layer;
    layer.name = from.name;
    layer.kind = from.kind;
    layer.constant = scan.constant();
    layer.lit = scan.lit;
    layer.min = scan.min();
    layer.max = scan.max();
    layer.mean = scan.finite > 0 ? scan.sum / double(scan.finite) : 0;
    layer.nan = count_of(scan.nan);
    layer.inf = count_of(scan.inf);
    layer.negative = count_of(scan.negative);
    return layer;
}

int thousandths_of_stops(double luminance) {
    if (!(luminance > 0))
        return QcPicture::kDark;
    return std::max(int(std::lround(1000 * std::log2(luminance))), QcPicture::kDark);
}

void fill_picture(const QcScan& scan, QcPicture& picture) {
    picture.layer = scan.choice().layer;
    picture.space = scan.choice().space;
    picture.hash = scan.hash();
    for (double mean : scan.cell_means())
        picture.thumbnail.push_back(thousandths_of_stops(mean));
    for (double peak : scan.cell_peaks())
        picture.peaks.push_back(thousandths_of_stops(peak));
    picture.alpha_low = count_of(scan.alpha().below);
    picture.alpha_high = count_of(scan.alpha().above);
    picture.lit = scan.lit();
    picture.unseen = count_of(scan.unseen());
    picture.spike_count = scan.spike_count();
    for (const metrics::Spike& spike : scan.spikes())
        picture.spikes.push_back({int(spike.x), int(spike.y), spike.value, spike.around});
    picture.groups = int(scan.groups().size());
    picture.group_sum = scan.group_scan().sum();
    picture.group_difference = scan.group_scan().difference();
    const metrics::Hit worst = scan.group_scan().worst();
    picture.group_worst = {int(worst.x), int(worst.y), worst.value, 0};
}

void measure(QcFacts& facts, const std::vector<const ImageBuf*>& parts, const QcOptions& options,
             int nthreads) {
    if (parts.empty())
        throw Refusal("there is no image");
    for (const ImageBuf* part : parts)
        check_readable(*part, "source");
    QcScan scan;
    scan.open(parts, options, nthreads);
    scan.run();
    facts = {};
    for (const ImageBuf* part : parts)
        facts.parts.push_back(part_facts(*part));
    facts.channels = channel_facts(scan.spec(), parts);
    for (const QcScan::Layer& layer : scan.layers())
        facts.layers.push_back(layer_of(layer));
    fill_picture(scan, facts.picture);
}

} // namespace

namespace ToneAlgo {

bool qc_facts(QcFacts& facts, const std::vector<const ImageBuf*>& parts, std::string& error,
              const QcOptions& options, int nthreads) {
    return contained(error, [&] { measure(facts, parts, options, nthreads); });
}

} // namespace ToneAlgo
} // namespace tonetool
