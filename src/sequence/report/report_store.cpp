// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_store.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
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

constexpr char kFullSize[] = "full", kSmallSize[] = "small";

// The name of a view comes from the user: a / in it is written as %2f, so that it cannot lead out
// of the folder.
std::string key_of(int frame, const std::string& view) {
    std::string key = format("{:04}", frame);
    if (!view.empty())
        key += ".";
    for (const char c : view) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = std::isalnum(byte) != 0 || c == '_' || c == '-';
        key += plain ? std::string(1, c) : format("%{:02x}", byte);
    }
    return key;
}

std::string key_of(const FrameResult& frame) {
    return key_of(frame.frame, frame.view);
}

// The text of a frame's images begins with the frame's measurements, so that images of other files,
// or of the same files before they changed, are not taken for this frame's.
std::string beginning(const FrameResult& frame) {
    FrameResult measured;
    measured.reference = frame.reference;
    measured.test = frame.test;
    measured.measurements = frame.measurements;
    return format("{{\"of\":\"{:016x}\",", OIIO::Strutil::strhash(to_json(measured)));
}

} // namespace

PictureStore::PictureStore(std::string folder, size_t full_frames)
    : m_folder(std::move(folder)),
      m_full_frames(full_frames) {
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
}

PictureStore::Rank PictureStore::rank_of(const FrameResult& frame) {
    return {-int(frame.status), -badness(frame), frame.frame, frame.view};
}

bool PictureStore::wants_full(const FrameResult& frame) const {
    const std::lock_guard<std::mutex> lock(m_mutex);
    return m_known.size() < m_full_frames || rank_of(frame) < *m_known.rbegin();
}

void PictureStore::know(const FrameResult& frame) {
    m_known.insert(rank_of(frame));
    if (m_known.size() > m_full_frames)
        m_known.erase(std::prev(m_known.end()));
}

bool PictureStore::insert(const FrameResult& frame) {
    const Rank rank = rank_of(frame);
    know(frame);
    m_worst.insert(rank);
    if (m_worst.size() > m_full_frames) {
        const Rank best = *m_worst.rbegin();
        m_worst.erase(best);
        drop(key_of(std::get<2>(best), std::get<3>(best)), kFullSize);
        return best != rank;
    }
    return true;
}

void PictureStore::drop(const std::string& key, const char* size) {
    if (m_folder.empty())
        m_texts.erase(key + size);
    else
        OIIO::Filesystem::remove(file(key, size));
}

PictureTexts PictureStore::texts(const FrameResult& frame, const FramePictures& pictures) {
    const std::string start = beginning(frame);
    PictureTexts texts;
    texts.small = start + small_json(pictures).substr(1);
    if (!pictures.exposures.empty()) {
        texts.full = start + full_json(pictures).substr(1);
        const std::lock_guard<std::mutex> lock(m_mutex);
        know(frame);
    }
    return texts;
}

void PictureStore::add(const FrameResult& frame, const PictureTexts& pictures) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    const std::string key = key_of(frame);
    if (!pictures.full.empty() && insert(frame))
        write(key, kFullSize, pictures.full);
    else
        drop(key, kFullSize);
    write(key, kSmallSize, pictures.small);
}

void PictureStore::forget(const FrameResult& frame) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    drop(key_of(frame), kFullSize);
    drop(key_of(frame), kSmallSize);
}

std::vector<std::string> PictureStore::files(int frame, const std::string& view) const {
    if (m_folder.empty())
        return {};
    const std::string key = key_of(frame, view);
    return {file(key, kFullSize), file(key, kSmallSize)};
}

bool PictureStore::restore(const FrameResult& frame) {
    const std::lock_guard<std::mutex> lock(m_mutex);
    if (m_folder.empty() || read(frame, kSmallSize).empty())
        return false;
    if (!read(frame, kFullSize).empty())
        insert(frame);
    return true;
}

std::string PictureStore::small(const FrameResult& frame) const {
    return read(frame, kSmallSize);
}

std::string PictureStore::full(const FrameResult& frame) const {
    return read(frame, kFullSize);
}

std::string PictureStore::file(const std::string& key, const char* size) const {
    return m_folder + "/" + key + "." + size + ".json";
}

void PictureStore::write(const std::string& key, const char* size, const std::string& text) {
    std::string why;
    if (m_folder.empty())
        m_texts[key + size] = text;
    else if (!write_bytes(text, file(key, size), why, Links::Refuse))
        throw std::runtime_error(why);
}

std::string PictureStore::read(const FrameResult& frame, const char* size) const {
    const std::string key = key_of(frame);
    std::string text;
    if (m_folder.empty()) {
        const auto found = m_texts.find(key + size);
        text = found == m_texts.end() ? "" : found->second;
    } else if (const std::string name = file(key, size);
               std::filesystem::is_regular_file(std::filesystem::symlink_status(name))) {
        OIIO::Filesystem::read_text_file(name, text);
    }
    return text.rfind(beginning(frame), 0) == 0 ? text : "";
}

void FramePainter::take(FramePictures pictures, const PictureRequest& request) {
    const bool wanted = wants(request);
    if (!drawn || wanted) {
        std::swap(pictures, drawn ? *drawn : drawn.emplace());
        pair = request.reference && !request.bias; // a later command may have an error map
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
