// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/tables.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <set>
#include <tuple>

#include "imagebuf/pixels/utf8.h"
#include "sequence/frames/frame_range.h"
#include "sequence/results/attribution.h"
#include "text/printable.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;
using Row = std::map<std::string, std::string>;

std::string text_of(double value) {
    return format("{}", value);
}

// ---- CSV

std::string cell(const std::string& text) {
    const bool formula = !text.empty() && std::strchr("=+-@\t\r", text.front()) != nullptr;
    std::string safe = (formula ? "'" : "") + printable_lines(valid_utf8(text));
    if (safe.find_first_of(",\"\r\n") == std::string::npos)
        return safe;
    return '"' + OIIO::Strutil::replace(safe, "\"", "\"\"", true) + '"';
}

class Columns {
public:
    void put(Row& row, const std::string& name, const std::string& already_a_cell) {
        if (std::find(m_names.begin(), m_names.end(), name) == m_names.end())
            m_names.push_back(name);
        row[name] = already_a_cell;
    }
    const std::vector<std::string>& names() const { return m_names; }

private:
    std::vector<std::string> m_names; ///< in the order of their first use
};

void add_measurements(Columns& columns, Row& row, const FrameResult& frame) {
    std::map<std::string, int> seen;
    for (const Measurement& measured : frame.measurements) {
        const int number = ++seen[measured.command];
        const std::string start =
            measured.command + (number > 1 ? "#" + std::to_string(number) : "") + ".";
        if (number > 1 && measured.test != frame.measurements.front().test)
            columns.put(row, start + "test", cell(measured.test));
        if (!measured.verdict.empty())
            columns.put(row, start + "verdict", cell(measured.verdict));
        for (const Threshold& threshold : measured.thresholds) {
            const auto& limit = threshold.fail ? threshold.fail : threshold.warn;
            const bool first = &threshold == &measured.thresholds.front();
            columns.put(row, start + "threshold" + (first ? "" : "." + threshold.quantity),
                        limit ? text_of(*limit) : "");
        }
        for (const auto& [name, value] : measured.quantities)
            columns.put(row, start + name, text_of(value));
        if (!measured.attribution.empty()) {
            const auto findings = attribution_findings(measured.attribution);
            columns.put(row, start + "findings", cell(OIIO::Strutil::join(findings, "; ")));
        }
    }
}

Row row_of(Columns& columns, const FrameResult& frame, bool named) {
    std::vector<std::string> codes;
    for (const Fault& fault : frame.faults)
        codes.push_back(fault.code);
    Row row;
    if (named) {
        columns.put(row, "name", cell(frame.name));
        columns.put(row, "method", cell(frame.method));
    }
    columns.put(row, "frame", std::to_string(frame.frame));
    columns.put(row, "view", cell(frame.view));
    if (frame.test_frame)
        columns.put(row, "test_frame", std::to_string(*frame.test_frame));
    columns.put(row, "status", status_name(frame.status));
    columns.put(row, "message", cell(frame.message));
    columns.put(row, "reference", cell(frame.reference));
    columns.put(row, "test", cell(frame.test));
    columns.put(row, "faults", cell(OIIO::Strutil::join(codes, ";")));
    add_measurements(columns, row, frame);
    return row;
}

// ---- XML

// XML 1.0 cannot represent most control characters.
std::string escaped(const std::string& text) {
    static const std::map<char, const char*> names = {
        {'<', "&lt;"},   {'>', "&gt;"},  {'&', "&amp;"}, {'"', "&quot;"},
        {'\n', "&#10;"}, {'\t', "&#9;"}, {'\r', "&#13;"}};
    std::string safe;
    for (const char c : valid_utf8(text)) {
        const auto name = names.find(c);
        if (name != names.end()) {
            safe += name->second;
        } else {
            safe += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? "\xEF\xBF\xBD"
                                                                      : std::string(1, c);
        }
    }
    return safe;
}

std::string faults_text(const FrameResult& frame) {
    std::string text;
    for (const Fault& fault : frame.faults)
        text += format("{} {}: {}\n", severity_name(fault.severity), fault.code, fault.sentence);
    return text;
}

// GitLab and Jenkins read each of its lines that is an attachment as a whole.
std::string system_out(const std::vector<std::string>& lines) {
    return lines.empty() ? ""
                         : "<system-out>" + OIIO::Strutil::join(lines, "&#10;") + "</system-out>";
}

std::vector<std::string> attachments(const CaseFiles::Of& images) {
    std::vector<std::string> lines;
    for (const std::string& file : {images.error, images.test, images.reference})
        if (!file.empty())
            lines.push_back("[[ATTACHMENT|" + escaped(file) + "]]");
    return lines;
}

