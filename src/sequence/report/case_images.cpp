// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/case_images.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "imagebuf/pixels/utf8.h"
#include "sequence/results/results_json.h"
#include "text/text.h"
#include "tonetool/write.h"

namespace tonetool::sequence {

namespace {

namespace fs = std::filesystem;
using OIIO::Strutil::fmt::format;

constexpr char kMark[] = "tonetool:measurement";

// A byte that has a meaning in names of these images or in what lists them is written as %40. So no
// part begins with a dot, which also keeps it in the folder.
std::string escaped_part(const std::string& text) {
    constexpr size_t most = 180; // of 255, with room for endings and a temporary name
    const bool utf8 = valid_utf8(text) == text;
    std::string safe;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        const bool plain = byte >= 0x20 && byte != 0x7f && (byte < 0x80 || utf8) &&
                           std::string("%@[]\\/").find(c) == std::string::npos &&
                           !(c == '.' && safe.empty());
        safe += plain ? std::string(1, c) : format("%{:02x}", byte);
    }
    if (safe.size() <= most)
        return safe;
    size_t end = most;
    while (end > 0 && (static_cast<unsigned char>(safe[end]) & 0xC0) == 0x80)
        --end;
    return safe.substr(0, end) + format("@{:016x}", OIIO::Strutil::strhash(text));
}

std::string escaped_name(const std::string& name) {
    Strings parts;
    for (const std::string& part : split(name, '/'))
        parts.push_back(escaped_part(part));
    return join(parts, "/");
}

// The frame's number as it stands in a file's name; empty: it does not.
std::string number_in(const std::string& file, int frame) {
    const std::string name = fs::path(file).filename().string();
    const auto digit = [&](size_t i) {
        return i < name.size() && std::isdigit(static_cast<unsigned char>(name[i])) != 0;
    };
    std::string found;
    for (size_t i = 0, end = 0; i < name.size(); i = end + 1) {
        for (end = i; digit(end);)
            ++end;
        const std::string digits = name.substr(i, end - i);
        const size_t zeros = std::min(digits.find_first_not_of('0'), digits.size());
        const std::string value = zeros == digits.size() ? "0" : digits.substr(zeros);
        if (!digits.empty() && value == std::to_string(std::abs(frame)))
            found = (frame < 0 ? "-" : "") + digits;
    }
    return found;
}

std::string frame_digits(const FrameResult& frame) {
    for (const std::string& file : {frame.test, frame.reference})
        if (std::string found = number_in(file, frame.frame); !found.empty())
            return found;
    return format("{:04}", frame.frame);
}

std::string base_of(const FrameResult& frame, bool still) {
    const Item item = frame.item();
    if (still && !item.named() && item.view.empty()) {
        const std::string& file = frame.test.empty() ? frame.reference : frame.test;
        const std::string stem = escaped_part(fs::path(file).stem().string());
        return stem.empty() ? "image" : stem;
    }
    std::string base = item.named() ? escaped_name(item.name) : frame_digits(frame);
    if (!item.method.empty())
        base += "@" + escaped_part(item.method);
    if (item.named() && item.frame != 0)
        base += "@" + frame_digits(frame);
    return base + (item.view.empty() ? "" : "@" + escaped_part(item.view));
}

// Limits may be others when parts are joined or a run goes on; the images are the same.
std::string mark_of(const FrameResult& frame) {
    FrameResult measured;
    measured.reference = frame.reference;
    measured.test = frame.test;
    measured.measurements = frame.measurements;
    for (Measurement& one : measured.measurements) {
        one.status = Status::Measured;
        one.thresholds.clear();
    }
    return format("1-{:016x}", OIIO::Strutil::strhash(to_json(measured)));
}

// Of a file of ours; empty: it is another's, or not there.
std::string mark_in(const std::string& file) {
    std::error_code none;
    if (!fs::is_regular_file(file, none))
        return "";
    const auto input = OIIO::ImageInput::open(file);
    if (!input)
        (void)OIIO::geterror();
    return input ? input->spec().get_string_attribute(kMark) : "";
}

void make_folder_of(const std::string& file) {
    const fs::path folder = fs::path(file).parent_path();
    std::error_code why;
    if (!folder.empty() && !fs::is_directory(folder, why) && !fs::create_directories(folder, why) &&
        !fs::is_directory(folder))
        throw std::runtime_error(
            format("could not make the folder \"{}\": {}", folder.string(), why.message()));
}

void write_picture(const OIIO::ImageBuf& picture, const std::string& mark,
                   const std::string& file) {
    OIIO::ImageBuf marked(picture);
    marked.specmod().attribute("oiio:ColorSpace", "sRGB");
    marked.specmod().attribute(kMark, mark);
    std::string why;
    if (!write_image(marked, file, why))
        throw std::runtime_error(why);
}

const OIIO::ImageBuf& one_of(const CasePictures& pictures, std::string_view kind) {
    return kind == "reference" ? pictures.reference
           : kind == "test"    ? pictures.test
                               : pictures.error;
}

} // namespace

CaseImages::CaseImages(std::string folder, bool still)
    : m_folder(std::move(folder)),
      m_still(still) {}

CaseFiles::Of CaseImages::files(const FrameResult& frame) const {
    const std::string slash = m_folder.empty() || m_folder.back() == '/' ? "" : "/";
    const std::string base = m_folder + slash + base_of(frame, m_still);
    CaseFiles::Of files;
    for (const auto& [kind, member] : CaseFiles::kAll)
        files.*member = base + "." + kind + ".png";
    return files;
}

void CaseImages::write(const FrameResult& frame, const CasePictures& pictures) const {
    const CaseFiles::Of places = files(frame);
    const std::string mark = mark_of(frame);
    make_folder_of(places.test);
    for (const auto& [kind, member] : CaseFiles::kAll)
        if (const OIIO::ImageBuf& picture = one_of(pictures, kind); picture.initialized())
            write_picture(picture, mark, places.*member);
}

bool CaseImages::has(const FrameResult& frame) const {
    return mark_in(files(frame).test) == mark_of(frame);
}

CaseFiles CaseImages::settle(const ShotResult& shot) const {
    CaseFiles kept;
    for (const FrameResult& frame : shot.frames) {
        const std::string mark = mark_of(frame);
        CaseFiles::Of there = files(frame);
        for (const auto& [kind, member] : CaseFiles::kAll) {
            std::string& file = there.*member;
            const std::string found = mark_in(file);
            if (wants(frame.status) && found == mark)
                continue;
            std::error_code why;
            if (!found.empty() && !fs::remove(file, why) && why)
                throw std::runtime_error(format("--images: could not remove \"{}\", which shows "
                                                "an earlier run: {}",
                                                file, why.message()));
            file.clear();
        }
        if (there.any())
            kept.of.emplace(frame.item(), there);
    }
    return kept;
}

size_t lacking_images(const ShotResult& shot, const CaseFiles& files) {
    return size_t(std::count_if(shot.frames.begin(), shot.frames.end(), [&](const auto& frame) {
        const bool drawn =
            std::any_of(frame.measurements.begin(), frame.measurements.end(),
                        [](const Measurement& one) { return !one.histogram.empty(); });
        return drawn && CaseImages::wants(frame.status) && !files.find(frame.item()).any();
    }));
}

} // namespace tonetool::sequence
