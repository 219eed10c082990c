// SPDX-License-Identifier: BSD-3-Clause
// --diff and --pdiff, with oiiotool's report and exit status, but for what oiiotool lets pass:
// images with values that are no numbers (images/unseen_difference.h), and without --compat images
// whose windows, channels or parts differ, and parts that it does not look at.
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <limits>
#include <optional>
#include <ostream>

#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_report.h"
#include "chain/commands/options.h"
#include "chain/images/counted_pair.h"
#include "chain/images/unseen_difference.h"
#include "imagebuf/options/ignore_options.h"
#include "sequence/results/results.h"
#include "text/error.h"
#include "tonetool/color_tags.h"

namespace tonetool::chain {

namespace {

using OIIO::Strutil::fmt::format;
using sequence::DiffLimit;
using sequence::DiffLimits;
using Results = OIIO::ImageBufAlgo::CompareResults;

enum class Verdict { Pass, Warning, Failure };

std::string values_at(const OIIO::ImageBuf& image, const Results& found) {
    Strings words;
    for (int c = 0; c < image.nchannels(); ++c)
        words.push_back(format("{:g}", image.getchannel(found.maxx, found.maxy, found.maxz, c)));
    return join(words, ", ");
}

void print_maximum(Session& session, const OIIO::ImageBuf& a, const OIIO::ImageBuf& b,
                   const Results& found) {
    session.out << format("  Max error  = {:g}", found.maxerror);
    if (found.maxerror != 0) {
        const OIIO::ImageSpec& named = a.nchannels() > found.maxc ? a.spec() : b.spec();
        session.out << format(" @ ({}, {}, {}{})", found.maxx, found.maxy,
                              a.spec().depth > 1 ? format("{}, ", found.maxz) : "",
                              named.channel_name(found.maxc));
    }
    if (found.maxerror != 0 && !a.deep() && !b.deep())
        session.out << format("  values are {} vs {}", values_at(a, found), values_at(b, found));
    session.out << '\n';
}

void print_report(Session& session, const OIIO::ImageBuf& a, const OIIO::ImageBuf& b,
                  const Results& found, double pixels, bool perceptual) {
    const DiffLimits& limits = session.settings.diff;
    if (!perceptual) {
        session.out << format("  Mean error = {:g}\n  RMS error = {:g}\n  Peak SNR = {:g}\n",
                              found.meanerror, found.rms_error, found.PSNR);
    }
    print_maximum(session, a, b, found);
    const std::pair<OIIO::imagesize_t, std::string> counts[] = {
        {found.nwarn, format("over {:g}", limits.warn.each)},
        {found.nfail, format("over {:g}", limits.fail.each)},
        {found.nfail, "failed the perceptual test"}};
    for (size_t i = 0; i < (perceptual ? 3 : 2); ++i) {
        const auto& [count, what] = counts[i];
        session.out << format("  {} pixels ({:.3g}%) {}\n", count, 100.0 * double(count) / pixels,
                              what);
    }
}

Verdict judge(const Results& found, const DiffLimits& limits, double pixels) {
    const auto beyond = [&](OIIO::imagesize_t count, const DiffLimit& limit) {
        return double(count) > limit.allowed(pixels) || found.maxerror > double(limit.hardest);
    };
    if (beyond(found.nfail, limits.fail))
        return Verdict::Failure;
    return beyond(found.nwarn, limits.warn) ? Verdict::Warning : Verdict::Pass;
}

// The verdict as a threshold: of the pixels that fail or warn, or of the largest error.
sequence::Threshold threshold_of(const Results& found, const DiffLimits& limits, double pixels,
                                 Verdict verdict) {
    const bool warns = verdict == Verdict::Warning;
    const double count = double(warns ? found.nwarn : found.nfail);
    const DiffLimit& exceeded = warns ? limits.warn : limits.fail;
    const double allowed = exceeded.allowed(pixels);
    const bool by_count = verdict == Verdict::Pass || count > allowed;
    const std::optional<double> limit = by_count ? allowed : double(exceeded.hardest), none;
    return {by_count ? "differing-pixels" : "max", by_count ? count : found.maxerror, false,
            warns ? none : limit, warns ? limit : none};
}

void record(Session& session, const Results& found, double pixels, Verdict verdict,
            const std::optional<CountedPair>& counted) {
    if (session.check.result) {
        sequence::Measurement measured;
        measured.thresholds = {threshold_of(found, session.settings.diff, pixels, verdict)};
        measured.quantities = {
            {"mean", found.meanerror}, {"rms", found.rms_error}, {"max", found.maxerror}};
        measured.worst = sequence::Position{found.maxx, found.maxy};
        measured.pixels = static_cast<long long>(pixels);
        if (counted)
            measured.parameters.emplace_back(key_name(kIgnoredField), counted->ignored());
        session.check.result->measurements.push_back(std::move(measured));
    }
}

// Images that differ in more than their pixels (`unlike`) have no measurement of their own.
void complete_record(Session& session, const Call& call, size_t before, Verdict verdict,
                     bool unlike) {
    if (!session.check.result)
        return;
    auto& all = session.check.result->measurements;
    if (all.size() == before || unlike ||
        (verdict == Verdict::Failure && session.settings.all_subimages)) {
        all.emplace_back();
        all.back().thresholds = {
            {"differing-images", verdict == Verdict::Failure ? 1.0 : 0.0, false, 0.0, {}}};
    }
    for (size_t i = before; i < all.size(); ++i) {
        all[i].command = call.row().label();
        all[i].reference = call.images[0]->name();
        all[i].test = call.images[1]->name();
    }
}

Results results_of(const OIIO::ImageBuf& a, const OIIO::ImageBuf& b, const DiffLimits& limits,
                   bool perceptual) {
    Results found{};
    if (perceptual)
        found.nfail = OIIO::imagesize_t(OIIO::ImageBufAlgo::compare_Yee(a, b, found));
    else
        found = OIIO::ImageBufAlgo::compare(a, b, limits.fail.each, limits.warn.each);
    if (a.has_error() || b.has_error())
        throw CommandError(a.has_error() ? a.geterror() : b.geterror());
    return found;
}

// No limit is as large as the error of the first unlike pixel.
void add(Results& found, const NonfiniteMismatch& unlike) {
    found.maxerror = std::numeric_limits<double>::infinity();
    found.maxx = unlike.x;
    found.maxy = unlike.y;
    found.maxz = unlike.z;
    found.maxc = unlike.channel;
}

// What of two images counts; nothing where all does.
std::optional<CountedPair> counted_pair(Session& session, const Call& call, const OIIO::ImageBuf& a,
                                        const OIIO::ImageBuf& b) {
    IgnoreOptions options;
    read_ignored(call, options);
    if (!options.any())
        return std::nullopt;
    const std::string label = call.row().label();
    const LeaveOut how = label == "pdiff" ? LeaveOut::Equalizing : LeaveOut::Closing;
    std::optional<CountedPair> counted(std::in_place, a, b, options, how);
    for (const std::string& warning : counted->warnings())
        session.warning(label, warning);
    session.print(label + ": " + format("{}x{} pixels", a.spec().width, a.spec().height) +
                  ignored_text(counted->ignored()));
    return counted;
}

// Once something differs, all that follows is reported.
void compare_pixels(Session& session, const Call& call, const OIIO::ImageBuf& whole_a,
                    const OIIO::ImageBuf& whole_b, const std::string& heading, Verdict& worst) {
    const Settings& settings = session.settings;
    const bool perceptual = call.row().label() == "pdiff";
    const auto counted = counted_pair(session, call, whole_a, whole_b);
    const OIIO::ImageBuf &a = counted ? counted->a() : whole_a,
                         &b = counted ? counted->b() : whole_b;
    const double pixels = counted
                              ? counted->pixels()
                              : double(std::max(a.spec().image_pixels(), b.spec().image_pixels()));
    Results found = results_of(a, b, settings.diff, perceptual);
    Verdict verdict = judge(found, settings.diff, pixels);
    // Where oiiotool fails, too, its report is kept.
    const bool settled = settings.compat && verdict == Verdict::Failure;
    const NonfiniteMismatch unlike = settled ? NonfiniteMismatch{} : find_nonfinite_mismatch(a, b);
    if (unlike.pixels > 0) {
        add(found, unlike);
        verdict = judge(found, settings.diff, pixels);
    }
    const auto unseen = perceptual && !settings.compat && !a.deep() && !b.deep()
                            ? unseen_differences(a, b, settings.diff.fail.each)
                            : 0;
    if (counted)
        counted->place(found.maxx, found.maxy);
    Results all = found;
    all.nfail = std::max(found.nfail, unseen);
    verdict = unseen > 0 ? judge(all, settings.diff, pixels) : verdict;
    record(session, all, pixels, verdict, counted);
    worst = std::max(worst, verdict);
    if (worst != Verdict::Pass || settings.verbose) {
        session.out << heading;
        print_report(session, whole_a, whole_b, found, pixels, perceptual);
        if (unlike.pixels > 0 && !settings.compat) {
            session.print(
                format("  {} pixel(s) are NaN, Inf or -Inf in one image and not in the other",
                       unlike.pixels));
        }
        if (unseen > 0) {
            session.print(format("  {} pixel(s) differ where --pdiff does not look: in channels "
                                 "behind the first three, or beside a NaN or Inf",
                                 unseen));
        }
    }
}

// Of a comparison of images that may have several parts.
struct Comparison {
    Verdict worst = Verdict::Pass;
    bool unlike = false; ///< they differ in more than their pixels

