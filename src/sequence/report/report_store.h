// SPDX-License-Identifier: BSD-3-Clause
// Keeps the images of a shot's frames while it is checked, until the report is written.
#pragma once

#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <vector>

#include "sequence/report/report_pictures.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// The images of a frame as the page and the folder hold them.
struct PictureTexts {
    std::string full; ///< empty where only the thumbnails were drawn
    std::string small;
};

/// Keeps the full images of the worst frames and the thumbnails of all, so that memory and disk are
/// bounded; the choice does not depend on the order in which frames come. With a folder the images
/// are files there ("0005.full.json", "0005.small.json"), so that a continued run, or a merge of
/// the parts of several machines, finds them again. Safe to call from several threads.
class PictureStore {
public:
    /// `folder` is made if it is missing; empty: images stay in memory. Throws a runtime_error if
    /// that fails, or if the folder is a symbolic link, unless a / behind its name says that the
    /// link is meant: in a folder of --state others may have planted it. Links in place of the
    /// files are not followed, either.
    explicit PictureStore(std::string folder = "", size_t full_frames = kMostFullFrames);

    /// Whether a frame with this status and these measurements would be kept with full images.
    bool wants_full(const FrameResult& frame) const;

    /// Makes the texts for `add`, which may be called in another process; in this process
    /// wants_full() knows the frame from now on.
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
    /// there.
    bool restore(const FrameResult& frame);

    /// The names of a frame's files; empty if images are kept in memory.
    std::vector<std::string> files(int frame, const std::string& view) const;

    /// The texts of small_json() and full_json(); empty where there is none.
    std::string small(const FrameResult& frame) const;
    std::string full(const FrameResult& frame) const;

    static constexpr size_t kMostFullFrames = 24;

private:
    using Rank = std::tuple<int, double, int, std::string>; ///< the worst first
    static Rank rank_of(const FrameResult& frame);
    bool insert(const FrameResult& frame);
    void know(const FrameResult& frame);
    void drop(const std::string& key, const char* size);
    std::string file(const std::string& key, const char* size) const;
    void write(const std::string& key, const char* size, const std::string& text);
    std::string read(const FrameResult& frame, const char* size) const;

    std::string m_folder;
    size_t m_full_frames;
    mutable std::mutex m_mutex;
    std::set<Rank> m_worst; ///< the frames that are kept in full
    std::set<Rank> m_known; ///< the worst frames of those that were drawn in full
    std::map<std::string, std::string> m_texts;
};

/// Collects the images of one frame while its commands run: of the first compared pair, else of the
/// first image, and the spots of all commands.
struct FramePainter {
    const PictureStore& store;
    std::optional<FramePictures> drawn{};
    bool pair = false; ///< a pair was drawn, not an image

    bool wants(const PictureRequest& request) const {
        return !drawn || (!pair && request.reference);
    }
    void take(FramePictures pictures, const PictureRequest& request);
};

} // namespace tonetool::sequence
