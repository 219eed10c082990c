// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/verdict/summary.h"

#include <algorithm>
#include <stdexcept>

#include "sequence/results/frame_json.h"
#include "sequence/results/json_text.h"

namespace tonetool::sequence {

namespace {

using nlohmann::ordered_json;

void check_equal(const std::string& key, const ordered_json& said, const ordered_json& found) {
    if (said != found) {
        throw std::runtime_error("\"" + key + "\" is " + one_line(said) +
                                 ", but that of its frames is " + one_line(found));
    }
}

} // namespace

ordered_json worst_of(const ShotResult& shot) {
    ordered_json list = ordered_json::array();
    for (size_t index : shot.worst) {
        const FrameResult& frame = shot.frames.at(index);
        ordered_json one{{"frame", frame.frame}};
        put_names(one, frame.item());
        list.push_back(one);
    }
    return list;
}

ordered_json counts_of(const std::vector<Status>& frames) {
    ordered_json counts = ordered_json::object();
    for (Status one : {Status::Passed, Status::Measured, Status::Skipped, Status::Warning,
                       Status::Failed, Status::SizeMismatch, Status::Missing, Status::Unreadable,
                       Status::Error, Status::Crashed})
        if (const auto count = std::count(frames.begin(), frames.end(), one);
            count > 0 || one != Status::Skipped) // which only suites have
            counts[status_name(one)] = count;
    return counts;
}

ordered_json counts_of(const ShotResult& shot) {
    return counts_of(statuses_of(shot));
}

void check_summary(const ordered_json& from, const std::vector<Status>& said,
                   const ShotResult& shot) {
    const ordered_json counts = counts_of(said);
    for (const auto& one : counts.items()) {
        check_equal("counts/" + one.key(), from.at("counts").value(one.key(), ordered_json(0)),
                    one.value());
    }
    check_equal("verdict", from.at("verdict"), status_name(verdict_of(said)));
    if (counts == counts_of(shot)) {
        check_equal("sentence", from.at("sentence"), shot.sentence);
        check_equal("worst", from.at("worst"), worst_of(shot));
    }
}

} // namespace tonetool::sequence
