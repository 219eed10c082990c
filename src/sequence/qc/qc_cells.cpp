// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/qc/qc_cells.h"

#include <libdeflate.h>

#include <memory>
#include <stdexcept>
#include <vector>

#include "sequence/results/base64.h"

namespace tonetool::sequence {

namespace {

using Bytes = std::vector<unsigned char>;

constexpr size_t kPackedCells = size_t(QcPicture::kWide) * QcPicture::kHigh;
constexpr size_t kPackedPeaks = size_t(QcPicture::kPeaksWide) * QcPicture::kPeaksHigh;

// A list of whole numbers: how many, from which on, and in how many bytes each.
struct CellList {
    std::vector<int>* values;
    size_t count;
    int least;
    size_t bytes;
};

std::vector<CellList> lists_of(QcFacts& facts) {
    constexpr int least_of_16 = -32768, least_of_8 = -128;
    QcPicture& picture = facts.picture;
    std::vector<CellList> lists = {{&picture.thumbnail, kPackedCells, least_of_16, 2},
                                   {&picture.red, kPackedCells, least_of_8, 1},
                                   {&picture.blue, kPackedCells, least_of_8, 1},
                                   {&picture.peaks, kPackedPeaks, QcPicture::kPeakDark, 1},
                                   {&picture.fingerprints, kPackedPeaks, 0, 2}};
    for (QcGuide& guide : facts.guides)
        lists.push_back({&guide.cells, kPackedCells * size_t(guide.channels), least_of_16, 2});
    return lists;
}

void put_list(Bytes& bytes, const CellList& list) {
    for (const int value : *list.values) {
        const auto code = unsigned(value - list.least);
        bytes.push_back(static_cast<unsigned char>(code & 0xff));
        if (list.bytes == 2)
            bytes.push_back(static_cast<unsigned char>(code >> 8 & 0xff));
    }
}

void read_list(const Bytes& bytes, size_t& at, const CellList& list) {
    list.values->clear();
    for (size_t i = 0; i < list.count; ++i, at += list.bytes) {
        const int high = list.bytes == 2 ? bytes[at + 1] : 0;
        list.values->push_back(list.least + bytes[at] + 256 * high);
    }
}

} // namespace

std::string cells_text(const QcFacts& facts) {
    QcFacts copy = facts;
    Bytes raw;
    for (const CellList& list : lists_of(copy))
        put_list(raw, list);
    constexpr int level = 9;
    const std::unique_ptr<libdeflate_compressor, decltype(&libdeflate_free_compressor)> compressor(
        libdeflate_alloc_compressor(level), libdeflate_free_compressor);
    if (!compressor)
        throw std::bad_alloc();
    Bytes packed(libdeflate_zlib_compress_bound(compressor.get(), raw.size()));
    packed.resize(libdeflate_zlib_compress(compressor.get(), raw.data(), raw.size(), packed.data(),
                                           packed.size()));
    return base64(packed);
}

void read_cells(const std::string& text, QcFacts& facts) {
    const std::vector<CellList> lists = lists_of(facts);
    size_t size = 0;
    for (const CellList& list : lists)
        size += list.count * list.bytes;
    const Bytes packed = bytes_of_base64(text);
    Bytes raw(size);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!decompressor)
        throw std::bad_alloc();
    if (libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), raw.data(),
                                   raw.size(), nullptr) != LIBDEFLATE_SUCCESS)
        throw std::runtime_error("\"cells\" is damaged");
    size_t at = 0;
    for (const CellList& list : lists)
        read_list(raw, at, list);
}

} // namespace tonetool::sequence
