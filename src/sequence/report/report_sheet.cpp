// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/report/report_sheet.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>

#include "imagebuf/pixels/canvas.h"
#include "sequence/report/encoded.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using OIIO::ImageBuf;
using OIIO::ROI;
using OIIO::Strutil::fmt::format;

constexpr int kMargin = 10, kEdge = 4, kTextSize = 13, kLabel = 22;
constexpr SheetColor kEmpty{0.05f, 0.05f, 0.05f};

// Colours that are safe for colour-blind readers; the label has the word as well.
SheetColor color_of(Status status) {
    switch (status) {
    case Status::Passed:
    case Status::Measured:
    case Status::Skipped:
        return {0.35f, 0.37f, 0.40f};
    case Status::Warning:
        return {0.94f, 0.73f, 0.30f};
    case Status::Failed:
        return {1.00f, 0.45f, 0.15f};
    default:
        return {0.91f, 0.60f, 0.83f};
    }
}

std::vector<size_t> shown_frames(const ShotResult& shot, std::string& warning) {
    std::vector<size_t> all(shot.frames.size());
    for (size_t i = 0; i < all.size(); ++i)
        all[i] = i;
    if (all.size() > kMostSheetFrames) {
        std::stable_sort(all.begin(), all.end(), [&](size_t a, size_t b) {
            const FrameResult &one = shot.frames[a], &other = shot.frames[b];
            return std::make_pair(-int(one.status), -badness(one)) <
                   std::make_pair(-int(other.status), -badness(other));
        });
        warning = format("the contact sheet shows the {} worst of {} frames", kMostSheetFrames,
                         all.size());
        all.resize(kMostSheetFrames);
        std::sort(all.begin(), all.end());
    }
    return all;
}

std::optional<ImageBuf> thumbnail(const FrameResult& frame, const PictureStore& pictures) {
    const std::string text = pictures.text(PictureSize::Small, frame);
    const auto json = parsed_or_null(text);
    if (!json.is_object() || !json.contains("test") || !json["test"].is_string())
        return std::nullopt;
    return picture_of(json["test"].get<std::string>());
}

std::string label_of(const FrameResult& frame) {
    const std::string test = frame.test_frame ? "/" + std::to_string(*frame.test_frame) : "";
    return frame.item().named()
               ? item_name(frame.item())
               : std::to_string(frame.frame) + test + (frame.view.empty() ? "" : " " + frame.view);
}

class Sheet {
public:
    Sheet(size_t count, int height)
        : m_cell_height(height + kLabel + 2 * kEdge + kMargin),
          m_columns(std::max(1, int(std::ceil(std::sqrt(double(count)))))),
          m_canvas(m_columns * cell_width + kMargin,
                   (int(count) + m_columns - 1) / m_columns * m_cell_height + kMargin,
                   font_of_labels(), OIIO::TypeDesc::UINT8) {}

    void put(size_t place, const FrameResult& frame, const std::optional<ImageBuf>& picture,
             int height) {
        const int x = kMargin + int(place) % m_columns * cell_width;
        const int y = kMargin + int(place) / m_columns * m_cell_height;
        m_canvas.rectangle(x, y, kThumbnailSide + 2 * kEdge, height + 2 * kEdge,
                           color_of(frame.status));
        m_canvas.rectangle(x + kEdge, y + kEdge, kThumbnailSide, height, kEmpty);
        if (picture) {
            const ROI roi = picture->roi();
            m_canvas.paste(*picture, x + kEdge + (kThumbnailSide - roi.width()) / 2,
                           y + kEdge + (height - roi.height()) / 2);
        }
        m_canvas.write(x, y + height + 2 * kEdge + 4,
                       format("{}  {}", label_of(frame), status_name(frame.status)), kTextSize);
    }

    Canvas& canvas() { return m_canvas; }

private:
    static constexpr int cell_width = kThumbnailSide + 2 * kEdge + kMargin;

    int m_cell_height, m_columns;
    Canvas m_canvas;
};

} // namespace

ImageBuf contact_sheet(const ShotResult& shot, const PictureStore& pictures, std::string& warning) {
    const std::vector<size_t> frames = shown_frames(shot, warning);
    if (frames.empty())
        throw std::runtime_error("there is no frame for the contact sheet");
    std::vector<std::optional<ImageBuf>> thumbnails;
    int height = 1;
    for (const size_t i : frames) {
        thumbnails.push_back(thumbnail(shot.frames[i], pictures));
        height = thumbnails.back() ? std::max(height, thumbnails.back()->spec().height) : height;
    }
    height = height == 1 ? kThumbnailSide * 9 / 16 : height;
    Sheet sheet(frames.size(), height);
    for (size_t i = 0; i < frames.size(); ++i)
        sheet.put(i, shot.frames[frames[i]], thumbnails[i], height);
    if (!sheet.canvas().labelled()) {
        warning += warning.empty() ? "" : "; ";
        warning +=
            std::string("no font \"") + kLabelFont + "\" found: the contact sheet has no labels";
    }
    return std::move(sheet.canvas().image());
}

} // namespace tonetool::sequence