    void differ(Session& session, const std::string& how) {
        session.print(how);
        worst = Verdict::Failure;
        unlike = true;
    }
};

// Without --compat all parts and levels are compared: what nobody looked at does not pass.
bool compares_all(const Session& session) {
    return session.settings.all_subimages || !session.settings.compat;
}

// Levels that only one of the two has are no difference of the pictures, but are not compared.
int levels_of(Session& session, Part& a, Part& b) {
    if (session.settings.all_subimages)
        return a.mip_levels();
    if (session.settings.compat || a.mip_levels() == b.mip_levels())
        return session.settings.compat ? 1 : a.mip_levels();
    session.print(format("Only compared the first MIPmap level (of {} and {}, respectively)",
                         a.mip_levels(), b.mip_levels()));
    ++session.outcome.warnings;
    return 1;
}

void compare_parts(Session& session, const Call& call, Part& a, Part& b, const std::string& which,
                   Comparison& compared) {
    const int levels = levels_of(session, a, b);
    if (levels > 1 && (call.has("mask") || call.has("ignore"))) {
        throw CommandError("mask= and ignore= are of one MIP level, and " + std::to_string(levels) +
                           " are compared (valid: --selectmip of both images)");
    }
    for (int level = 0; level < levels; ++level) {
        if (level > 0 && a.mip_levels() != b.mip_levels())
            return compared.differ(session, "Files do not match in their number of MIPmap levels");
        const OIIO::ImageSpec& spec = a.header(level);
        const std::string unlike =
            session.settings.compat ? "" : difference_of_headers(spec, b.header(level));
        if (!unlike.empty())
            return compared.differ(session, unlike);
        const std::string heading = format("{} {}: {} x {}, {} channel\n", which,
                                           level > 0 ? format(" MIP level {} ", level) : "",
                                           spec.width, spec.height, spec.nchannels);
        compare_pixels(session, call, a.pixels(level), b.pixels(level),
                       which.empty() ? "" : heading, compared.worst);
    }
}

Comparison compare_images(Session& session, const Call& call, const Image& a, const Image& b) {
    const bool all = compares_all(session);
    const size_t parts = all ? std::min(a.part_count(), b.part_count()) : 1;
    Comparison compared;
    for (size_t s = 0; s < parts; ++s) {
        const bool named = session.settings.all_subimages || parts > 1;
        compare_parts(session, call, a.part(s), b.part(s), named ? format("Subimage {}", s) : "",
                      compared);
    }
    if (all && a.part_count() != b.part_count()) {
        compared.differ(session, format("Images had differing numbers of subimages ({} vs {})",
                                        a.part_count(), b.part_count()));
    } else if (a.part_count() > parts || b.part_count() > parts) {
        session.print(format("Only compared the first subimage (of {} and {}, respectively)",
                             a.part_count(), b.part_count()));
    }
    return compared;
}

// The numbers of the files are compared, whatever their headers say that these mean.
void warn_of_unapplied(Session& session, const Call& call, const Image& image_a,
                       const Image& image_b) {
    const OIIO::ImageSpec &a = image_a.part().header(), &b = image_b.part().header();
    const auto gamma = [](const OIIO::ImageSpec& spec) {
        const double stated = stated_gamma(spec);
        return stated > 0 ? format_number(stated) : std::string("none");
    };
    const auto exposure = [](const OIIO::ImageSpec& spec) {
        return format_number(stated_exposure(spec));
    };
    const auto profile = [](const OIIO::ImageSpec& spec) {
        return unapplied_profile(spec).value_or("none");
    };
    const auto told = [&](const char* what, const std::string& one, const std::string& other) {
        if (one != other) {
            session.warning(call.row().label(), std::string(what) + " is " + one +
                                                    " in the one and " + other +
                                                    " in the other, and is not applied");
        }
    };
    const auto space = [](const OIIO::ImageSpec& spec) {
        return spec.get_string_attribute("oiio:ColorSpace", "none");
    };
    told("gamma", gamma(a), gamma(b));
    told("EXPOSURE", exposure(a), exposure(b));
    told("the ICC profile", profile(a), profile(b));
    if (image_a.file_format() == image_b.file_format()) // formats have their own
        told("the colour space", space(a), space(b));
}

// Limits that no number of pixels can exceed.
void check_limits(const DiffLimits& limits) {
    constexpr float all = 100, unlimited = 1e30f;
    if (limits.fail.percent >= all && limits.fail.hardest >= unlimited) {
        throw CommandError(format("--failpercent {} can never fail (valid: below 100, or with "
                                  "--hardfail)",
                                  limits.fail.percent));
    }
}

void run_diff(Session& session, const Call& call) {
    const bool perceptual = call.row().label() == "pdiff";
    const Image &a = *call.images[0], &b = *call.images[1];
    session.print(format("Computing {}diff of \"{}\" vs \"{}\"", perceptual ? "perceptual " : "",
                         a.name(), b.name()));
    const size_t before = session.check.result ? session.check.result->measurements.size() : 0;
    session.outcome.unused_limit.clear();
    if (!session.settings.compat) {
        check_limits(session.settings.diff);
        check_nothing_left_out(a);
        check_nothing_left_out(b);
        if (same_file(a, 0, b, 0)) {
            tell_same_file(session, call, a, b,
                           "\"" + a.name() + "\" and \"" + b.name() + "\" are the same file");
        }
        warn_of_unapplied(session, call, a, b);
    }
    const Comparison compared = compare_images(session, call, a, b);
    const Verdict verdict = compared.worst;
    complete_record(session, call, before, verdict, compared.unlike);
    session.print(verdict == Verdict::Pass      ? "PASS"
                  : verdict == Verdict::Warning ? "WARNING"
                                                : "FAILURE");
    session.outcome.warnings += verdict == Verdict::Warning ? 1 : 0;
    session.outcome.differs |= verdict == Verdict::Failure;
    session.outcome.produced |= !(perceptual && session.settings.compat);
    session.stack.push(call.images[0]);
    session.stack.push(call.images[1]);
}

Row limit_row(const sequence::DiffOption& option) {
    const auto set = [option](Session& session, const Call& call) {
        (session.settings.diff.*option.limit).*option.number =
            float(call.number_argument(0, {0, 1e30}));
        session.outcome.unused_limit = call.row().label();
    };
    return command(option.name + std::string(" ") + option.argument, option.help, set);
}

} // namespace

Rows diff_commands() {
    Rows rows;
    for (const sequence::DiffOption& option : sequence::kDiffOptions)
        rows.push_back(limit_row(option));
    rows.push_back(
        command("diff", "Report the difference of two images; status 1 if it fails", run_diff)
            .images(2, 2)
            .modifiers(modifiers_of<IgnoreOptions>())
            .judges());
    rows.push_back(
        command("pdiff", "Report the perceptual difference of two images (Yee)", run_diff)
            .images(2, 2)
            .modifiers(modifiers_of<IgnoreOptions>())
            .judges());
    return rows;
}

} // namespace tonetool::chain
