// SPDX-License-Identifier: BSD-3-Clause
// Statistics that leave their way for some frames, or for good: light, tint, saturation, noise,
// sharpness, blur, alphalevel, layerlight.
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <functional>

#include "sequence/qc/qc_thumbnails.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;
using Frames = std::vector<QcFrame*>;
using Values = std::vector<double>;

// A statistic, how large a lasting step must be in units of its threshold, and its words.
struct Statistic {
    std::string code;
    double step;
    std::string more, less; ///< "brighter", "darker"
    std::string unit;       ///< " stops"; empty: the logarithm of a factor
    const QcLayer* layer = nullptr;
};

// Where frames are no neighbours: a number is missing, another rule explains the change, or there
// is a cut. A break at k is between k - 1 and k.
std::vector<bool> breaks_of(const Frames& frames) {
    const std::vector<Thumbnail> thumbnails = thumbnails_of(frames);
    const double usual = usual_step_of(thumbnails);
    const double distance = usual_distance(frames);
    std::vector<bool> breaks{true};
    for (size_t i = 1; i < frames.size(); ++i)
        breaks.push_back(frames[i]->changed ||
                         frames[i]->number - frames[i - 1]->number != distance ||
                         !same_windows(*frames[i - 1], *frames[i]) ||
                         is_cut(thumbnails[i - 1], thumbnails[i], usual));
    return breaks;
}

// How far the frames [k, k + length) are off the straight way from the frame before them to that
// after: that which is the least off, with its sign; 0 unless all are on one side.
double least_off(const Values& s, size_t k, size_t length) {
    const double before = s[k - 1], after = s[k + length];
    double least = 0;
    for (size_t i = 0; i < length; ++i) {
        const double way = before + (after - before) * double(i + 1) / double(length + 1);
        const double off = s[k + i] - way;
        if (i > 0 && off * least <= 0)
            return 0;
        if (i == 0 || std::abs(off) < std::abs(least))
            least = off;
    }
    return least;
}

class ScalarSearch {
public:
    ScalarSearch(QcShot& shot, const Frames& frames, const std::vector<bool>& breaks,
                 const Statistic& statistic, const Values& series)
        : m_shot(shot),
          m_frames(frames),
          m_breaks(breaks),
          m_statistic(statistic),
          m_series(series),
          m_taken(series.size()) {}

    void find() {
        find_runs();
        find_steps();
    }

private:
    bool is_whole(size_t first, size_t last) const;
    bool is_free(size_t first, size_t last) const;
    void find_runs();
    void find_steps();
    double step(size_t k) const { return std::abs(m_series[k] - m_series[k - 1]); }
    void tell(size_t first, size_t last, double off, const std::string& than, bool comes_back);

    QcShot& m_shot;
    const Frames& m_frames;
    const std::vector<bool>& m_breaks;
    const Statistic& m_statistic;
    const Values& m_series;
    std::vector<bool> m_taken; ///< frames that are told
};

// Whether there is no break from the first frame to the last.
bool ScalarSearch::is_whole(size_t first, size_t last) const {
    return std::none_of(m_breaks.begin() + std::ptrdiff_t(first) + 1,
                        m_breaks.begin() + std::ptrdiff_t(last) + 1, [](bool b) { return b; });
}

bool ScalarSearch::is_free(size_t first, size_t last) const {
    return std::none_of(m_taken.begin() + std::ptrdiff_t(first),
                        m_taken.begin() + std::ptrdiff_t(last) + 1, [](bool b) { return b; });
}

// The light explains what else changes with it.
void ScalarSearch::tell(size_t first, size_t last, double off, const std::string& than,
                        bool comes_back) {
    const std::string which =
        first == last ? std::string()
                      : frames_text(m_frames[first]->number, m_frames[last]->number) + ": ";
    const std::string& word = off > 0 ? m_statistic.more : m_statistic.less;
    const std::string what =
        m_statistic.unit.empty()
            ? format("{} by a factor of {:.2g}", word, std::exp2(std::abs(off)))
            : format("{:.2g}{} {}", std::abs(off), m_statistic.unit, word);
    const QcLayer* layer = m_statistic.layer;
    m_shot.add(
        *m_frames[first], m_statistic.code,
        format("{}{}{} than {}", which, layer ? layer_text(*layer) + " is " : "", what, than),
        {layer ? layer->name : "", {}, std::abs(off), {}});
    if (m_statistic.code == "light") {
        m_frames[first]->changed = true;
        if (comes_back && last + 1 < m_frames.size())
            m_frames[last + 1]->changed = true;
    }
}

