// SPDX-License-Identifier: BSD-3-Clause
// A file compared with its approved version, layer by layer: light by its blocks, so that noise
// does not matter, data by their values.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <array>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tonetool/export.h"
#include "tonetool/pixels.h"
#include "tonetool/qc.h"

namespace tonetool {

struct AgainstOptions {
    PixelOptions pixels; ///< the beauty among the layers, and its space
    /// What layers hold, by name with * and ?, where their names do not tell: one of
    /// against_kinds().
    std::vector<std::pair<std::string, std::string>> kinds;
    std::vector<std::string> skip; ///< layers that are not compared, by name with * and ?
};

/// A layer of one of the files.
struct AgainstName {
    std::string name;                  ///< "" for plain R,G,B
    std::string kind;                  ///< one of against_kinds()
    int part = 0;                      ///< of the file
    std::vector<std::string> channels; ///< as in the file
    int other = -1;                    ///< the layer of the other file that is the same one, or -1
};

/// A file by its header.
struct AgainstFile {
    std::vector<QcPart> parts;
    std::vector<std::pair<std::string, std::string>> channels; ///< name and type
    std::vector<AgainstName> layers;                           ///< but those of `skip`
    std::string moment; ///< a hash of its depths and positions; "" without such layers
};

/// What was measured of a layer that both have.
struct AgainstLayer {
    std::string name, kind; ///< of the new file
    /// By kind: depth, position: off; normal: median, off10, one, lost; vector: median, off, lost;
    /// id: mismatch, and others where it covers 16 pixels; albedo, color, group: gain, blocks,
    /// one_finite, and none_finite (1) if no pixel is finite in both; any with an alpha:
    /// alpha_mean, alpha_off; data: off; any: emptied (1) if the new one is 0 everywhere, and a
    /// thousandth of the approved one's pixels, at least 16, not.
    std::map<std::string, double> quantities;
    int x = 0, y = 0; ///< where they differ most
    /// The first pixel that is finite in only one, where there is one.
    int one_finite_x = 0, one_finite_y = 0;
};

struct AgainstFacts {
    AgainstFile approved, file;
    std::vector<std::string> unused; ///< patterns of `kinds` and `skip` that fit no layer
    std::vector<AgainstLayer> layers;
};

namespace ToneAlgo {

/// "position", "normal", "depth", "vector", "id", "albedo", "color", "group", "data".
TONETOOL_API std::vector<std::string> against_kinds();

/// Compares all subimages of two files. Layers are matched by their names, and without the names
/// of view layers where those differ. Where the data windows differ, what both have is compared.
///
/// - off: share of pixels that differ by more than 0.1 % of their depth (positions without a depth
///   layer: of their largest component), or where only one has background (a depth from 1e9 on, or
///   not finite); of data by their bits.
/// - median of normals in degrees, of vectors in pixels; off10: share of normals more than 10
///   degrees apart; one: share of pixels where only one has a normal longer than 0.5; off of
///   vectors: share more than half a pixel apart. lost: share that is NaN or infinite in the new
///   file, and was not.
/// - mismatch: mean over pixels of half the differences of the coverages of all ids, which are
///   compared by their bits. others: the same, as a part of what the layer covers: a rank of the
///   edges alone covers little.
/// - gain: stops by which the light of the new file is brighter (negative: darker), the smaller of
///   the median over lit blocks of 16 x 16 pixels and of the sum, 0 where these do not agree.
///   blocks: share of the blocks that differ by more than six standard errors of their noise and
///   5 %. Colours are compared in linear Rec.709. Pixels that are not finite in one file count in
///   neither.
///
/// Depths may have any number of channels, of which the first says where there is nothing; normals
/// are the first three.
///
/// Returns false with the reason in `error` where an image is deep or unreadable, the beauty cannot
/// be told, a kind has no such name, or a layer has too few channels for the one that it is given.
TONETOOL_API bool against_facts(AgainstFacts& facts,
                                const std::vector<const OIIO::ImageBuf*>& approved,
                                const std::vector<const OIIO::ImageBuf*>& parts, std::string& error,
                                const AgainstOptions& options = {}, int nthreads = 0);

} // namespace ToneAlgo
} // namespace tonetool
