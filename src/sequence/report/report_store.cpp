// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_store.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "sequence/results/results_json.h"
#include "tonetool/write.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

constexpr std::array<const char*, kPictureSizes> kNames{"full", "large", "exact", "small"};
constexpr PictureSize kOfWorst[]{PictureSize::Full, PictureSize::Large, PictureSize::Exact};

// The name of a view comes from the user: a / in it is written as %2f, so that it cannot lead out
// of the folder.
std::string safe_in_folder(const std::string& text) {
    std::string safe;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = std::isalnum(byte) != 0 || c == '_' || c == '-';
        safe += plain ? std::string(1, c) : format("%{:02x}", byte);
    }
    return safe;
}

// Of a case: "@" is in no frame's key. A long name is cut, and told apart by a number.
std::string case_key(const Item& item) {
    constexpr size_t most = 180;
    const std::string whole = safe_in_folder(item.name) + "@" + safe_in_folder(item.method) + "@";
    return !item.named() ? ""
           : whole.size() <= most
               ? whole
               : whole.substr(0, most) + format("@{:016x}@", OIIO::Strutil::strhash(whole));
}

std::string key_of(const Item& item) {
    return case_key(item) + format("{:04}", item.frame) + (item.view.empty() ? "" : ".") +
           safe_in_folder(item.view);
}

std::string key_of(const FrameResult& frame) {
    return key_of(frame.item());
}

// The text of a frame's images begins with the frame's measurements, so that images of other files,
// or of the same files before they changed, are not taken for this frame's.
std::string beginning(const FrameResult& frame) {
    FrameResult measured;
    measured.reference = frame.reference;
    measured.test = frame.test;
    measured.measurements = frame.measurements;
    return format("{{\"form\":2,\"of\":\"{:016x}\",", OIIO::Strutil::strhash(to_json(measured)));
}

} // namespace

PictureStore::PictureStore(std::string folder, const PictureCounts& counts)
    : m_folder(std::move(folder)),
      m_counts(counts) {
    std::error_code none;
    if (std::filesystem::is_symlink(std::filesystem::symlink_status(m_folder, none))) {
        throw std::runtime_error(format("\"{}\" is a symbolic link, which is not followed here "
                                        "(valid: a folder, or a link that ends with a /)",
                                        m_folder));
    }
    std::string why;
    if (!m_folder.empty() && !OIIO::Filesystem::is_directory(m_folder) &&
        !OIIO::Filesystem::create_directory(m_folder, why))
        throw std::runtime_error(format("could not make the folder \"{}\": {}", m_folder, why));
    look_for_former_form();
}

// Version 0.1.0 kept pictures that were tone-mapped at a few exposures, which the page no longer
// shows. Their files begin with "of".
void PictureStore::look_for_former_form() {
    std::error_code none;
    if (m_folder.empty())
        return;
    for (const auto& entry : std::filesystem::directory_iterator(m_folder, none)) {
        const std::string name = entry.path().string();
        if (!OIIO::Strutil::ends_with(name, ".small.json") || !entry.is_regular_file(none) ||
            entry.is_symlink(none))
            continue;
        std::array<char, 6> first{};
        (void)OIIO::Filesystem::read_bytes(name, first.data(), first.size());
        if (std::string(first.data(), first.size()) == "{\"of\":")
            m_complaint = format("pictures in \"{}\" are in the form of an earlier version, which "
                                 "cannot be shown: they are drawn anew where frames are checked, "
                                 "and left out of a merge",
                                 m_folder);
        return;
    }
}

PictureStore::Rank PictureStore::rank_of(const FrameResult& frame) {
    return {-int(frame.status), -badness(frame), frame.item()};
}

bool PictureStore::wants(PictureSize size, const FrameResult& frame) const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const std::set<Rank>& known = m_known[size_t(size)];
    return known.size() < m_counts.of(size) || rank_of(frame) < *known.rbegin();
}

void PictureStore::know(PictureSize size, const FrameResult& frame) {
    std::set<Rank>& known = m_known[size_t(size)];
    known.insert(rank_of(frame));
    if (known.size() > m_counts.of(size))
        known.erase(std::prev(known.end()));
}

bool PictureStore::insert(PictureSize size, const FrameResult& frame) {
    const Rank rank = rank_of(frame);
    know(size, frame);
    std::set<Rank>& worst = m_worst[size_t(size)];
    worst.insert(rank);
    if (worst.size() > m_counts.of(size)) {
        const Rank best = *worst.rbegin();
        worst.erase(best);
        drop(key_of(std::get<2>(best)), size);
        return best != rank;
    }
    return true;
}