// Some frames that are off the way between those around them, much more than is usual.
void ScalarSearch::find_runs() {
    constexpr double unusual = 8, back = 0.5;
    std::vector<double> seconds;
    for (size_t k = 1; k + 1 < m_series.size(); ++k)
        if (is_whole(k - 1, k + 1))
            seconds.push_back(std::abs(least_off(m_series, k, 1)));
    const double limit =
        std::max(m_shot.threshold(m_statistic.code), unusual * median(std::move(seconds)));
    for (const size_t length : {size_t(1), size_t(2), size_t(3), size_t(6)}) {
        for (size_t k = 1; k + length < m_series.size(); ++k) {
            const size_t last = k + length - 1;
            const double off = least_off(m_series, k, length);
            const double apart = std::abs(m_series[k - 1] - m_series[last + 1]);
            if (std::abs(off) <= limit || apart >= back * std::abs(off) ||
                !is_whole(k - 1, last + 1) || !is_free(k, last))
                continue;
            std::fill(m_taken.begin() + std::ptrdiff_t(k) - 1,
                      m_taken.begin() + std::ptrdiff_t(last) + 2, true);
            tell(k, last, off,
                 format("frames {} and {} around {}", m_frames[k - 1]->number,
                        m_frames[last + 1]->number, length == 1 ? "it" : "them"),
                 true);
        }
    }
}

// A step that lasts, or is at an end of the shot, much larger than the steps beside it.
void ScalarSearch::find_steps() {
    constexpr double unusual = 10, alone = 4;
    std::vector<double> steps;
    for (size_t k = 1; k < m_series.size(); ++k)
        if (!m_breaks[k])
            steps.push_back(step(k));
    const double limit = std::max(m_statistic.step * m_shot.threshold(m_statistic.code),
                                  unusual * median(std::move(steps)));
    for (size_t k = 1; k < m_series.size(); ++k) {
        const auto is_small = [&](size_t beside) {
            return beside == 0 || beside >= m_series.size() || m_breaks[beside] ||
                   m_taken[beside] || step(k) > alone * step(beside);
        };
        const bool first = k == 1 || m_breaks[k - 1];
        const bool last = k + 1 == m_series.size() || m_breaks[k + 1];
        if (m_breaks[k] || (first && last) || !(step(k) > limit) || !is_small(k - 1) ||
            !is_small(k + 1) || m_taken[k] || m_taken[k - 1])
            continue;
        tell(k, k, m_series[k] - m_series[k - 1], format("frame {}", m_frames[k - 1]->number),
             false);
    }
}

// ---- the statistics

struct Color {
    double red, green, blue;
};

double luminance_of_cell(int cell) {
    return cell > QcPicture::kDark ? std::exp2(cell / 1000.0) : 0;
}

// The mean colours of the cells, from their luminances and tints.
std::vector<Color> colors_of(const QcPicture& picture) {
    std::vector<Color> colors;
    for (size_t i = 0; i < picture.thumbnail.size(); ++i) {
        const double red = std::exp2(picture.red[i] / 32.0);
        const double blue = std::exp2(picture.blue[i] / 32.0);
        const double green = luminance_of_cell(picture.thumbnail[i]) /
                             (0.2126 * red + 0.7152 + 0.0722 * blue); // Rec.709
        colors.push_back({red * green, green, blue * green});
    }
    return colors;
}

double mean_over(const std::vector<Color>& colors, const std::function<double(const Color&)>& of) {
    double sum = 0;
    for (const Color& color : colors)
        sum += of(color);
    return sum / double(colors.size());
}

// Frames that are nearly black have the value of the frame before.
void hold(Values& series, const std::vector<bool>& is_enough) {
    const auto first = std::find(is_enough.begin(), is_enough.end(), true);
    if (first == is_enough.end())
        return;
    double held = series[size_t(first - is_enough.begin())];
    for (size_t i = 0; i < series.size(); ++i) {
        if (is_enough[i])
            held = series[i];
        series[i] = held;
    }
}

// Of each frame, means over its cells.
struct ColorSeries {
    Values light, red, blue, saturation;
};

