// SPDX-License-Identifier: BSD-3-Clause
// --noisefloor: limits of an error that come from renders of the approved version instead of a
// guess.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <set>

#include "chain/commands/color_input.h"
#include "chain/commands/commands.h"
#include "chain/commands/flip_args.h"
#include "chain/commands/options.h"
#include "imagebuf/options/bias_options.h"
#include "imagebuf/options/flip_options.h"
#include "sequence/results/check_files.h"
#include "sequence/results/limits_file.h"
#include "sequence/results/measuring.h"
#include "text/error.h"
#include "text/printable.h"

namespace tonetool::chain {

namespace {

using OIIO::ImageBuf;
using OIIO::Strutil::fmt::format;
using sequence::KeptLimit;
using sequence::KeptLimits;
using Images = std::vector<ImagePtr>;

const Strings kFloorCommands = {"hdrflip", "ldrflip", "errormap"};
const Strings kOwnKeys = {"command", "quantity", "content", "confidence", "baseline"};
constexpr size_t kFewestForBaseline = 4;

bool is_own(const std::string& key) {
    return std::find(kOwnKeys.begin(), kOwnKeys.end(), key) != kOwnKeys.end();
}

// What an error is measured with, each key once: those of the commands.
Modifiers measuring_modifiers() {
    Modifiers all;
    std::set<std::string> keys;
    for (const Modifier& one : concatenated({modifiers_of<ErrorOptions>(), hdr_modifiers(),
                                             modifiers_of<FlipOptions>(), pair_modifiers()}))
        if (keys.insert(one.key).second)
            all.push_back(one);
    return all;
}

// The command that the limits are for, and how it compares one seed with the reference.
class Meter {
public:
    Meter(Session& session, const Call& call)
        : m_call(call),
          m_command(call.choice("command", kFloorCommands).value_or(kFloorCommands.front())) {
        check_keys();
        if (m_command == "errormap")
            m_error = error_options(session, call);
        else
            read_flip_options(session, call, true, m_flip);
        if (m_command == "hdrflip")
            read_hdr_options(session, call, m_flip);
        for (const std::string& name : split(call.text("quantity").value_or("mean,p99"), ','))
            add_quantity(known(name));
        m_flip.quantities = m_error.quantities = m_further;
    }

    const std::string& command() const { return m_command; }
    const Strings& quantities() const { return m_quantities; }
    const PixelOptions& pixels() const {
        return m_command == "errormap" ? m_error.pixels : m_flip.pixels;
    }
    SizePolicy size() const { return m_command == "errormap" ? m_error.size : m_flip.size; }

    /// 0 to 1, so that a limit of 1 would hold nothing.
    bool bounded() const {
        return m_command != "errormap" ||
               metrics::find_error_metric(m_error.metric)->has(metrics::kBounded);
    }

    /// The quantities, and last the mean of the map, which no two renders have in common.
    std::vector<double> measure(const ImageBuf& reference, const ImageBuf& seed) const {
        ImageBuf map;
        std::vector<double> values;
        if (m_command == "errormap") {
            ErrorSummary summary;
            require(ToneAlgo::error_map(map, reference, seed, m_error, &summary), map);
            for (const std::string& name : m_quantities)
                values.push_back(
                    ToneAlgo::flip_quantity(summary.pool, name).value_or(summary.value));
            values.push_back(summary.pool.mean);
            return values;
        }
        FlipResult result;
        require(m_command == "hdrflip" ? ToneAlgo::hdr_flip(map, reference, seed, m_flip, &result)
                                       : ToneAlgo::ldr_flip(map, reference, seed, m_flip, &result),
                map);
        for (const std::string& name : m_quantities)
            values.push_back(ToneAlgo::flip_quantity(result.summary.pool, name).value());
        values.push_back(result.summary.pool.mean);
        return values;
    }

    /// What the limits are bound to.
    sequence::Texts modifiers() const {
        sequence::Texts given;
        for (const Modifier& one : m_call.row().modifiers)
            if (const auto value = m_call.text(one.key); value && !is_own(one.key))
                given.emplace_back(one.key, *value);
        std::sort(given.begin(), given.end());
        return given;
    }

private:
    static void require(bool done, const ImageBuf& map) {
        if (!done)
            throw CommandError(map.geterror());
    }

    // The command itself would refuse the others.
    void check_keys() const {
        const Command& row = *find_command(m_command);
        for (const Modifier& one : m_call.row().modifiers) {
            const auto same = [&](const Modifier& other) { return other.key == one.key; };
            if (m_call.has(one.key) && !is_own(one.key) &&
                std::none_of(row.modifiers.begin(), row.modifiers.end(), same))
                throw CommandError(one.key + "= is no modifier of --" + m_command);
        }
    }

