// --qc: the faults that a picture shows without a reference.
#include "chain/error.h"
#include "chain/flip_args.h"
#include "include/tonetool/qc.h"
#include "sequence/qc_json.h"
#include "sequence/results.h"

namespace tonetool::chain {

namespace {

sequence::QcLimits limits_of(const Call& call) {
    sequence::QcLimits limits;
    for (const sequence::QcRule& rule : sequence::qc_rules()) {
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

// Of files that were read before, only the stack knows the types of the channels.
void take_types(const Image& image, QcFacts& facts) {
    size_t channel = 0;
    for (const PartPtr& part : image.parts()) {
        for (int c = 0; c < part->header().nchannels; ++c, ++channel) {
            if (const auto& format = part->format()) {
                const bool own = size_t(c) < format->of_channel.size();
                facts.channels.at(channel).second =
                    (own ? format->of_channel[size_t(c)] : format->type).c_str();
            }
        }
    }
}

void run_qc(Session& session, const Call& call) {
    const Image& image = *call.images[0];
    sequence::QcRecord record{{}, limits_of(call)};
    session.push(call.images[0]);
    session.produced = true;
    if (!session.result) {
        return; // the exposures of the shot are being measured
    }
    std::vector<OIIO::ImageBuf> parts;
    std::vector<const OIIO::ImageBuf*> pointers;
    for (const PartPtr& part : image.parts()) {
        parts.push_back(part->color_source());
    }
    for (const OIIO::ImageBuf& part : parts) {
        pointers.push_back(&part);
    }
    QcOptions options{pixel_options(call), split(call.text("groups").value_or(""), ',')};
    std::string why;
    if (!ToneAlgo::qc_facts(record.facts, pointers, why, options)) {
        throw CommandError("\"" + image.name() + "\": " + why);
    }
    take_types(image, record.facts);
    session.result->qc = sequence::to_json(record);
}

std::vector<Modifier> modifiers() {
    std::vector<Modifier> all = pixel_modifiers();
    all.push_back({"groups", "NAME,...", "light groups that add up to the picture (all)"});
    for (const sequence::QcRule& rule : sequence::qc_rules()) {
        std::string usual = severity_name(rule.severity);
        if (rule.threshold) {
            usual = format_number(*rule.threshold) + "," + usual;
        }
        all.push_back({rule.code, rule.threshold ? "X,SEVERITY" : "SEVERITY",
                       rule.help + (rule.threshold ? "; X: " + rule.measures : "") + " (" + usual +
                           ")"});
    }
    return all;
}

} // namespace

std::vector<Command> qc_commands() {
    return {{{{"qc"}, {}, 1, 1, Group::Measure},
             modifiers(),
             "Look for faults of the pictures and of the shot; severities: off, info, warning, error",
             run_qc}};
}

} // namespace tonetool::chain
