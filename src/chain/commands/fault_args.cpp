// SPDX-License-Identifier: BSD-3-Clause
#include "chain/commands/fault_args.h"

#include <stdexcept>

#include "text/error.h"

namespace tonetool::chain {

Modifiers fault_modifiers(const sequence::FaultRules& rules) {
    Modifiers all;
    for (const sequence::FaultRule& rule : rules) {
        std::string usual = severity_name(rule.severity);
        if (rule.threshold)
            usual = format_number(*rule.threshold) + "," + usual;
        all.push_back(
            {rule.code, rule.threshold ? "X,SEVERITY" : "SEVERITY",
             rule.help + (rule.threshold ? "; X: " + rule.measures : "") + " (" + usual + ")"});
    }
    return all;
}

sequence::FaultLimits fault_limits(const Call& call, const sequence::FaultRules& rules) {
    sequence::FaultLimits limits(rules);
    for (const sequence::FaultRule& rule : rules) {
        if (const auto text = call.text(rule.code)) {
            try {
                limits.set(rule.code, *text);
            } catch (const std::runtime_error& problem) {
                throw CommandError(problem.what());
            }
        }
    }
    return limits;
}

void take_types(const Image& image, std::vector<std::pair<std::string, std::string>>& channels) {
    size_t channel = 0;
    for (const PartPtr& part : image.parts()) {
        for (int c = 0; c < part->header().nchannels; ++c, ++channel) {
            if (const auto& format = part->format()) {
                const bool own = size_t(c) < format->of_channel.size();
                channels.at(channel).second =
                    (own ? format->of_channel[size_t(c)] : format->type).c_str();
            }
        }
    }
}

} // namespace tonetool::chain
