// The pictures of a shot's frames, while it is checked and until the report is written.
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

/// The pictures of a frame as the page and the folder hold them.
struct PictureTexts {
    std::string full; ///< empty where only the thumbnails were drawn
    std::string small;
};

/// Keeps the full pictures of the worst frames and the thumbnails of all, so that memory and disk
/// are bounded; which they are does not depend on the order in which frames come. With a folder
/// they are files there ("0005.full.json", "0005.small.json"), so that a run that is continued, or
/// a merge of what several machines checked, finds them again. Safe to call from several threads.
class PictureStore {
public:
    /// `folder` is made where it is missing; empty: memory. A runtime_error if that fails, or if it
    /// is a symbolic link, unless a / behind its name says that the link is meant: in a folder of
    /// --state others may have planted it. Links in place of the files are not followed either.
    explicit PictureStore(std::string folder = "", size_t full_frames = most_full_frames);

    /// Whether a frame like this, by its status and measurements so far, would be kept in full.
    bool wants_full(const FrameResult& frame) const;

    /// What `add` takes, maybe in another process; this one counts the frame among those that
    /// wants_full() knows.
    PictureTexts texts(const FrameResult& frame, const FramePictures& pictures);
    /// In place of what was kept of the frame before. A runtime_error if a file cannot be written.
    void add(const FrameResult& frame, const PictureTexts& pictures);
    void add(const FrameResult& frame, const FramePictures& pictures) {
        add(frame, texts(frame, pictures));
    }
    /// A frame without pictures: what an earlier run has kept of it is not this frame's.
    void forget(const FrameResult& frame);

    /// A frame that an earlier run has finished: false if its pictures are not there.
    bool restore(const FrameResult& frame);

    /// The names of a frame's files; none in memory.
    std::vector<std::string> files(int frame, const std::string& view) const;

    /// The texts of small_json() and full_json(); empty where there is none.
    std::string small(const FrameResult& frame) const;
    std::string full(const FrameResult& frame) const;

    static constexpr size_t most_full_frames = 24;

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
    std::set<Rank> m_known; ///< the worst of all that were drawn in full
    std::map<std::string, std::string> m_texts;
};

/// What is drawn of one frame while its commands run, for the store: a pair rather than an image,
/// the first of its kind, and the spots of all.
struct FramePainter {
    const PictureStore& store;
    std::optional<FramePictures> drawn{};
    bool pair = false; ///< that was drawn

    bool wants(const PictureRequest& request) const {
        return !drawn || (!pair && request.reference);
    }
    void take(FramePictures pictures, const PictureRequest& request);
};

} // namespace tonetool::sequence
