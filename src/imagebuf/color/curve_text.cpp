// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/color/curve_text.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <charconv>
#include <cmath>

#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// More than the largest table needs, and little enough to be held as words.
constexpr uint64_t kMostCurveBytes = uint64_t{16} << 20;
constexpr size_t kMostCurveLines = size_t{1} << 19, kLongestCurveLine = size_t{2} << 20;

// Long lines of a file that is none of ours are not repeated whole.
std::string quoted(const std::string& text) {
    constexpr size_t most = 40;
    return '"' + (text.size() > most ? text.substr(0, most) + "..." : text) + '"';
}

std::string text_of(const std::string& file) {
    namespace fs = OIIO::Filesystem;
    if (!fs::is_regular(file))
        throw Refusal(format("curve \"{}\": {}", file,
                             fs::exists(file) ? "is not a file" : "there is no such file"));
    if (fs::file_size(file) > kMostCurveBytes)
        throw Refusal(format("curve \"{}\" has {} bytes: must be at most {}", file,
                             fs::file_size(file), kMostCurveBytes));
    std::string text;
    if (!fs::read_text_file(file, text))
        throw Refusal(format("curve \"{}\": cannot be read", file));
    if (text.find('\0') != std::string::npos)
        throw Refusal(format("curve \"{}\" is not text: byte {} is 0", file, text.find('\0') + 1));
    if (OIIO::Strutil::starts_with(text, "\xef\xbb\xbf"))
        text.erase(0, 3);
    return text;
}

} // namespace

std::optional<double> number_in_curve(const std::string& word) {
    const char *begin = word.data(), *end = begin + word.size();
    double value = 0;
    const auto [at, problem] =
        std::from_chars(begin + (word.size() > 1 && word[0] == '+'), end, value);
    if (at != end || begin == end)
        return std::nullopt;
    // What is too small for a double is 0, what is too large is not finite.
    if (problem == std::errc::result_out_of_range)
        return std::strtod(word.c_str(), nullptr);
    return problem == std::errc() ? std::optional(value) : std::nullopt;
}

CurveText::CurveText(const std::string& file) : m_file(file) {
    const std::string text = text_of(file);
    for (size_t at = 0; at < text.size();) {
        const size_t end = std::min(text.find_first_of("\r\n", at), text.size());
        if (m_lines.size() == kMostCurveLines)
            fail(format("has more than {} lines", kMostCurveLines));
        if (end - at > kLongestCurveLine)
            fail(m_lines.size(),
                 format("has {} bytes: must be at most {}", end - at, kLongestCurveLine));
        m_lines.emplace_back(OIIO::Strutil::strip(text.substr(at, end - at)));
        at = end + (text.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    }
}

std::vector<std::string> CurveText::words(size_t i) const {
    return OIIO::Strutil::splits(line(i));
}

std::vector<std::string> CurveText::cells(size_t i) const {
    std::vector<std::string> cells;
    for (const auto& cell : OIIO::Strutil::splitsv(line(i), ","))
        cells.emplace_back(OIIO::Strutil::strip(cell));
    return cells;
}

void CurveText::fail(const std::string& why) const {
    throw Refusal(format("curve \"{}\": {}", m_file, why));
}

void CurveText::fail(size_t i, const std::string& why) const {
    throw Refusal(format("curve \"{}\" line {}: {}", m_file, i + 1, why));
}

double CurveText::number(size_t i, const std::string& word) const {
    constexpr double most = 1e9;
    const auto value = number_in_curve(word);
    if (!value)
        fail(i, quoted(word) + " is not a number");
    if (!(std::abs(*value) <= most))
        fail(i, quoted(word) + " cannot be in a curve (valid: -1e9 to 1e9)");
    return *value;
}

std::vector<double> CurveText::numbers(size_t i, const std::vector<std::string>& words,
                                       size_t first, size_t count) const {
    if (words.size() != first + count)
        fail(i, format("{} has {} number(s): must be {}", quoted(line(i)),
                       words.size() - std::min(first, words.size()), count));
    std::vector<double> values;
    for (size_t k = first; k < words.size(); ++k)
        values.push_back(number(i, words[k]));
    return values;
}

size_t CurveText::rows(size_t i, const std::string& word) const {
    const auto value = number_in_curve(word);
    if (!value || !(*value >= double(kLeastCurveRows) && *value <= double(kMostCurveRows)) ||
        *value != std::floor(*value))
        fail(i, format("the number of rows is {}: must be {} to {}", quoted(word), kLeastCurveRows,
                       kMostCurveRows));
    return size_t(*value);
}

void CurveText::check_rows(size_t count) const {
    if (count < kLeastCurveRows || count > kMostCurveRows)
        fail(format("has {} row(s): must be {} to {}", count, kLeastCurveRows, kMostCurveRows));
}

void CurveText::check_rising(size_t i, double before, double x) const {
    if (!(x > before))
        fail(i, format("x is {} behind {}: must be strictly rising", x, before));
}

} // namespace tonetool