    void add_quantity(const std::string& name) {
        if (std::find(m_quantities.begin(), m_quantities.end(), name) != m_quantities.end())
            throw CommandError("quantity= has " + name + " twice (valid: each once)");
        m_quantities.push_back(name);
    }

    std::string known(const std::string& name) {
        Strings names = ToneAlgo::flip_quantities();
        if (m_command == "errormap")
            names.insert(names.begin(), m_error.metric);
        if (sequence::higher_is_better(m_command, name)) {
            throw CommandError("quantity " + name +
                               ": higher is better, this is for errors "
                               "(valid: mse in place of psnr, or a quantity of the map)");
        }
        if (std::find(names.begin(), names.end(), name) != names.end())
            return name;
        const auto further = ToneAlgo::flip_quantity_name(name);
        if (!further) {
            throw CommandError("unknown quantity \"" + name + "\"" + meant(name, names) +
                               " (valid: " + join(names, ", ") + ", pNN)");
        }
        m_further.push_back(*further);
        return *further;
    }

    const Call& m_call;
    std::string m_command;
    HdrFlipOptions m_flip;
    ErrorOptions m_error;
    Strings m_quantities, m_further;
};

// All images of the stack: the reference and the seeds.
Images take_all(Session& session) {
    Images all = session.stack.pop(session.stack.images.size());
    if (all.size() < 5) {
        throw CommandError("needs a reference and 4 or more renders of the approved version, the "
                           "stack has " +
                           std::to_string(all.size()) + " image(s)" +
                           (session.frame.loops ? " (# loops over frames; valid: the names of all "
                                                  "seeds, as a shell makes them of seed.*.exr)"
                                                : ""));
    }
    for (const ImagePtr& image : all) {
        image->used = image->worked_on = true;
        session.note_format(*image);
        if (image->is_result)
            throw CommandError("\"" + image->name() + "\" is what a comparison has made");
        for (const ImagePtr& other : all)
            if (other != image && same_file(*image, 0, *other, 0)) {
                throw CommandError("\"" + image->name() + "\" and \"" + other->name() +
                                   "\" are the same file: the reference and the seeds must be "
                                   "independent renders");
            }
    }
    return all;
}

class Floor {
public:
    Floor(Session& session, const Call& call)
        : m_session(session),
          m_call(call),
          m_meter(session, call),
          m_images(take_all(session)) {
        read_options(call, m_kept.options);
        m_kept.command = m_meter.command();
        m_kept.modifiers = m_meter.modifiers();
        m_kept.reference = m_images.front()->name();
        for (const ImagePtr& image : m_images)
            m_sources.push_back(color_source(session, call, *image, m_meter.pixels()));
    }

    /// False where the reference is out of date.
    bool find() {
        const bool fresh = !m_call.flag("baseline", true) || check_baseline();
        std::vector<std::vector<double>> values(m_meter.quantities().size());
        for (size_t i = 1; i < m_images.size() && fresh; ++i) {
            const std::vector<double> found = m_meter.measure(m_sources[0], m_sources[i]);
            refuse_copy(found.back(), i);
            for (size_t q = 0; q < values.size(); ++q)
                values[q].push_back(found[q]);
            m_kept.seeds.push_back(m_images[i]->name());
        }
        for (size_t q = 0; q < values.size() && fresh; ++q)
            add(m_meter.quantities()[q], std::move(values[q]));
        return fresh;
    }

    const KeptLimits& kept() const { return m_kept; }

private:
    // A copy under another name is no render of its own: limits would be too narrow, or too wide.
    void refuse_copy(double mean, size_t i) {
        const auto same = std::find(m_means.begin(), m_means.end(), mean);
        const bool twice = same != m_means.end();
        if (mean == 0 || twice) {
            const Image& other = *m_images[twice ? size_t(same - m_means.begin()) + 1 : 0];
            throw CommandError("\"" + m_images[i]->name() + "\" is the same image as \"" +
                               other.name() +
                               "\": the reference and the seeds must be independent renders");
        }
        m_means.push_back(mean);
    }

