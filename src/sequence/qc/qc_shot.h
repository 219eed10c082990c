// The frames of one view while their faults are sought, and the searches.
#pragma once

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
    bool measured = false; ///< there are facts
    bool blank = false;    ///< black or of one colour: compared with no other frame
    bool changed = false;  ///< a fault of windows or layers begins here, or has ended
};

/// What a fault is about, where there is more than its code and sentence.
struct QcDetail {
    std::string layer{};
    std::optional<Position> position{};
    std::optional<double> value{};
};

class QcShot {
public:
    explicit QcShot(QcLimits limits) : m_limits(std::move(limits)) {}

    std::vector<QcFrame> frames; ///< by number

    bool wants(const std::string& code) const { return m_limits.severity(code).has_value(); }
    double threshold(const std::string& code) const { return m_limits.threshold(code); }
    /// Adds a fault unless its kind is switched off.
    void add(QcFrame& frame, const std::string& code, const std::string& sentence,
             const QcDetail& detail = {}) const;

    /// Those whose pictures can be compared with each other, in order.
    std::vector<QcFrame*> pictures();
    /// Those whose layers can be, with a picture or without.
    std::vector<QcFrame*> filled();
    /// Those that were measured.
    std::vector<QcFrame*> measured();

private:
    QcLimits m_limits;
};

const QcLayer* find_layer(const QcFacts& facts, const std::string& name);
/// The layer that is the picture; no_layer() of a file of data.
const QcLayer& picture_layer(const QcFacts& facts);
const QcLayer& no_layer();
bool has_picture(const QcFacts& facts);
bool is_blank(const QcFacts& facts, const QcLimits& limits);
/// Frames in a row that have the fault: a step of the light to the first of them, or from the last,
/// needs no other explanation.
void mark_change(const std::vector<QcFrame*>& frames, size_t first, size_t last);
/// "frame 7", "frames 7 to 9".
std::string frames_text(int first, int last);
/// "the picture", "layer X".
std::string layer_text(const QcLayer& layer);
double median(std::vector<double> values);

// The searches; what each adds is in their files.
void find_picture_faults(const QcShot& shot, QcFrame& frame);
void find_gaps(QcShot& shot);
void find_odd_headers(QcShot& shot);
void find_lost_layers(QcShot& shot);
void find_group_faults(QcShot& shot);
void find_duplicates(QcShot& shot);
void find_flicker(QcShot& shot);
void find_fireflies(QcShot& shot);

} // namespace tonetool::sequence
