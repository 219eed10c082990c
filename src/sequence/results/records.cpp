// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/records.h"

#include <algorithm>

namespace tonetool::sequence {

namespace {

constexpr auto kNowhere = std::string::npos;

bool is_space(char c) {
    return c == ' ' || c == '\n' || c == '\t' || c == '\r';
}

// Behind the quote that ends the string which begins at `at`.
size_t end_of_string(const std::string& text, size_t at) {
    for (++at; at < text.size(); ++at) {
        if (text[at] == '"')
            return at + 1;
        at += text[at] == '\\' ? 1 : 0;
    }
    return kNowhere;
}

size_t behind_spaces(const std::string& text, size_t at) {
    while (at < text.size() && is_space(text[at]))
        ++at;
    return at;
}

// Behind the value that begins at `at`, which is added to `line` without spaces.
size_t take_value(const std::string& text, size_t at, std::string& line) {
    int depth = 0;
    while (at < text.size()) {
        const char c = text[at];
        if (c == '"') {
            const size_t end = end_of_string(text, at);
            if (end == kNowhere)
                return kNowhere;
            line.append(text, at, end - at);
            at = end;
        } else {
            const bool closes = c == '}' || c == ']';
            if (depth == 0 && (closes || c == ','))
                return at;
            depth += c == '{' || c == '[' ? 1 : closes ? -1 : 0;
            if (!is_space(c))
                line += c;
            ++at;
        }
        if (depth == 0 && (line.back() == '}' || line.back() == ']' || line.back() == '"'))
            return at;
    }
    return kNowhere;
}

class RecordTaker {
public:
    explicit RecordTaker(const std::string& text) : m_text(text) {}

    std::optional<WithoutRecords> take() {
        for (size_t at = 0; at < m_text.size();) {
            at = m_text[at] == '"' ? take_string(at) : take_sign(at);
            if (at == kNowhere)
                return std::nullopt;
        }
        if (!m_open.empty())
            return std::nullopt;
        m_found.text.append(m_text, m_copied);
        return std::move(m_found);
    }

private:
    size_t take_string(size_t at) {
        const size_t end = end_of_string(m_text, at);
        if (end == kNowhere)
            return end;
        const size_t colon = behind_spaces(m_text, end);
        if (colon >= m_text.size() || m_text[colon] != ':')
            return end;
        if (m_open == "{")
            m_frames = m_text.compare(at, end - at, "\"frames\"") == 0;
        const bool record =
            m_frames && m_open == "{[{" && m_text.compare(at, end - at, "\"qc\"") == 0;
        return record ? take_record(behind_spaces(m_text, colon + 1)) : colon + 1;
    }

    size_t take_record(size_t at) {
        m_found.text.append(m_text, m_copied, at - m_copied);
        m_found.text += std::to_string(m_found.records.size());
        m_copied = take_value(m_text, at, m_found.records.emplace_back());
        return m_copied;
    }

    size_t take_sign(size_t at) {
        constexpr size_t deepest = 100; // more than a result has outside of its records
        const char c = m_text[at];
        if (c == '{' || c == '[') {
            m_open += c;
        } else if (c == '}' || c == ']') {
            if (m_open.empty() || (m_open.back() == '{') != (c == '}'))
                return kNowhere;
            m_open.pop_back();
        }
        return m_open.size() > deepest ? kNowhere : at + 1;
    }

    const std::string& m_text;
    WithoutRecords m_found;
    std::string m_open;    ///< the brackets that are open
    size_t m_copied = 0;   ///< up to here the text is taken
    bool m_frames = false; ///< the last key of the outermost object is "frames"
};

} // namespace

std::optional<WithoutRecords> without_records(const std::string& text) {
    return RecordTaker(text).take();
}

std::string laid_out(const std::string& line, size_t depth) {
    std::string out;
    out.reserve(line.size() * 5 / 2);
    const auto break_line = [&] { out.append("\n").append(depth, ' '); };
    for (size_t at = 0; at < line.size(); ++at) {
        const char c = line[at];
        const bool opens = c == '{' || c == '[', closes = c == '}' || c == ']';
        if (c == '"') {
            const size_t end = std::min(end_of_string(line, at), line.size());
            out.append(line, at, end - at);
            at = end - 1;
        } else if (opens && at + 1 < line.size() && (line[at + 1] == '}' || line[at + 1] == ']')) {
            out.append(line, at++, 2);
        } else if (!is_space(c)) {
            depth -= closes ? 1 : 0;
            if (closes)
                break_line();
            out += c;
            depth += opens ? 1 : 0;
            if (opens || c == ',')
                break_line();
            if (c == ':')
                out += ' ';
        }
    }
    return out;
}

} // namespace tonetool::sequence
