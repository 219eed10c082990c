// SPDX-License-Identifier: BSD-3-Clause
// Camera responses in the two forms of M. Grossberg and S. Nayar, Modeling the Space of Camera
// Response Functions, 2004: a database (DoRF), and a model of a mean and base functions (EMoR).
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <map>

#include "imagebuf/color/curve_text.h"
#include "imagebuf/pixels/names.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;
using tonemap::MeasuredRows;
using Strings = std::vector<std::string>;

// Where the six lines of a curve are.
struct Response {
    std::string name;
    size_t input = 0, output = 0; ///< the lines of the values
};

bool is_title(const std::string& line, const std::string& name) {
    return OIIO::Strutil::replace(line, " ", "", true) == name + "=";
}

std::vector<size_t> filled_lines(const CurveText& text) {
    std::vector<size_t> lines;
    for (size_t i = 0; i < text.count(); ++i)
        if (!text.empty(i))
            lines.push_back(i);
    return lines;
}

std::vector<Response> responses_in(const CurveText& text) {
    constexpr size_t each = 6;
    const auto lines = filled_lines(text);
    std::vector<Response> all;
    for (size_t at = 0; at < lines.size(); at += each) {
        if (lines.size() - at < each)
            text.fail(lines[at], format("\"{}\" has {} line(s): must be name, type, \"I =\", its "
                                        "values, \"B =\", its values",
                                        text.line(lines[at]), lines.size() - at));
        for (const auto& [offset, title] : {std::pair<size_t, const char*>(2, "I"), {4, "B"}})
            if (!is_title(text.line(lines[at + offset]), title))
                text.fail(lines[at + offset], format("must be \"{} =\" of the curve \"{}\"", title,
                                                     text.line(lines[at])));
        all.push_back({text.line(lines[at]), lines[at + 3], lines[at + 5]});
    }
    return all;
}

const Response* named(const std::vector<Response>& all, const std::string& name) {
    const auto at = std::find_if(all.begin(), all.end(), [&](const Response& one) {
        return OIIO::Strutil::iequals(one.name, name);
    });
    return at == all.end() ? nullptr : &*at;
}

// R, G and B of a name; none where one of them lacks.
std::vector<const Response*> channels_named(const std::vector<Response>& all,
                                            const std::string& name) {
    for (const char* between : {"", "-", "_"}) {
        std::vector<const Response*> found;
        for (const char* color : {"Red", "Green", "Blue"})
            if (const Response* one = named(all, name + between + color))
                found.push_back(one);
        if (found.size() == 3)
            return found;
    }
    return {};
}

// What curvename= may be: names of curves, and of what has a curve for each of R, G and B.
Strings names_in(const std::vector<Response>& all) {
    Strings names;
    for (const Response& one : all) {
        std::string stem = one.name;
        if (OIIO::Strutil::iends_with(stem, "red"))
            stem.resize(stem.size() - 3);
        while (!stem.empty() && (stem.back() == '-' || stem.back() == '_'))
            stem.pop_back();
        if (stem != one.name && !channels_named(all, stem).empty())
            names.push_back(stem);
        names.push_back(one.name);
    }
    return names;
}

std::vector<const Response*> chosen(const CurveText& text, const std::vector<Response>& all,
                                    std::string name) {
    const Strings names = names_in(all);
    if (name.empty() && (all.size() == 1 || (all.size() == 3 && names.size() == 4)))
        name = names.front();
    if (name.empty())
        text.fail(format("has {} curves: needs curvename= (valid: {})", all.size(),
                         OIIO::Strutil::join(names, ", ")));
    if (const Response* one = named(all, name))
        return {one};
    auto found = channels_named(all, name);
    if (found.empty())
        text.fail(unknown_name("curvename", name, names));
    return found;
}

std::vector<double> values_of_line(const CurveText& text, size_t i) {
    const auto words = text.words(i);
    auto values = text.numbers(i, words, 0, words.size());
    text.check_rows(values.size());
    return values;
}

// The sections of a model: values behind each title.
using Sections = std::map<std::string, std::vector<double>>;

Sections sections_of(const CurveText& text) {
    Sections all;
    std::string title;
    for (size_t i : filled_lines(text)) {
        const std::string& line = text.line(i);
        const size_t equals = line.find('=');
        if (equals != std::string::npos) {
            title = OIIO::Strutil::replace(line.substr(0, equals), " ", "", true);
            if (!all.emplace(title, std::vector<double>()).second)
                text.fail(i, "\"" + title + " =\" is there already");
        } else if (title.empty()) {
            text.fail(i, "values without a title (valid: E =, f0 =, h(1)=, h(2)=, ...)");
        }
        for (const std::string& word :
             OIIO::Strutil::splits(equals == std::string::npos ? line : line.substr(equals + 1)))
            all[title].push_back(text.number(i, word));
        if (!title.empty() && all[title].size() > kMostCurveRows)
            text.fail(i, format("has more than {} values", kMostCurveRows));
    }
    return all;
}

const std::vector<double>& section(const CurveText& text, const Sections& all,
                                   const std::string& title, size_t count) {
    const auto found = all.find(title);
    if (found == all.end())
        text.fail("has no \"" + title + " =\"");
    if (count > 0 && found->second.size() != count)
        text.fail(format("has {} values of {}, but {} of E", found->second.size(), title, count));
    return found->second;
}

} // namespace

bool holds_responses(const CurveText& text) {
    const auto lines = filled_lines(text);
    return lines.size() > 2 && is_title(text.line(lines[2]), "I");
}

bool holds_model(const CurveText& text) {
    const auto lines = filled_lines(text);
    if (lines.empty())
        return false;
    const std::string& line = text.line(lines[0]);
    return is_title(line.substr(0, line.find('=') + 1), "E");
}

MeasuredRows read_responses(const CurveText& text, const std::string& name) {
    const auto all = responses_in(text);
    MeasuredRows out;
    for (const Response* one : chosen(text, all, name)) {
        const auto x = values_of_line(text, one->input);
        out.y.push_back(values_of_line(text, one->output));
        if (out.y.back().size() != x.size())
            text.fail(one->output, format("\"{}\" has {} values of B, but {} of I", one->name,
                                          out.y.back().size(), x.size()));
        for (size_t i = 1; i < x.size(); ++i)
            text.check_rising(one->input, x[i - 1], x[i]);
        if (!out.x.empty() && out.x != x)
            text.fail(one->input, "\"" + one->name + "\" has another I than its red");
        out.x = x;
    }
    return out;
}

MeasuredRows read_model(const CurveText& text, const std::vector<double>& weights) {
    const Sections all = sections_of(text);
    MeasuredRows out;
    out.x = section(text, all, "E", 0);
    text.check_rows(out.x.size());
    for (size_t i = 1; i < out.x.size(); ++i)
        if (!(out.x[i] > out.x[i - 1]))
            text.fail(format("E is {} behind {}: must be strictly rising", out.x[i], out.x[i - 1]));
    std::vector<double> y = section(text, all, "f0", out.x.size());
    size_t bases = 0;
    while (all.count(format("h({})", bases + 1)))
        ++bases;
    if (weights.size() > bases)
        text.fail(
            format("has {} base function(s), but coeffs= has {} numbers", bases, weights.size()));
    for (size_t k = 0; k < weights.size(); ++k) {
        const std::string name = format("h({})", k + 1);
        const auto& base = section(text, all, name, out.x.size());
        for (size_t i = 0; i < y.size(); ++i)
            y[i] += weights[k] * base[i];
    }
    out.y = {y};
    return out;
}

} // namespace tonetool
