// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/against/against.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <climits>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "imagebuf/pixels/layer_name.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

struct Compared {
    FrameResult* result;
    AgainstRecord record;
};
using ComparedFrames = std::vector<Compared>;

// ---- layers

// A quantity of a layer that is beyond its limit.
struct Beyond {
    const AgainstQuantity* quantity;
    double value; ///< with its sign
    double limit; ///< that it is beyond
    Severity severity;
};

// Error from the limit on, warning from its share on; a severity of the user's bounds both.
std::optional<Beyond> beyond(const FaultLimits& limits, const AgainstQuantity& quantity,
                             double value) {
    const double limit = limits.threshold(quantity.code), size = std::abs(value);
    const auto severity = limits.severity(quantity.code);
    const double warning = quantity.warning_share * limit;
    if (!severity || !(size > warning))
        return std::nullopt;
    if (size > limit)
        return Beyond{&quantity, value, limit, *severity};
    return Beyond{&quantity, value, warning, std::min(*severity, Severity::Warning)};
}

// The worst quantity of a layer, or of its alpha. The first of those that are as severe says most:
// by how many stops a layer is brighter rather than that all its blocks differ.
std::optional<Beyond> worst_of(const AgainstRecord& record, const AgainstLayer& layer,
                               const std::string& kind) {
    std::optional<Beyond> worst;
    for (const AgainstQuantity& quantity : against_quantities()) {
        const auto found = layer.quantities.find(quantity.quantity);
        if (quantity.kind != kind || found == layer.quantities.end())
            continue;
        const auto one = beyond(record.limits, quantity, found->second);
        if (one && (!worst || one->severity > worst->severity))
            worst = one;
    }
    return worst;
}

bool is_emptied(const AgainstLayer& layer) {
    return layer.quantities.count("emptied") > 0;
}

std::string layer_words(const AgainstLayer& layer) {
    return (layer.kind == "group" ? "light group " : "layer ") + shown_layer(layer.name);
}

std::string percent(double share) {
    return format("{:.3g} %", 100 * share);
}

std::string sentence_of(const AgainstLayer& layer, const Beyond& beyond) {
    const std::string what = layer_words(layer);
    const std::string& quantity = beyond.quantity->quantity;
    const double value = beyond.value;
    std::string text;
    if (quantity == "gain")
        text = format("{} is {}{:.2g} stops {} than approved", what,
                      is_emptied(layer) ? "0 everywhere, " : "", std::abs(value),
                      value > 0 ? "brighter" : "darker");
    else if (quantity == "blocks")
        text = format("{} differs from the approved one by more than its noise in {} of the blocks",
                      what, percent(value));
    else if (quantity == "none_finite")
        return format("{} has no pixel that is finite in both versions", what);
    else if (quantity == "one_finite")
        return format(
            "{} is NaN or infinite in only one version in {} of the pixels, first at ({}, {})",
            what, percent(value), layer.one_finite_x, layer.one_finite_y);
    else if (quantity == "median")
        text = format("{} is {:.3g} {} off the approved one (median)", what, value,
                      layer.kind == "normal" ? "degrees" : "pixels");
    else if (quantity == "one")
        text = format("{} of the pixels have a normal in only one version of {}", percent(value),
                      what);
    else if (quantity == "mismatch")
        text = format("{} shows other objects in {} of the picture", what, percent(value));
    else if (quantity == "lost")
        text =
            format("{} is NaN or infinite in {} of the pixels, and was not", what, percent(value));
    else if (quantity == "others")
        text = format("{} of what {} covers are other objects", percent(value), what);
    else if (quantity == "alpha_mean")
        return format("alpha of {} differs from the approved one by {:.3g} on average", what,
                      value);
    else if (quantity == "alpha_off")
        return format("alpha of {} differs from the approved one in {} of the pixels", what,
                      percent(value));
    else
        text = format("{} differs from the approved one in {} of the pixels", what, percent(value));
    return format("{}, most at ({}, {})", text, layer.x, layer.y);
}

Fault fault_of(const AgainstLayer& layer, const Beyond& beyond) {
    Fault fault;
    fault.command = "against";
    fault.code = beyond.quantity->code;
    fault.severity = beyond.severity;
    fault.sentence = sentence_of(layer, beyond);
    fault.layer = layer.name;
    if (!beyond.quantity->kind.empty())
        fault.position = beyond.quantity->quantity == "one_finite"
                             ? Position{layer.one_finite_x, layer.one_finite_y}
                             : Position{layer.x, layer.y};
    fault.value = beyond.value;
    fault.threshold = beyond.limit;
    return fault;
}

// Layers without noise tell which frame it looks like.
bool tells_moment(const std::string& code) {
    return code == "position" || code == "depth";
}

