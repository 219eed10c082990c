// SPDX-License-Identifier: BSD-3-Clause
// Keeps the images of a shot's frames while it is checked, until the report is written.
#pragma once

#include <algorithm>
#include <array>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "sequence/report/case_pictures.h"
#include "sequence/report/report_pictures.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// What there is of a frame, and what of all of them: `Small`.
enum class PictureSize { Full, Large, Exact, Small };
inline constexpr size_t kPictureSizes = 4;

/// The images of a frame as the page and the folder hold them, by size; empty where nothing of it
/// was drawn.
using PictureTexts = std::array<std::string, kPictureSizes>;

/// How many of the worst frames have what.
struct PictureCounts {
    size_t full = 24, large = 12;
    /// Of the worst frame every pixel of a reduced picture has its number; or, if this is not 0,
    /// every pixel of the file, of so many frames.
    size_t exact = 0;

    size_t of(PictureSize size) const {
        return size == PictureSize::Full    ? full
               : size == PictureSize::Large ? large
                                            : std::max<size_t>(exact, 1);
    }
};

/// Keeps the images of the worst frames and the thumbnails of all, so that memory and disk are
/// bounded; the choice does not depend on the order in which frames come. With a folder the images
/// are files there ("0005.full.json", "0005.small.json"), so that a continued run, or a merge of
/// the parts of several machines, finds them again. Safe to call from several threads.
class PictureStore {
public:
    /// `folder` is made if it is missing; empty: images stay in memory. Throws a runtime_error if
    /// that fails, or if the folder is a symbolic link, unless a / behind its name says that the
    /// link is meant: in a folder of --state others may have planted it. Links in place of the
    /// files are not followed, either.
    explicit PictureStore(std::string folder = "", const PictureCounts& counts = {});

    /// Whether a frame with this status and these measurements would be kept with such images.
    bool wants(PictureSize size, const FrameResult& frame) const;
    const PictureCounts& counts() const { return m_counts; }

    /// Makes the texts for `add`, which may be called in another process; in this process wants()
    /// knows the frame from now on.
    PictureTexts texts(const FrameResult& frame, const FramePictures& pictures);
    /// Keeps the images of a frame in place of its earlier ones. Throws a runtime_error if a file
    /// cannot be written.
    void add(const FrameResult& frame, const PictureTexts& pictures);
    void add(const FrameResult& frame, const FramePictures& pictures) {
        add(frame, texts(frame, pictures));
    }
    /// Removes the images that an earlier run kept of this frame, which now has none.
    void forget(const FrameResult& frame);

    /// Takes over the images of a frame that an earlier run has finished; false if they are not
    /// there, or were drawn for other counts.
    bool restore(const FrameResult& frame);

    /// The names of a frame's files; empty if images are kept in memory.
    std::vector<std::string> files(const Item& item) const;

    /// What was kept of a frame; empty where there is nothing.
    std::string text(PictureSize size, const FrameResult& frame) const;

    /// A case of the figure, as text (figure.h); it stays in memory.
    void keep_figure(const Item& item, std::string text);
    std::string figure(const Item& item) const;

    /// What is wrong with what is in the folder, in words; empty: nothing is.
    const std::string& complaint() const { return m_complaint; }

private:
    using Rank = std::tuple<int, double, Item>; ///< the worst first
    using Ranks = std::array<std::set<Rank>, kPictureSizes>;
    static Rank rank_of(const FrameResult& frame);
    bool insert(PictureSize size, const FrameResult& frame);
    void know(PictureSize size, const FrameResult& frame);
    void drop(const std::string& key, PictureSize size);
    void look_for_former_form();
    std::string asked() const;
    std::string file(const std::string& key, PictureSize size) const;
    void write(const std::string& key, PictureSize size, const std::string& text);

    std::string m_folder;
    PictureCounts m_counts;
    std::string m_complaint;
    mutable std::mutex m_mutex;
    Ranks m_worst; ///< the frames that are kept
    Ranks m_known; ///< the worst frames of those that were drawn
    std::map<std::string, std::string> m_texts;
    std::map<Item, std::string> m_figures;
};

/// Collects the images of one frame while its commands run: of the first compared pair, else of the
/// first image, and the spots of all commands.
struct FramePainter {
    const PictureStore& store;
    std::optional<FramePictures> drawn{};
    bool pair = false; ///< a pair was drawn as it was compared, not an image
    /// A later command draws a pair: of an image before it only thumbnails and spots are needed.
    bool pair_comes = false;
    bool for_report = true;        ///< else `drawn` stays empty
    CaseDrawing* beside = nullptr; ///< what is drawn for --images and --figure

    bool wants(const PictureRequest& request) const {
        return !drawn || (!pair && request.reference);
    }
    bool wants_full(const PictureRequest& request) const {
        return wants(request) && ((request.reference && request.compared) || !pair_comes);
    }
    void take(FramePictures pictures, const PictureRequest& request);
};

} // namespace tonetool::sequence
