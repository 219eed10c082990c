// SPDX-License-Identifier: BSD-3-Clause
// Noise or change, and limits from renders of the approved version.
#include "tonetool/bias.h"

#include <memory>

#include "imagebuf/options/bias_options.h"
#include "python/compare.h"
#include "python/families.h"

namespace tonetool::python {

namespace {

const std::string kBiasSource =
    "Welch 1947; Efron, JASA 64, 1969; Hall, JRSS B 54, 1992; Benjamini and Hochberg, JRSS B 57, "
    "1995; Schuirmann 1987; Jung, Hanika, Dachsbacher, JCGT 9(2), 2020.";
const std::string kSourceLimits = "Hahn and Meeker, \"Statistical Intervals\", 1991.";

struct BiasCall : BiasOptions {
    int nthreads = 0;
};

// Flat, as Python has it.
struct BiasObject {
    std::string verdict, reason, sentence;
    std::vector<std::string> evidence;
    double gain = 0, gain_se = 0, bound = 0, shown = 0;
    std::optional<double> more;
    std::map<std::string, double> numbers;
    FlipSide reference, test;
    OIIO::ROI region;
    std::optional<double> ignored;
    std::vector<std::string> warnings;
    py::object map;
};

Fields<BiasCall> bias_fields() {
    using O = BiasCall;
    return joined<O>(
        {described<O, BiasOptions>(),
         ignore_fields<O>(),
         {field<O>("pixels", &O::pixels, "Layer and colour space, for all images."),
          field<O>("size", &O::size,
                   "Different display windows are an error (\"match\"), the tests are resized to "
                   "the reference's, or only where they meet is compared (\"crop\")."),
          field<O>("memory", &O::memory,
                   "Bytes that a process without other work needs at most; too few are an error. "
                   "0: no bound."),
          threads_field<O>()}});
}

// One image, or several.
class BiasImages {
public:
    BiasImages(const py::object& given, const std::string& where) {
        const bool several = py::isinstance<py::list>(given) || py::isinstance<py::tuple>(given);
        std::vector<py::object> objects{given};
        if (several)
            objects = to_items(given, where, "Image | Sequence[Image]");
        for (size_t i = 0; i < objects.size(); ++i) {
            const std::string name = several ? where + "[" + std::to_string(i) + "]" : where;
            m_images.push_back(std::make_unique<InputImage>(objects[i], name));
            m_pointers.push_back(&m_images.back()->buf());
        }
    }
    const std::vector<const OIIO::ImageBuf*>& pointers() const { return m_pointers; }
    const InputImage* first() const { return m_images.empty() ? nullptr : m_images[0].get(); }

private:
    std::vector<std::unique_ptr<InputImage>> m_images;
    std::vector<const OIIO::ImageBuf*> m_pointers;
};

py::object run_bias(std::vector<py::object>& images, const BiasCall& options) {
    const BiasImages references(images[0], "bias_check: references"),
        tests(images[1], "bias_check: tests");
    BiasSummary summary;
    OIIO::ImageBuf map = computed([&](OIIO::ImageBuf& dst) {
        return ToneAlgo::bias_check(dst, references.pointers(), tests.pointers(), options, &summary,
                                    options.nthreads);
    });
    const BiasResult& r = summary.result;
    BiasObject out;
    out.verdict = ToneAlgo::bias_verdict_name(r.verdict);
    out.reason = ToneAlgo::bias_reason_name(r.reason);
    out.sentence = ToneAlgo::bias_sentence(r);
    out.evidence = ToneAlgo::bias_evidence(r);
    out.gain = r.gain[0].gain;
    out.gain_se = r.gain[0].se;
    out.bound = r.bound;
    out.shown = r.shown;
    out.more = r.more;
    for (const auto& [name, value] : ToneAlgo::bias_numbers(r))
        out.numbers[name] = value;
    out.reference = summary.reference;
    out.test = summary.test;
    out.region = summary.region;
    out.ignored = summary.ignored;
    out.warnings = summary.warnings;
    out.map = to_python(std::move(map), OutputKind::map(*references.first()));
    return py::cast(std::move(out));
}

struct FloorObject {
    double limit = 0;
    std::string method;
    int64_t values = 0, needed = 0, rank = 0;
    double k = 0;
    std::optional<int64_t> outlier;
};

py::object run_floor(std::vector<py::object>& arguments, const NoiseFloorOptions& options) {
    const auto values = Python<std::vector<double>>::from(arguments[0], "noise_floor: values");
    NoiseFloor floor;
    run_or_raise("noise_floor", [&](std::string& error) {
        return ToneAlgo::noise_floor(floor, values, options, error);
    });
    FloorObject out{floor.limit,  ToneAlgo::noise_floor_method(floor),
                    floor.values, floor.needed,
                    floor.rank,   floor.k,
                    std::nullopt};
    if (floor.outlier)
        out.outlier = int64_t(*floor.outlier);
    return py::cast(std::move(out));
}

void add_bias_results(Module& module) {
    using B = BiasObject;
    ResultClass<B>(module, "BiasResult", "Whether two renders differ in more than their noise.")
        .field("verdict", &B::verdict, "\"different\", \"equal\" or \"not enough samples\".")
        .field("reason", &B::reason, "Why.")
        .field("sentence", &B::sentence, "The verdict, and what it means.")
        .field("evidence", &B::evidence, "What differs beyond the noise.")
        .field("gain", &B::gain, "Relative difference of the luminance of the whole picture,")
        .field("gain_se", &B::gain_se, "and its standard error.")
        .field("bound", &B::bound, "Relative differences above it are excluded.")
        .field("shown", &B::shown,
               "Part of the blocks of about 64x64 pixels that are shown to be within the margin.")
        .field("more", &B::more, "How many times more samples would show equality, if that helps.")
        .field("numbers", &B::numbers, "These and all others by name, as in a check's JSON.")
        .field("reference", &B::reference, "How the references were read; counts are sums.")
        .field("test", &B::test, "How the tests were read; counts are sums.")
        .field("region", &B::region, "Pixels compared.")
        .field(kIgnoredField.name, &B::ignored, kIgnoredField.text)
        .field("warnings", &B::warnings, "What a user must know, one sentence each.")
        .object("map", &B::map, "Image", "The map that was asked for, height x width x channels.")
        .finish();
    using F = FloorObject;
    ResultClass<F>(module, "NoiseFloor", "A limit from values of unbiased renders.")
        .field("limit", &F::limit, "The upper tolerance limit.")
        .field("method", &F::method, "Order statistic, lognormal or normal.")
        .field("values", &F::values, "How many there were.")
        .field("rank", &F::rank, "Of the order statistic, from 1; else 0.")
        .field("k", &F::k, "Of the others: how many standard deviations above the mean.")
        .field("needed", &F::needed, "From so many values on it is an order statistic.")
        .field("outlier", &F::outlier,
               "The place of a value that is implausible beside the others.")
        .finish();
}

} // namespace

void add_bias(Module& module) {
    add_bias_results(module);
    Parameter references = reference_parameter(), tests = test_parameter();
    references.name = "references";
    tests.name = "tests";
    for (Parameter* one : {&references, &tests}) {
        one->type = "Image | Sequence[Image]";
        one->text += " A list: seeds, renders that differ only in their random numbers.";
    }
    define(module,
           Description{
               "bias_check",
               "Whether a render differs from its reference in more than the noise of its samples.",
               {references, tests},
               "BiasResult",
               "One of three verdicts, what it rests on, and a map.",
               "Shapes: all images of the same size, R, G, B first, 4096 pixels or more for a "
               "verdict; the map is height x width x 3 (\"rejected\": 2, \"all\": 8), an array if "
               "the reference is one.\nUnits: any, linear; differences are relative to the "
               "reference's light; negative components stay.\nColour: as hdr_flip.\n"
               "Alpha: not compared.\nNaN, Inf: such a pixel counts as 0 in all images; with any "
               "there is no \"equal\".\nIdentical images are \"equal\"; the number of threads "
               "changes no bit. A common error of all images, and what a denoiser has smeared, "
               "cannot be seen.",
               "No image, no R, G, B, deep images, different windows, a value out of range, an "
               "unreadable file, no finite pixel.",
               kBiasSource},
           bias_fields(), run_bias);
    define(module,
           Description{"noise_floor",
                       "The limit below which unbiased renders lie, from values of some of them.",
                       {{"values", "Sequence[float]",
                         "An error of each of 4 or more renders of the approved version, against "
                         "one reference that is none of them.",
                         ""}},
                       "NoiseFloor",
                       "The limit, and how it was found.",
                       "Units: those of the values. NaN, Inf: an error.",
                       "Fewer than 4 values, values that are not finite, a value out of range.",
                       kSourceLimits},
           described<NoiseFloorOptions, NoiseFloorOptions>(), run_floor);
}

} // namespace tonetool::python