// Where no other difference is an error.
bool add_empty(const AgainstRecord& record, const AgainstLayer& layer, std::vector<Fault>& faults) {
    const auto severity = record.limits.severity("empty");
    if (!severity || !is_emptied(layer))
        return false;
    Fault fault;
    fault.command = "against";
    fault.code = "empty";
    fault.severity = *severity;
    fault.layer = layer.name;
    fault.sentence = layer_words(layer) + " is 0 everywhere, the approved one is not";
    faults.push_back(std::move(fault));
    return true;
}

void add_layers(const AgainstRecord& record, std::vector<Fault>& faults) {
    for (const AgainstLayer& layer : record.layers) {
        bool found = false;
        for (const std::string& kind : {layer.kind, std::string()})
            if (const auto worst = worst_of(record, layer, kind)) {
                faults.push_back(fault_of(layer, *worst));
                found |= worst->severity == Severity::Error;
            }
        if (!found && add_empty(record, layer, faults))
            continue;
        const auto off = layer.quantities.find("off");
        const auto severity = record.limits.severity("data");
        if (layer.kind == "data" && severity && off != layer.quantities.end() && off->second > 0) {
            Fault fault;
            fault.command = "against";
            fault.code = "data";
            fault.severity = *severity;
            fault.layer = layer.name;
            fault.sentence = format("{} differs from the approved one in {} of the pixels",
                                    layer_words(layer), percent(off->second));
            faults.push_back(std::move(fault));
        }
    }
}

// ---- headers

void add_fault(const AgainstRecord& record, const AgainstDifference& difference,
               std::vector<Fault>& faults) {
    const auto severity = record.limits.severity(difference.code, difference.severity);
    if (!severity)
        return;
    Fault fault;
    fault.command = "against";
    fault.code = difference.code;
    fault.severity = *severity;
    fault.layer = difference.layer;
    fault.sentence = difference.sentence;
    faults.push_back(std::move(fault));
}

// Whether a window holds the other up to 2 pixels.
bool holds(const AgainstRecord::Window& a, const AgainstRecord::Window& b) {
    constexpr int slack = 2;
    return a[0] <= b[0] + slack && a[1] <= b[1] + slack && a[0] + a[2] >= b[0] + b[2] - slack &&
           a[1] + a[3] >= b[1] + b[3] - slack;
}

// Where the approved data windows are cropped frame by frame, the new ones need only hold them.
void add_window(const AgainstRecord& record, bool cropped, std::vector<Fault>& faults) {
    if (record.data == record.approved_data ||
        (cropped && holds(record.data, record.approved_data)))
        return;
    add_fault(record,
              {"datawindow", "",
               format("the data window is {}, approved is {}", window_text(record.data),
                      window_text(record.approved_data)),
               cropped ? Severity::Warning : Severity::Error},
              faults);
}

// A file of another size has other pixels at the same coordinates: its layers all differ, which
// says no more.
bool is_resized(const AgainstRecord& record) {
    return record.data != record.approved_data &&
           record.limits.severity("displaywindow").has_value() &&
           std::any_of(record.differences.begin(), record.differences.end(),
                       [](const AgainstDifference& difference) {
                           return difference.code == "displaywindow";
                       });
}

// A frame that only the new version has: of a longer cut, or a hole in the approved version.
std::vector<Fault> faults_without_approved(const AgainstRecord& record, bool hole) {
    std::vector<Fault> faults;
    add_fault(record,
              {"noapproved", "",
               hole ? "the approved version has no such frame, though it has earlier and later ones"
                    : "the approved version has no such frame",
               hole ? Severity::Error : Severity::Info},
              faults);
    return faults;
}

// Whether a rule that warns or fails looks at the pixels of the layer. Its alpha alone says nothing
// of them.
bool is_judged(const AgainstRecord& record, const AgainstLayer& layer) {
    const auto speaks = [&](const std::string& code) {
        return record.limits.severity(code).value_or(Severity::Info) > Severity::Info;
    };
    const auto& all = against_quantities();
    return (layer.kind == "data" && speaks("data")) ||
           std::any_of(all.begin(), all.end(), [&](const AgainstQuantity& one) {
               return one.kind == layer.kind && layer.quantities.count(one.quantity) > 0 &&
                      speaks(one.code);
           });
}

std::string why_unjudged(const AgainstRecord& record) {
    if (!record.approved)
        return "the approved version has no such frame";
    const auto& all = record.layers;
    const bool any = std::any_of(all.begin(), all.end(), [&](const AgainstLayer& layer) {
        return is_judged(record, layer);
    });
    return any ? ""
               : "--against judges none of its layers: they are data, which is told, or their "
                 "rules are off (valid: kind=, data=error)";
}

std::vector<Fault> faults_of(const AgainstRecord& record, bool cropped) {
    std::vector<Fault> faults;
    for (const AgainstDifference& difference : record.differences)
        add_fault(record, difference, faults);
    add_window(record, cropped, faults);
    if (!is_resized(record))
        add_layers(record, faults);
    std::stable_sort(faults.begin(), faults.end(), [](const Fault& a, const Fault& b) {
        const auto key = [](const Fault& fault) {
            return std::make_pair(-int(fault.severity), rank_of(against_rules(), fault.code));
        };
        return key(a) < key(b);
    });
    return faults;
}

