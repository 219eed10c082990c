// SPDX-License-Identifier: BSD-3-Clause
// The public function of include/tonetool/qc.h.
#include "tonetool/qc.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <cstring>

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
    layer.hash = from.hash();
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

int16_t thousandths_of_stops(double luminance) {
    if (!(luminance > 0))
        return QcPicture::kDark;
    return int16_t(
        std::clamp(int(std::lround(1000 * std::log2(luminance))), QcPicture::kDark, 32767));
}

// In parts of a stop, within the range of a byte.
int16_t eighths_of_stops(double luminance) {
    if (!(luminance > 0))
        return QcPicture::kPeakDark;
    return int16_t(std::clamp(int(std::lround(8 * std::log2(luminance))), QcPicture::kPeakDark,
                              QcPicture::kPeakBright));
}

// A colour over green in 1/32 stop; where there is neither, they are equal.
int16_t tint_of(double color, double green) {
    constexpr double dark = 1e-9;
    const double stops = std::log2((std::max(color, 0.0) + dark) / (std::max(green, 0.0) + dark));
    return int16_t(std::clamp<long>(std::lround(32 * stops), -128, 127));
}

QcGuide guide_of(const QcScan& scan, const QcScan::Guide& from) {
    const QcScan::Layer& layer = scan.layers()[from.layer];
    QcGuide guide{layer.name, int(layer.channels.size()), {}};
    for (const double mean : from.means(layer.channels.size()))
        guide.cells.push_back(QcGuide::code(mean));
    return guide;
}

QcRectangle rectangle_of(const metrics::FlatRectangle& from) {
    constexpr double mostly = 0.9;
    QcRectangle to;
    to.x = int(from.run.x);
    to.y = int(from.y);
    to.width = int(from.run.width);
    to.height = int(from.height);
    std::memcpy(to.color.data(), from.run.color.data(), sizeof to.color);
    to.background = double(from.run.background) >= mostly * double(from.pixels());
    return to;
}

void fill_places(const QcScan& scan, QcPicture& picture) {
    for (const metrics::FlatRectangle& rectangle : scan.rectangles())
        picture.rectangles.push_back(rectangle_of(rectangle));
    picture.borders = {scan.borders()[0].shares(), scan.borders()[1].shares(),
                       scan.borders()[2].shares(), scan.borders()[3].shares()};
    picture.pairs = scan.values().shares();
    picture.greens = scan.values().greens;
    picture.distinct = int(scan.values().values.size());
    const QcScan::Alpha& alpha = scan.alpha_levels();
    picture.alpha_mean = alpha.finite > 0 ? alpha.sum / double(alpha.finite) : 0;
    picture.alpha_clear = alpha.pixels > 0 ? double(alpha.clear) / double(alpha.pixels) : 0;
}

void fill_statistics(const QcScan& scan, QcPicture& picture) {
    const metrics::DetailScan& detail = scan.detail();
    picture.fine = detail.fine();
    picture.coarse = detail.coarse();
    picture.across = detail.across();
    picture.down = detail.down();
    const metrics::ValueScan& values = scan.values();
    picture.at_one = values.at_one;
    picture.beside_one = values.beside_one;
    picture.at_largest_half = values.at_largest_half;
    picture.magenta = scan.magenta();
    picture.speed = scan.speed();
}

void fill_cells(const QcScan& scan, QcPicture& picture) {
    for (double mean : scan.cell_means())
        picture.thumbnail.push_back(thousandths_of_stops(mean));
    const std::vector<double>& colors = scan.cell_colors();
    for (size_t i = 0; i < colors.size(); i += 3) {
        picture.red.push_back(tint_of(colors[i], colors[i + 1]));
        picture.blue.push_back(tint_of(colors[i + 2], colors[i + 1]));
    }
    for (double peak : scan.cell_peaks())
        picture.peaks.push_back(eighths_of_stops(peak));
    picture.fingerprints = scan.fingerprints();
}

void fill_picture(const QcScan& scan, QcPicture& picture) {
    picture.layer = scan.choice().layer;
    picture.space = scan.choice().space;
    picture.hash = scan.hash();
    fill_cells(scan, picture);
    fill_statistics(scan, picture);
    picture.alpha_low = count_of(scan.alpha().below);
    picture.alpha_high = count_of(scan.alpha().above);
    picture.lit = scan.lit();
    picture.unseen = count_of(scan.unseen());
    picture.spike_count = scan.spike_count();
    for (const metrics::Spike& spike : scan.spikes())
        picture.spikes.push_back({int(spike.x), int(spike.y), spike.value, spike.around});
    fill_places(scan, picture);
    picture.groups = int(scan.groups().size());
    picture.group_sum = scan.group_scan().sum();
    picture.group_difference = scan.group_scan().difference();
    const metrics::Hit worst = scan.group_scan().worst();
    picture.group_worst = {int(worst.x), int(worst.y), worst.value, 0};
}

QcObjects objects_of(const QcScan& scan) {
    QcObjects objects;
    if (scan.object_layer() < 0)
        return objects;
    objects.layer = scan.layers()[size_t(scan.object_layer())].name;
    objects.known.resize(QcObjects::kBits / 8);
    const double least = QcObjects::kShare * double(scan.object_pixels());
    for (const auto& [id, object] : scan.objects().objects()) {
        for (const size_t bit : QcObjects::bits_of(id))
            objects.known[bit / 8] = uint8_t(objects.known[bit / 8] | 1U << bit % 8);
        if (!object.at_border && double(object.pixels) >= least)
            objects.inside.push_back({id, object.pixels});
    }
    std::stable_sort(objects.inside.begin(), objects.inside.end(),
                     [](const auto& a, const auto& b) { return a.pixels > b.pixels; });
    objects.inside.resize(std::min(objects.inside.size(), QcObjects::kMost));
    return objects;
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
    for (const QcScan::Guide& guide : scan.guides())
        facts.guides.push_back(guide_of(scan, guide));
    fill_picture(scan, facts.picture);
    facts.picture.objects = objects_of(scan);
}

} // namespace

namespace ToneAlgo {

bool qc_facts(QcFacts& facts, const std::vector<const ImageBuf*>& parts, std::string& error,
              const QcOptions& options, int nthreads) {
    return contained(error, [&] { measure(facts, parts, options, nthreads); });
}

} // namespace ToneAlgo
} // namespace tonetool