std::string outcome(const FrameResult& frame, const CaseFiles::Of& images) {
    std::vector<std::string> lines = attachments(images);
    const std::string message = escaped(frame.message);
    const std::string name = status_name(frame.status);
    const std::string details = escaped(faults_text(frame));
    if (is_undecided(frame))
        return format("<skipped message=\"{}\"/>", message) + system_out(lines);
    switch (frame.status) {
    case Status::Passed:
        return "";
    case Status::Measured:
        return "<skipped message=\"no threshold was given\"/>";
    case Status::Skipped:
        return format("<skipped message=\"{}\"/>", message);
    case Status::Warning:
        return format("<system-out>warning: {}&#10;{}{}</system-out>", message, details,
                      OIIO::Strutil::join(lines, "&#10;"));
    case Status::Failed:
        return format("<failure type=\"{}\" message=\"{}\">{}</failure>", name, message, details) +
               system_out(lines);
    default:
        return format("<error type=\"{}\" message=\"{}\">{}</error>", name, message, details) +
               system_out(lines);
    }
}

// Of a case the message is in the text, too: a person reads one of them.
std::string outcome_of_case(const FrameResult& frame, const CaseFiles::Of& images) {
    const std::string inside = outcome(frame, images);
    const size_t end = frame.status == Status::Failed ? inside.find("\">") : std::string::npos;
    if (end == std::string::npos)
        return inside;
    std::string text = frame.message + "\n";
    for (const Measurement& measured : frame.measurements)
        for (const std::string& finding : attribution_findings(measured.attribution))
            text += finding + "\n";
    return inside.substr(0, end + 2) + escaped(text) + inside.substr(end + 2);
}

// What a test case is known by, as it stands in XML.
struct CaseName {
    std::string classname, name;
    bool operator<(const CaseName& o) const {
        return std::tie(classname, name) < std::tie(o.classname, o.name);
    }
};

CaseName junit_name(const FrameResult& frame, const std::string& check) {
    if (!frame.item().named()) {
        const std::string file = escaped(frame.test);
        const std::string test =
            frame.test_frame ? format(" (test {:04d})", *frame.test_frame) : "";
        return {file.empty() ? "check" : file,
                format("frame {:04d}{}{}{}", frame.frame, frame.view.empty() ? "" : " ",
                       escaped(frame.view), test)};
    }
    const std::string method = frame.method.empty() ? "" : " [" + frame.method + "]";
    const std::string number = frame.frame == 0 ? "" : format(" frame {:04d}", frame.frame);
    const std::string view = frame.view.empty() ? "" : " " + frame.view;
    return {escaped(check), escaped(frame.name + method + number + view)};
}

std::string test_case(const FrameResult& frame, const CaseName& name, const CaseFiles::Of& images) {
    const bool named = frame.item().named();
    const std::string file = named ? format(" file=\"{}\"", escaped(frame.test)) : "";
    const std::string inside = named ? outcome_of_case(frame, images) : outcome(frame, images);
    return format("  <testcase classname=\"{}\" name=\"{}\"{}", name.classname, name.name, file) +
           (inside.empty() ? "/>\n" : ">" + inside + "</testcase>\n");
}

} // namespace

std::string csv_text(const ShotResult& shot) {
    Columns columns;
    std::vector<Row> rows;
    for (const FrameResult& frame : shot.frames)
        rows.push_back(row_of(columns, frame, is_named(shot)));
    std::string text;
    for (size_t i = 0; i < columns.names().size(); ++i)
        text += (i > 0 ? "," : "") + cell(columns.names()[i]);
    text += "\r\n";
    for (Row& row : rows) {
        for (size_t i = 0; i < columns.names().size(); ++i)
            text += (i > 0 ? "," : "") + row[columns.names()[i]];
        text += "\r\n";
    }
    return text;
}

std::string junit_text(const ShotResult& shot, const CaseFiles& images) {
    std::map<CaseName, int> seen; // names that XML cannot tell apart
    size_t failures = 0, errors = 0, skipped = 0;
    std::string cases;
    for (const FrameResult& frame : shot.frames) {
        failures += frame.status == Status::Failed ? 1 : 0;
        errors += frame.status > Status::Failed ? 1 : 0;
        skipped += frame.status == Status::Measured || frame.status == Status::Skipped ||
                           is_undecided(frame)
                       ? 1
                       : 0;
        CaseName name = junit_name(frame, check_name(shot));
        if (const int before = seen[name]++; before > 0)
            name.name += format(" ({})", before + 1);
        cases += test_case(frame, name, images.find(frame.item()));
    }
    const std::string counts =
        format("name=\"{}\" tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"{}\"",
               shot.suite ? escaped(check_name(shot)) : "tonetool", shot.frames.size(), failures,
               errors, skipped);
    return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites>\n <testsuite " + counts +
           ">\n" + cases + "  <system-out>" + escaped(shot.sentence) +
           "</system-out>\n </testsuite>\n</testsuites>\n";
}

std::string bad_frames_text(const ShotResult& shot, Status from) {
    std::set<int> numbers; // of two views, once
    for (const FrameResult& frame : shot.frames)
        if (frame.status >= from)
            numbers.insert(frame.test_frame.value_or(frame.frame));
    return numbers.empty() ? "" : range_text({numbers.begin(), numbers.end()}) + "\n";
}

} // namespace tonetool::sequence