ColorSeries series_of(const Frames& frames) {
    constexpr double relative_floor = 0.02, dark = 0.05;
    Values means;
    for (const QcFrame* frame : frames)
        means.push_back(mean_over(colors_of(frame->facts.picture),
                                  [](const Color& c) { return (c.red + c.green + c.blue) / 3; }));
    const double usual = median(means);
    const double floor = relative_floor * usual + 1e-9; // so that noise in the dark is small
    ColorSeries series;
    for (const QcFrame* frame : frames) {
        const std::vector<Color> colors = colors_of(frame->facts.picture);
        series.light.push_back(mean_over(colors, [=](const Color& c) {
            return std::log2(0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue + floor);
        }));
        series.red.push_back(mean_over(colors, [=](const Color& c) {
            return std::log2((c.red + floor) / (c.green + floor));
        }));
        series.blue.push_back(mean_over(colors, [=](const Color& c) {
            return std::log2((c.blue + floor) / (c.green + floor));
        }));
        series.saturation.push_back(mean_over(colors, [=](const Color& c) {
            const auto [least, most] = std::minmax({c.red, c.green, c.blue});
            return (most - least) / (most + floor);
        }));
    }
    std::vector<bool> is_enough; // the colour of what is nearly black is none
    for (const double mean : means)
        is_enough.push_back(mean > dark * usual);
    for (Values* one : {&series.red, &series.blue, &series.saturation})
        hold(*one, is_enough);
    return series;
}

using Find = std::function<void(const Statistic& statistic, const Values& series)>;

// Where the light changes, the rest of the colours does not matter.
void find_colors(const Frames& frames, std::vector<bool>& breaks, const Find& find) {
    const ColorSeries series = series_of(frames);
    find({"light", 0.25 / 0.06, "brighter", "darker", " stops"}, series.light);
    for (size_t i = 0; i < frames.size(); ++i)
        breaks[i] = breaks[i] || frames[i]->changed;
    find({"tint", 2, "more red over green", "less red over green", " stops"}, series.red);
    find({"tint", 2, "more blue over green", "less blue over green", " stops"}, series.blue);
    find({"saturation", 4, "more saturated", "less saturated", " of 1"}, series.saturation);
}

void find_detail(const Frames& frames, const Find& find) {
    Values noise, sharpness, blur;
    for (const QcFrame* frame : frames) {
        const QcPicture& picture = frame->facts.picture;
        if (std::min({picture.fine, picture.coarse, picture.across, picture.down}) <= 0)
            return; // flat graphics have no noise
        noise.push_back(std::log2(picture.fine));
        sharpness.push_back(std::log2(picture.fine / picture.coarse));
        blur.push_back(std::log2(picture.across / picture.down));
    }
    find({"noise", 0.5 / 0.35, "noisier", "less noisy", ""}, noise);
    find({"sharpness", 0.35 / 0.25, "sharper", "softer", ""}, sharpness);
    find({"blur", 1.5, "more blurred down", "more blurred across", ""}, blur);
}

void find_alpha_levels(const Frames& frames, const Find& find) {
    Values alpha;
    for (const QcFrame* frame : frames) {
        const QcPicture& picture = frame->facts.picture;
        if (!has_alpha(picture))
            return;
        alpha.push_back(picture.alpha_mean);
    }
    find({"alphalevel", 2.5, "more opaque", "less opaque", " of 1"}, alpha);
}

// Of layers that are never black; those that are have rules of their own.
void find_layer_lights(const Frames& frames, const Find& find) {
    constexpr double black = 1e-5;
    for (const QcLayer& like : frames.front()->facts.layers) {
        if (like.kind != "light" && like.kind != "color")
            continue;
        Values light;
        for (const QcFrame* frame : frames) {
            const QcLayer* layer = find_layer(frame->facts, like.name);
            const double mean = layer ? std::abs(layer->mean) : 0;
            if (mean > black)
                light.push_back(std::log2(mean));
        }
        if (light.size() == frames.size())
            find({"layerlight", 0.3 / 0.25, "brighter", "darker", " stops", &like}, light);
    }
}

} // namespace

void find_odd_statistics(QcShot& shot) {
    const Frames frames = shot.pictures();
    if (frames.size() < kEnoughFrames)
        return;
    std::vector<bool> breaks = breaks_of(frames);
    const Find find = [&](const Statistic& statistic, const Values& series) {
        ScalarSearch(shot, frames, breaks, statistic, series).find();
    };
    find_colors(frames, breaks, find);
    find_detail(frames, find);
    find_alpha_levels(frames, find);
    find_layer_lights(frames, find);
}

} // namespace tonetool::sequence
