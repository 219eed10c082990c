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

// Visits the lists of whole numbers: how many they are, from which on, and in how many bytes each.
template <class Facts, class Visit>
void visit_lists(Facts& facts, const Visit& visit) {
    constexpr int least_of_16 = -32768, least_of_8 = -128;
    auto& picture = facts.picture;
    visit(picture.thumbnail, kPackedCells, least_of_16, size_t(2));
    visit(picture.red, kPackedCells, least_of_8, size_t(1));
    visit(picture.blue, kPackedCells, least_of_8, size_t(1));
    visit(picture.peaks, kPackedPeaks, int(QcPicture::kPeakDark), size_t(1));
    visit(picture.fingerprints, kPackedPeaks, 0, size_t(2));
    for (auto& guide : facts.guides)
        visit(guide.cells, kPackedCells * size_t(guide.channels), least_of_16, size_t(2));
    if (!facts.picture.objects.layer.empty())
        visit(facts.picture.objects.known, QcObjects::kBits / 8, 0, size_t(1));
}

template <class List>
void put_list(Bytes& bytes, const List& list, int least, size_t size) {
    for (const int value : list) {
        const auto code = unsigned(value - least);
        bytes.push_back(static_cast<unsigned char>(code & 0xff));
        if (size == 2)
            bytes.push_back(static_cast<unsigned char>(code >> 8 & 0xff));
    }
}

template <class List>
void read_list(const Bytes& bytes, size_t& at, List& list, size_t count, int least, size_t size) {
    list.resize(count);
    for (auto& value : list) {
        const int high = size == 2 ? bytes[at + 1] : 0;
        value = static_cast<typename List::value_type>(least + bytes[at] + 256 * high);
        at += size;
    }
}

} // namespace

std::string cells_text(const QcFacts& facts) {
    Bytes raw;
    visit_lists(facts, [&](const auto& list, size_t, int least, size_t size) {
        put_list(raw, list, least, size);
    });
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
    size_t all = 0;
    visit_lists(facts, [&](const auto&, size_t count, int, size_t size) { all += count * size; });
    const Bytes packed = bytes_of_base64(text);
    Bytes raw(all);
    const std::unique_ptr<libdeflate_decompressor, decltype(&libdeflate_free_decompressor)>
        decompressor(libdeflate_alloc_decompressor(), libdeflate_free_decompressor);
    if (!decompressor)
        throw std::bad_alloc();
    if (libdeflate_zlib_decompress(decompressor.get(), packed.data(), packed.size(), raw.data(),
                                   raw.size(), nullptr) != LIBDEFLATE_SUCCESS)
        throw std::runtime_error("\"cells\" is damaged");
    size_t at = 0;
    visit_lists(facts, [&](auto& list, size_t count, int least, size_t size) {
        read_list(raw, at, list, count, least, size);
    });
}

} // namespace tonetool::sequence
