// SPDX-License-Identifier: BSD-3-Clause
// The frames of one view while their faults are searched for, and the searches.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "sequence/qc/qc_json.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

struct QcFrame {
    int number = 0;
    FrameResult* result = nullptr;
    QcFacts facts;
    StrayFiles strays;
    bool measured = false; ///< --qc has measured the frame
    bool blank = false;    ///< black or one colour all over: not compared with other frames
    bool held = false;     ///< shows the moment of the frame before
    bool changed = false;  ///< a fault of windows or layers begins here, or has ended
};

/// The layer, pixel and value of a fault, where it has them.
struct QcDetail {
    std::string layer{};
    std::optional<Position> position{};
    std::optional<double> value{};
    /// A case that is less severe than the fault usually is; a severity of the user's stands.
    std::optional<Severity> milder{};
    std::optional<std::array<int, 4>> rectangle{}; ///< x, y, width, height
};

class QcShot {
public:
    explicit QcShot(FaultLimits limits) : m_limits(std::move(limits)) {}
    void set_limits(FaultLimits limits) { m_limits = std::move(limits); }

    std::vector<QcFrame> frames; ///< sorted by number

    bool wants(const std::string& code) const { return m_limits.severity(code).has_value(); }
    double threshold(const std::string& code) const { return m_limits.threshold(code); }
    /// Adds a fault unless its kind is switched off.
    void add(QcFrame& frame, const std::string& code, const std::string& sentence,
             const QcDetail& detail = {}) const;

    /// The frames whose images can be compared with each other, in order.
    std::vector<QcFrame*> pictures();
    /// The frames whose layers can be compared, whether or not they have a beauty.
    std::vector<QcFrame*> filled();
    /// The frames that were measured.
    std::vector<QcFrame*> measured();

private:
    FaultLimits m_limits;
};

const QcLayer* find_layer(const QcFacts& facts, const std::string& name);
/// The layer that is the beauty; no_layer() if the file holds only data.
const QcLayer& picture_layer(const QcFacts& facts);
const QcLayer& no_layer();
bool has_picture(const QcFacts& facts);
double pixels_of(const QcFacts& facts); ///< of the data window
bool has_alpha(const QcPicture& picture);
/// Places of frames with other windows are not the same.
bool same_windows(const QcFrame& a, const QcFrame& b);
/// With fewer frames nobody knows what is usual.
constexpr size_t kEnoughFrames = 5;
bool is_blank(const QcFacts& facts, const FaultLimits& limits);
/// What the layers without noise tell of the moment of a frame; empty without such layers.
std::string moment_of(const QcFacts& facts);
/// Marks consecutive frames that have a fault: it explains a change of brightness at the first of
/// them and after the last.
void mark_change(const std::vector<QcFrame*>& frames, size_t first, size_t last);
/// "frame 7", "frames 7 to 9".
std::string frames_text(int first, int last);
/// "the picture", "layer X".
std::string layer_text(const QcLayer& layer);
double median(std::vector<double> values);
/// The usual distance of their numbers; where it is another, frames are missing or black.
double usual_distance(const std::vector<QcFrame*>& frames);
/// median() of sorted values but one of this size.
double median_without(const std::vector<double>& sorted, double value);

// The searches. Their files say which faults each adds.
void find_picture_faults(const QcShot& shot, QcFrame& frame);
void find_stray_files(QcShot& shot);
void find_blank(QcShot& shot);
void find_hidden(QcShot& shot);
void find_enlarged(QcShot& shot);
void find_bands(QcShot& shot);
void find_gaps(QcShot& shot);
void find_odd_headers(QcShot& shot);
void find_lost_layers(QcShot& shot);
void find_group_faults(QcShot& shot);
void find_clamped(QcShot& shot);
void find_magenta(QcShot& shot);
void find_holes(QcShot& shot);
void find_stale_buckets(QcShot& shot);
void find_moments(QcShot& shot);
void find_stalls(QcShot& shot);
void find_odd_motion(QcShot& shot);
void find_flicker(QcShot& shot);
void find_odd_statistics(QcShot& shot);
/// Of the views of a shot, by name.
void find_eye_faults(std::map<std::string, QcShot>& views);
void find_fireflies(QcShot& shot);

} // namespace tonetool::sequence