    // A reference that is not what the seeds converge to makes every limit too wide.
    bool check_baseline() {
        std::vector<const ImageBuf*> seeds;
        for (size_t i = 1; i < m_sources.size(); ++i)
            seeds.push_back(&m_sources[i]);
        BiasOptions options;
        options.pixels = m_meter.pixels();
        options.size = m_meter.size();
        BiasSummary summary;
        ImageBuf map;
        if (!ToneAlgo::bias_check(map, {&m_sources[0]}, seeds, options, &summary))
            throw CommandError(map.geterror());
        const std::string sentence = ToneAlgo::bias_sentence(summary.result);
        const std::string label = m_call.row().label();
        switch (summary.result.verdict) {
        case BiasVerdict::Different:
            ++m_session.outcome.failures;
            m_session.print(label +
                            ": FAIL the reference lies outside the seeds, the baseline is "
                            "out of date? (" +
                            sentence + "); no limits are written");
            return false;
        case BiasVerdict::Equal:
            m_kept.baseline = "the reference is what the seeds converge to: " + sentence;
            break;
        case BiasVerdict::NotEnoughSamples:
            m_kept.baseline =
                "whether the reference is out of date could not be ruled out: " + sentence;
            break;
        }
        return true;
    }

    void add(const std::string& quantity, std::vector<double> values) {
        NoiseFloorOptions options = m_kept.options;
        options.below_one = m_meter.bounded();
        KeptLimit limit{quantity, {}, std::move(values)};
        std::string why;
        if (!ToneAlgo::noise_floor(limit.floor, limit.values, options, why))
            throw CommandError(quantity + ": " + why);
        if (limit.floor.outlier) {
            m_kept.warnings.push_back(
                format("{} of \"{}\" is {}, far above the others: a firefly, or another version?",
                       quantity, m_kept.seeds.at(*limit.floor.outlier),
                       format_number(limit.values.at(*limit.floor.outlier))));
        }
        m_kept.limits.push_back(std::move(limit));
    }

    Session& m_session;
    const Call& m_call;
    Meter m_meter;
    Images m_images;
    std::vector<ImageBuf> m_sources;
    std::vector<double> m_means; ///< of the seeds' maps
    KeptLimits m_kept;
};

void tell(Session& session, const Call& call, const KeptLimits& kept) {
    const std::string label = call.row().label();
    session.report(format("{}: {} of {} seeds against {}", label, kept.command, kept.seeds.size(),
                          printable(kept.reference)));
    for (const KeptLimit& limit : kept.limits) {
        const auto [least, most] = std::minmax_element(limit.values.begin(), limit.values.end());
        session.report(format("{}: {} {} to {} in the seeds, limit {} ({})", label, limit.quantity,
                              format_number(*least), format_number(*most),
                              format_number(limit.floor.limit),
                              ToneAlgo::noise_floor_method(limit.floor)));
    }
    session.report(
        format("{}: with {:g} % confidence at least {:g} % of unbiased renders lie below "
               "a limit: false alarms of at most {:.3g} % each",
               label, 100 * kept.options.confidence, 100 * kept.options.content,
               100 * (1 - kept.options.content)));
    if (!kept.baseline.empty())
        session.report(label + ": " + kept.baseline);
}

void run_noisefloor(Session& session, const Call& call) {
    const std::string& file = call.argument(0);
    if (file != "-" && !OIIO::Strutil::iends_with(file, ".json")) {
        throw CommandError("the limits are written into a file of JSON, not \"" + file +
                           "\" (valid: limits.json, or - for the standard output)");
    }
    Floor floor(session, call);
    session.outcome.produced = true;
    if (!floor.find())
        return;
    for (const std::string& warning : floor.kept().warnings)
        session.warning(call.row().label(), warning);
    if (file == "-") {
        session.out << sequence::to_json(floor.kept());
        return;
    }
    tell(session, call, floor.kept());
    if (session.settings.no_clobber && OIIO::Filesystem::exists(file)) {
        session.report(call.row().label() + ": " + printable(file) + " is there already, it stays");
        return;
    }
    session.claim(file);
    if (session.settings.dry_run)
        return;
    try {
        sequence::write_text(sequence::to_json(floor.kept()), file);
    } catch (const std::runtime_error& problem) {
        throw CommandError(problem.what());
    }
    session.report(call.row().label() + ": wrote " + printable(file) + ", for --" +
                   floor.kept().command + ":fail=" + printable(file));
}

} // namespace

Rows noise_floor_commands() {
    return {command("noisefloor " + std::string(kLimitsArgument),
                    "Limits of an error from renders of the approved version: reference and all "
                    "seeds -> file for fail=",
                    run_noisefloor)
                .modifier("command", join(kFloorCommands, "|"), "what the limits are for (hdrflip)")
                .modifier("quantity", "NAME,...", "quantities to limit (mean,p99)")
                .modifiers(modifiers_of<NoiseFloorOptions>())
                .modifier("baseline", "0|1",
                          "whether the reference is what the seeds converge to, as --biascheck "
                          "tells; if not, exit status 3 and no limits (1)")
                .modifiers(measuring_modifiers())
                .frequent("command,quantity,content,confidence,layer,from")
                .takes_all()
                .at_once()};
}

} // namespace tonetool::chain