// ---- the shot

bool is_cropped(const ComparedFrames& frames) {
    std::set<AgainstRecord::Window> windows;
    for (const Compared& frame : frames)
        if (frame.record.approved)
            windows.insert(frame.record.approved_data);
    return windows.size() > 1;
}

// The approved frame, at most two away, that shows the moment of frame i.
std::optional<int> frame_alike(const ComparedFrames& frames, size_t i) {
    constexpr int most = 2;
    const AgainstRecord& here = frames[i].record;
    if (here.moment.empty() || here.moment == here.approved_moment)
        return std::nullopt;
    for (const Compared& other : frames) {
        const int apart = std::abs(other.result->frame - frames[i].result->frame);
        if (apart > 0 && apart <= most && other.record.approved_moment == here.moment)
            return other.result->frame;
    }
    return std::nullopt;
}

bool is_of_against(const Fault& fault) {
    return fault.command == "against";
}

// Where no frame was compared at all, the approved version is not where it was looked for.
void refuse_without_any(ComparedFrames& frames) {
    if (std::any_of(frames.begin(), frames.end(),
                    [](const Compared& frame) { return frame.record.approved; }))
        return;
    for (Compared& frame : frames) {
        Fault fault;
        fault.command = "against";
        fault.code = "noapproved";
        fault.severity = Severity::Error;
        fault.sentence = "no frame of the approved version is there: nothing was compared";
        std::vector<Fault>& faults = frame.result->faults;
        faults.erase(std::remove_if(faults.begin(), faults.end(), is_of_against), faults.end());
        faults.insert(faults.begin(), fault);
        judge(*frame.result);
    }
}

// The numbers of the first and the last frame of the approved version.
std::pair<int, int> approved_range(const ComparedFrames& frames) {
    std::pair<int, int> range{INT_MAX, INT_MIN};
    for (const Compared& frame : frames)
        if (frame.record.approved)
            range = {std::min(range.first, frame.result->frame),
                     std::max(range.second, frame.result->frame)};
    return range;
}

void judge_frames(ComparedFrames& frames) {
    const bool cropped = is_cropped(frames);
    const auto [first, last] = approved_range(frames);
    for (size_t i = 0; i < frames.size(); ++i) {
        const int number = frames[i].result->frame;
        std::vector<Fault> found =
            frames[i].record.approved
                ? faults_of(frames[i].record, cropped)
                : faults_without_approved(frames[i].record, frames[i].record.between ||
                                                                (first < number && number < last));
        const std::optional<int> alike = frame_alike(frames, i);
        for (Fault& fault : found)
            if (alike && tells_moment(fault.code))
                fault.sentence += format("; it is the moment of approved frame {}", *alike);
        FrameResult& result = *frames[i].result;
        result.unjudged = why_unjudged(frames[i].record);
        result.faults.insert(result.faults.end(), found.begin(), found.end());
        std::stable_sort(result.faults.begin(), result.faults.end(),
                         [](const Fault& a, const Fault& b) { return a.severity > b.severity; });
        judge(result);
    }
}

// Frames whose geometry is that of another approved view.
void find_swapped(const ComparedFrames& frames, const ComparedFrames& others,
                  const std::string& view) {
    for (const Compared& frame : frames) {
        for (const Compared& other : others) {
            const AgainstRecord &here = frame.record, &there = other.record;
            if (other.result->frame != frame.result->frame || here.moment.empty() ||
                here.moment != there.approved_moment || here.moment == here.approved_moment)
                continue;
            std::vector<Fault> found;
            add_fault(
                here,
                {"eyes", "", "it shows view " + view + " of the approved version", Severity::Error},
                found);
            std::vector<Fault>& faults = frame.result->faults;
            faults.insert(faults.begin(), found.begin(), found.end());
            judge(*frame.result);
        }
    }
}

// Of one shot, or of one case.
void judge_views_against(std::map<std::string, ComparedFrames>& views) {
    for (auto& [view, of_view] : views) {
        judge_frames(of_view);
        refuse_without_any(of_view);
    }
    for (const auto& [view, of_view] : views)
        for (const auto& [other, of_other] : views)
            if (view != other)
                find_swapped(of_view, of_other, other);
}

} // namespace

std::vector<Fault> against_faults(const AgainstRecord& record) {
    return faults_of(record, false);
}

void judge_against(std::vector<FrameResult>& frames) {
    std::map<std::pair<std::string, std::string>, std::map<std::string, ComparedFrames>> shots;
    for (FrameResult& frame : frames) {
        if (frame.against.empty())
            continue;
        frame.faults.erase(std::remove_if(frame.faults.begin(), frame.faults.end(), is_of_against),
                           frame.faults.end());
        shots[{frame.name, frame.method}][frame.view].push_back(
            {&frame, against_from_json(frame.against)});
    }
    for (auto& [of, views] : shots)
        judge_views_against(views);
}

} // namespace tonetool::sequence
