// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/frames/frame_range.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

namespace tonetool::sequence {

namespace {

constexpr char kValidRanges[] =
    " (valid: 1-10, 1,3,5-9, 1-10x2 for every second, 1-10y2 for the others)";

struct Range {
    long long first = 0, last = 0, step = 1;
    bool complement = false; ///< the numbers that the steps leave out

    long long count() const { return std::abs(last - first) / (complement ? 1 : std::abs(step)); }
};

class Reader {
public:
    Reader(const std::string& text, bool lenient) : m_text(text), m_lenient(lenient) {}

    std::vector<Range> all() {
        std::vector<Range> ranges{one()};
        while (take(','))
            ranges.push_back(one());
        if (m_at < m_text.size())
            refuse(", \"" + m_text.substr(m_at) + "\" is left over");
        return ranges;
    }

private:
    [[noreturn]] void refuse(const std::string& why) const {
        throw std::runtime_error("no frame range: \"" + m_text + "\"" + why + kValidRanges);
    }
    void skip_spaces() {
        while (m_at < m_text.size() && m_text[m_at] == ' ')
            ++m_at;
    }
    bool take(char wanted) {
        skip_spaces();
        const bool there = m_at < m_text.size() && m_text[m_at] == wanted;
        m_at += there ? 1 : 0;
        return there;
    }
    int number() {
        skip_spaces();
        int value = 1;
        const char* begin = m_text.data() + m_at;
        const auto [end, problem] = std::from_chars(begin, m_text.data() + m_text.size(), value);
        if (problem != std::errc() && !m_lenient) {
            refuse(problem == std::errc::result_out_of_range ? ", a number is beyond 2147483647"
                                                             : "");
        }
        m_at += size_t(end - begin);
        skip_spaces();
        return value;
    }
    Range one() {
        Range range = numbers();
        if (m_lenient) // oiiotool ignores the rest
            m_at = std::min(m_text.find(',', m_at), m_text.size());
        return range;
    }
    Range numbers() {
        Range range;
        range.first = range.last = number();
        if (!take('-'))
            return range;
        range.last = number();
        range.complement = take('y');
        if (range.complement || take('x')) {
            range.step = number();
            if (range.step == 0 && !m_lenient)
                refuse(", the step is 0");
            range.step = range.step == 0 ? 1 : range.step;
        }
        if (range.step < 0 && range.first < range.last) // backwards from the end, as oiiotool
            std::swap(range.first, range.last);
        range.step = range.first > range.last ? -std::abs(range.step) : std::abs(range.step);
        return range;
    }

    const std::string& m_text;
    bool m_lenient;
    size_t m_at = 0;
};

void enumerate(const Range& range, std::vector<int>& frames) {
    const long long direction = range.step < 0 ? -1 : 1;
    const long long step = range.complement ? direction : range.step;
    for (long long n = range.first; (range.last - n) * direction >= 0; n += step)
        if (!range.complement || (n - range.first) % range.step != 0)
            frames.push_back(int(n));
}

} // namespace

std::vector<int> parse_frames(const std::string& range, bool lenient) {
    const std::vector<Range> ranges = Reader(range, lenient).all();
    long long count = 0;
    for (const Range& one : ranges)
        count += one.count() + 1;
    if (count > kMostFrames) {
        throw std::runtime_error("the frame range \"" + range + "\" has " + std::to_string(count) +
                                 " frames (valid: at most " + std::to_string(kMostFrames) + ")");
    }
    std::vector<int> frames;
    for (const Range& one : ranges)
        enumerate(one, frames);
    if (frames.empty())
        throw std::runtime_error("the frame range \"" + range + "\" has no frame");
    return frames;
}

std::string range_text(const std::vector<int>& numbers) {
    std::string text;
    size_t end = 0;
    for (size_t begin = 0; begin < numbers.size(); begin = end) {
        for (end = begin + 1; end < numbers.size() && numbers[end] == numbers[end - 1] + 1;)
            ++end;
        text += (text.empty() ? "" : ",") + std::to_string(numbers[begin]) +
                (end > begin + 1 ? "-" + std::to_string(numbers[end - 1]) : "");
    }
    return text;
}

} // namespace tonetool::sequence
