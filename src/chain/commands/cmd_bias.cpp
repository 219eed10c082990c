// SPDX-License-Identifier: BSD-3-Clause
// --biascheck: noise or change? --noisefloor: limits from renders of the approved version.
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>

#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/flip_report.h"
#include "chain/commands/frame_pictures.h"
#include "chain/commands/options.h"
#include "imagebuf/options/bias_options.h"
#include "imagebuf/options/ignore_options.h"
#include "imagebuf/pixels/upright.h"
#include "sequence/results/measurement.h"
#include "sequence/results/verdict_limits.h"
#include "text/error.h"
#include "text/printable.h"

namespace tonetool::chain {

namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;
using sequence::VerdictLimits;

constexpr Range kSeedRange{1, 1000};

// Seeds of a side: references=K, tests=K, or seeds=K for both.
int side_count(const Call& call, const char* side) {
    const int both = call.integer("seeds", kSeedRange).value_or(1);
    return call.integer(side, kSeedRange).value_or(both);
}
int reference_count(const Call& call) {
    return side_count(call, "references");
}
int test_seed_count(const Call& call) {
    return side_count(call, "tests");
}
int biascheck_pops(const Call& call) {
    return reference_count(call) + test_seed_count(call);
}

// Each of so many frames is tested at a part of alpha, so that all together have its false alarms.
int family_of(const Call& call) {
    const std::string frames = call.text("frames").value_or("each");
    if (frames == "each" || frames == "family") // family: of one, where no frame loop counts them
        return 1;
    const auto count = parse_integer(frames);
    if (!count || *count < 1) {
        throw CommandError("frames is \"" + frames +
                           "\" (valid: each, family, or a number of frames)");
    }
    return *count;
}

BiasOptions bias_options(const Session& session, const Call& call) {
    BiasOptions options;
    options.pixels = pixel_options(call);
    options.size = size_policy(call);
    options.memory = memory_for(session, call);
    read_options(call, options);
    read_ignored(call, options);
    options.alpha /= family_of(call);
    return options;
}

VerdictLimits verdict_limits(const Call& call) {
    return {call.flag("fail", true),
            call.choice("inconclusive", {"fail", "warn", "pass"}).value_or("fail")};
}

// ---- what is printed

std::string plural(int count, const std::string& word) {
    return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

std::string noise_text(const BiasResult& r) {
    std::string which = r.unlike == 0  ? "noise alike"
                        : r.unlike > 0 ? "the test is noisier than the reference"
                                       : "the reference is noisier than the test";
    if (r.options.reference != kBiasNoises[0])
        which += " by reference=" + r.options.reference;
    return format(", {} (asymmetry {:.2f}), pixels {} (correlation {:.3f})", which, r.asymmetry,
                  r.correlated ? "correlated" : "independent", r.correlation);
}

std::string evidence_text(const BiasResult& r) {
    std::string overall;
    Strings found;
    for (size_t c = 0; c < kBiasChannels; ++c)
        if (r.gain[c].rejected)
            overall += std::string(" ") + kBiasChannelNames[c];
    const std::string overall_word = "overall";
    found.push_back(overall_word + (overall.empty() ? " none" : overall));
    for (const std::string& one : ToneAlgo::bias_evidence(r))
        if (one.compare(0, overall_word.size(), overall_word) != 0)
            found.push_back(one);
    const auto any = [&](int64_t BiasScale::*count) {
        return std::any_of(r.scales.begin(), r.scales.end(),
                           [count](const BiasScale& scale) { return scale.*count > 0; });
    };
    if (!any(&BiasScale::rejected))
        found.emplace_back("mean none");
    if (!any(&BiasScale::structures))
        found.emplace_back(r.correlated ? "structure not tested" : "structure none");
    found.push_back(format("untested {} of {}", r.untested, r.tested));
    return join(found, "; ");
}

Strings brief_lines(const BiasSummary& summary) {
    const BiasResult& r = summary.result;
    Strings lines{plural(r.references, "reference") + ", " + plural(r.tests, "test") +
                  format(", {}x{}", r.width, r.height) + ignored_text(summary.ignored) +
                  (r.judged ? noise_text(r) : "")};
    if (!r.judged)
        return lines;
    const BiasGain& y = r.gain[0];
    lines.push_back(format("gain {:+.4f} +- {:.4f} (Y), weighted; energy {:+.4f} +- {:.4f}", y.gain,
                           y.se, y.energy, y.energy_se));
    lines.push_back(evidence_text(r));
    lines.push_back(format("bound {}, shown for {:.3g} % of the blocks", format_number(r.bound),
                           100 * r.shown));
    if (summary.reference.negative + summary.test.negative > 0) {
        lines.push_back(
            format("note: {} pixel(s) of the reference and {} of the test have negative "
                   "values, which are kept",
                   summary.reference.negative, summary.test.negative));
    }
    return lines;
}

void print_lines(Session& session, const Call& call, const BiasSummary& summary) {
    const std::string label = call.row().label();
    const Detail what = detail(session, call);
    if (what != Detail::Brief && what != Detail::All)
        return;
    for (const std::string& line : brief_lines(summary))
        session.print(label + ": " + line);
    if (what == Detail::Brief)
        return;
    Lines lines(label);
    lines.add("reference", call.images.front()->name());
    visit_side(fields(lines, summary.reference, "reference"));
    lines.add("test", call.images[size_t(reference_count(call))]->name());
    visit_side(fields(lines, summary.test, "test"));
    lines.add("within", summary.result.options.within);
    lines.add("alpha", summary.result.options.alpha);
    lines.add("reason", ToneAlgo::bias_reason_name(summary.result.reason));
    for (const auto& [name, value] : ToneAlgo::bias_numbers(summary.result))
        lines.add(name, value);
    session.print(lines.text);
}

std::string tests_text(const Call& call) {
    const auto first = size_t(reference_count(call));
    const size_t others = call.images.size() - first - 1;
    return printable(call.images[first]->name()) +
           (others > 0 ? " and " + plural(int(others), "more seed") : "");
}

// The verdict is the last line. What is neither equal nor different has not been passed, whatever
// becomes of it.
void print_verdict(Session& session, const Call& call, const BiasSummary& summary,
                   const std::vector<sequence::Threshold>& thresholds) {
    const auto exceeded = [&](auto sequence::Threshold::*limit) {
        return std::any_of(thresholds.begin(), thresholds.end(), [limit](const auto& threshold) {
            return threshold.*limit && threshold.value > *(threshold.*limit);
        });
    };
    const bool failed = exceeded(&sequence::Threshold::fail);
    const bool warned = exceeded(&sequence::Threshold::warn);
    const std::string label = call.row().label();
    const std::string text =
        ToneAlgo::bias_sentence(summary.result) + " (" + tests_text(call) + ")";
    if (warned)
        session.warning(label, text);
    if (failed) {
        ++session.outcome.failures;
        session.print(label + ": FAIL " + text);
    } else if (warned) {
        session.report(label + ": WARNING " + text);
    } else if (summary.result.verdict == BiasVerdict::NotEnoughSamples) {
        session.report(label + ": " + text);
    } else if (detail(session, call) != Detail::Nothing || !session.frame.loops) {
        session.report(label + ": PASS " + text);
    }
}

// ---- the command

// One render twice tells nothing: of a side it is not two seeds, of both sides it is most likely a
// slip.
void check_seeds(Session& session, const Call& call, size_t references) {
    for (size_t i = 0; i < call.images.size(); ++i) {
        for (size_t k = 0; k < i; ++k) {
            const Image &a = *call.images[k], &b = *call.images[i];
            if (!same_file(a, 0, b, 0))
                continue;
            const bool one_side = (k < references) == (i < references);
            const std::string text =
                "\"" + a.name() + "\" and \"" + b.name() + "\" are the same file";
            if (one_side) {
                throw CommandError(text + ", which is one seed and not two (valid: renders of "
                                          "different random numbers)");
            }
            tell_same_file(session, call, a, b, text);
        }
    }
}

// Those that a report shows are read; the others one after another by the library.
std::vector<ImageBuf> read_images(Session& session, const Call& call, const BiasOptions& options,
                                  size_t references) {
    const bool shown = shown_bytes(session, call) > 0 && options.halves.empty();
    PixelOptions pixels = options.pixels;
    if (!options.halves.empty())
        pixels.layer = options.halves.front();
    std::vector<ImageBuf> images;
    images.reserve(call.images.size()); // else the pixels are copied
    for (size_t i = 0; i < call.images.size(); ++i) {
        const bool first = i == 0 || i == references;
        if (i > 0)
            check_same_picture(session, call, *call.images[0], pixels, *call.images[i], pixels);
        images.push_back(
            (shown && first ? shown_input : color_source)(session, call, *call.images[i], pixels));
    }
    return images;
}

sequence::Measurement measurement_of(const Call& call, const BiasSummary& summary,
                                     const VerdictLimits& limits, size_t references) {
    sequence::Measurement measured = sequence::measurement(summary);
    measured.thresholds = sequence::verdict_thresholds(measured, limits);
    const auto names = [&](size_t begin, size_t end) {
        Strings all;
        for (size_t i = begin; i < end; ++i)
            all.push_back(call.images[i]->name());
        return join(all, " ");
    };
    if (references > 1)
        measured.settings.emplace_back("references", names(0, references));
    if (call.images.size() - references > 1)
        measured.settings.emplace_back("tests", names(references, call.images.size()));
    return measured;
}

// Of all channels those of the map that was asked for.
ImageBuf asked_map(const ImageBuf& all, const std::string& which) {
    std::vector<int> channels;
    const int begins[] = {0, 3, 6, all.nchannels()};
    for (size_t m = 0; m < 3; ++m)
        for (int c = begins[m]; c < begins[m + 1]; ++c)
            if (which == kBiasMaps[m] || which == kBiasMaps[3])
                channels.push_back(c);
    return OIIO::ImageBufAlgo::channels(all, int(channels.size()), channels);
}

void run_biascheck(Session& session, const Call& call) {
    const auto references = size_t(reference_count(call));
    BiasOptions options = bias_options(session, call);
    const VerdictLimits limits = verdict_limits(call);
    const std::string map_name = options.map;
    const bool shown = session.check.painter && options.halves.empty();
    if (shown)
        options.map = kBiasMaps[3];
    check_seeds(session, call, references);
    const std::vector<ImageBuf> images = read_images(session, call, options, references);
    std::vector<const ImageBuf*> sides[2];
    for (size_t i = 0; i < images.size(); ++i)
        sides[i < references ? 0 : 1].push_back(&images[i]);
    BiasSummary summary;
    ImageBuf map;
    if (!ToneAlgo::bias_check(map, sides[0], sides[1], options, &summary))
        throw CommandError(map.geterror());
    session.outcome.produced = true;
    for (const std::string& warning : summary.warnings)
        session.warning(call.row().label(), warning);
    sequence::Measurement measured = measurement_of(call, summary, limits, references);
    const std::vector<sequence::Threshold> thresholds = measured.thresholds;
    record(session, call, std::move(measured), references - 1);
    if (session.check.result) // not the second reference
        session.check.result->test = call.images[references]->name();
    print_lines(session, call, summary);
    print_verdict(session, call, summary, thresholds);
    if (shown) {
        sequence::PictureRequest request;
        request.reference = sides[0].front();
        request.test = sides[1].front();
        request.bias = &map;
        request.within = options.within;
        request.look.pixels = options.pixels;
        request.look.size = options.size;
        show(session, call, std::move(request));
        map = asked_map(map, map_name);
    }
    lie_as(call.images.front()->part().header(), map);
    session.stack.push(Image::computed("--" + call.row().label(), std::move(map)));
}

} // namespace

Rows bias_commands() {
    return {
        command("biascheck",
                "Noise or change? Tells renders that differ in more than their noise: "
                "references, tests -> map",
                run_biascheck)
            .checked([](Session& session, const Call& call) {
                (void)bias_options(session, call);
                (void)verdict_limits(call);
            })
            .images(2, 1)
            .images_of(biascheck_pops)
            .modifiers(modifiers_of<BiasOptions>())
            .modifier("references", "K", "so many seeds of the reference, below the tests (1)")
            .modifier("tests", "K", "so many seeds of the test (1)")
            .modifier("seeds", "K", "references=K and tests=K")
            .modifier("fail", "0|1", "\"different\" is exit status 3 (1), or a warning (0)")
            .modifier("inconclusive", "fail|warn|pass",
                      "what \"not enough samples\" does: exit status 3 (fail), a warning, or "
                      "exit status 0; it is never called passed")
            .modifier("frames", "each|family|N",
                      "alpha is the rate of false alarms of each frame (each), or of all frames "
                      "together (family; N: of so many)")
            .modifiers(pixel_modifiers())
            .modifier("resize", "0|1", "resize the tests to the reference's display window")
            .modifier("crop", "0|1", "compare only where the display windows meet")
            .modifiers(modifiers_of<IgnoreOptions>(), Modifiers{kPrint})
            .frequent("within,references,tests,inconclusive,fail,frames,layer")
            .judges()};
}

} // namespace tonetool::chain