void PictureStore::drop(const std::string& key, PictureSize size) {
    if (m_folder.empty())
        m_texts.erase(key + kNames[size_t(size)]);
    else
        OIIO::Filesystem::remove(file(key, size));
}

std::string PictureStore::asked() const {
    return format("\"asked\":{},", m_counts.exact);
}

PictureTexts PictureStore::texts(const FrameResult& frame, const FramePictures& pictures) {
    const std::string start = beginning(frame);
    const PictureTexts drawn{full_json(pictures), large_json(pictures), exact_json(pictures),
                             small_json(pictures)};
    PictureTexts texts;
    for (size_t i = 0; i < kPictureSizes; ++i)
        if (!drawn[i].empty())
            (texts[i] = start + asked()).append(drawn[i], 1);
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (const PictureSize size : kOfWorst)
        if (!texts[size_t(size)].empty())
            know(size, frame);
    return texts;
}

void PictureStore::add(const FrameResult& frame, const PictureTexts& pictures) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const std::string key = key_of(frame);
    for (const PictureSize size : kOfWorst) {
        const std::string& text = pictures[size_t(size)];
        if (!text.empty() && insert(size, frame))
            write(key, size, text);
        else
            drop(key, size);
    }
    write(key, PictureSize::Small, pictures[size_t(PictureSize::Small)]);
}

void PictureStore::forget(const FrameResult& frame) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    for (size_t i = 0; i < kPictureSizes; ++i)
        drop(key_of(frame), PictureSize(i));
}

std::vector<std::string> PictureStore::files(const Item& item) const {
    std::vector<std::string> names;
    for (size_t i = 0; i < kPictureSizes && !m_folder.empty(); ++i)
        names.push_back(file(key_of(item), PictureSize(i)));
    return names;
}

bool PictureStore::restore(const FrameResult& frame) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_folder.empty() ||
        !OIIO::Strutil::starts_with(text(PictureSize::Small, frame), beginning(frame) + asked()))
        return false;
    for (const PictureSize size : kOfWorst)
        if (!text(size, frame).empty())
            insert(size, frame);
    return true;
}

std::string PictureStore::file(const std::string& key, PictureSize size) const {
    return m_folder + "/" + key + "." + kNames[size_t(size)] + ".json";
}

void PictureStore::write(const std::string& key, PictureSize size, const std::string& text) {
    std::string why;
    if (m_folder.empty())
        m_texts[key + kNames[size_t(size)]] = text;
    else if (!write_bytes(text, file(key, size), why, Links::Refuse))
        throw std::runtime_error(why);
}

std::string PictureStore::text(PictureSize size, const FrameResult& frame) const {
    const std::string key = key_of(frame);
    std::string text;
    if (m_folder.empty()) {
        const auto found = m_texts.find(key + kNames[size_t(size)]);
        text = found == m_texts.end() ? "" : found->second;
    } else if (const std::string name = file(key, size);
               std::filesystem::is_regular_file(std::filesystem::symlink_status(name))) {
        OIIO::Filesystem::read_text_file(name, text);
    }
    return text.rfind(beginning(frame), 0) == 0 ? text : "";
}

void PictureStore::keep_figure(const Item& item, std::string text) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    m_figures[item] = std::move(text);
}

std::string PictureStore::figure(const Item& item) const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const auto found = m_figures.find(item);
    return found == m_figures.end() ? "" : found->second;
}

void FramePainter::take(FramePictures pictures, const PictureRequest& request) {
    const bool wanted = wants(request);
    if (!drawn || wanted) {
        std::swap(pictures, drawn ? *drawn : drawn.emplace());
        pair = request.reference && request.compared && !request.bias;
    }
    if (drawn->bias.empty()) {
        drawn->bias = std::move(pictures.bias);
        drawn->bias_range = pictures.bias_range;
    }
    // Each pixel appears once, as it was drawn first.
    for (SpotPictures& spot : pictures.spots) {
        const bool there = std::any_of(drawn->spots.begin(), drawn->spots.end(),
                                       [&](const auto& other) { return other.at == spot.at; });
        if (!there)
            drawn->spots.push_back(std::move(spot));
    }
}

} // namespace tonetool::sequence
