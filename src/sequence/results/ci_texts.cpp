// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/ci_texts.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <unistd.h>
#include <vector>

#include "imagebuf/pixels/utf8.h"
#include "sequence/results/attribution.h"
#include "sequence/suite/approvable.h"
#include "text/printable.h"

namespace tonetool::sequence {

namespace {

using OIIO::Strutil::fmt::format;

std::string replaced(const std::string& text, const std::map<char, std::string>& by) {
    std::string out;
    for (const char c : text) {
        const auto found = by.find(c);
        out += found == by.end() ? std::string(1, c) : found->second;
    }
    return out;
}

std::string ci_name(const FrameResult& frame) {
    const Item item = frame.item();
    return item.named() ? item_name(item) : item_title(item);
}

// The frames of these statuses, the worst first.
std::vector<const FrameResult*> bad_frames_of(const ShotResult& shot, Status from, Status to) {
    std::vector<const FrameResult*> frames;
    for (const size_t index : shot.worst) {
        const FrameResult& frame = shot.frames.at(index);
        if (frame.status >= from && frame.status <= to)
            frames.push_back(&frame);
    }
    return frames;
}

// What is known beside the message.
std::vector<std::string> findings_of(const FrameResult& frame) {
    std::vector<std::string> sentences;
    for (const Fault& fault : frame.faults)
        if (fault.severity != Severity::Info && fault.sentence != frame.message)
            sentences.push_back(fault.sentence);
    for (const Measurement& measured : frame.measurements)
        for (const std::string& finding : attribution_findings(measured.attribution))
            sentences.push_back(finding);
    return sentences;
}

// ---- annotations

std::string data_of_annotation(const std::string& text) {
    return replaced(printable_lines(valid_utf8(text)),
                    {{'%', "%25"}, {'\r', "%0D"}, {'\n', "%0A"}});
}

std::string property_of_annotation(const std::string& text) {
    return replaced(data_of_annotation(text), {{':', "%3A"}, {',', "%2C"}});
}

// `line`: of the suite's file.
std::string annotation(const char* kind, const ShotResult& shot, int line, const std::string& title,
                       const std::string& message) {
    const std::string place =
        shot.suite ? format("file={},line={},", property_of_annotation(shot.suite->file),
                            line > 0 ? line : shot.suite->test_line)
                   : "";
    return format("::{} {}title={}::{}\n", kind, place, property_of_annotation(title),
                  data_of_annotation(message));
}

std::string annotations(const char* kind, const ShotResult& shot,
                        const std::vector<const FrameResult*>& frames) {
    constexpr size_t most = 10;
    const size_t told = frames.size() <= most ? frames.size() : most - 1;
    std::vector<const FrameResult*> worst(frames.begin(), frames.begin() + std::ptrdiff_t(told));
    std::sort(worst.begin(), worst.end()); // as they are in the list of all
    std::string text;
    for (const FrameResult* one : worst) {
        const FrameResult& frame = *one;
        std::string message = frame.message;
        for (const std::string& sentence : findings_of(frame))
            message += "\n" + sentence;
        text += annotation(
            kind, shot, frame.of_suite.line,
            format("{}: {} {}", check_name(shot), ci_name(frame), status_name(frame.status)),
            message);
    }
    if (told < frames.size())
        text += annotation(kind, shot, 0, check_name(shot),
                           format("and {} more: see the summary", frames.size() - told));
    return text;
}

// ---- the summary

std::string markdown_cell(const std::string& text) {
    return replaced(printable_lines(valid_utf8(text)), {{'\\', "\\\\"},
                                                        {'|', "\\|"},
                                                        {'*', "\\*"},
                                                        {'_', "\\_"},
                                                        {'[', "\\["},
                                                        {']', "\\]"},
                                                        {'`', "\\`"},
                                                        {'<', "&lt;"},
                                                        {'>', "&gt;"},
                                                        {'&', "&amp;"},
                                                        {'\n', " "},
                                                        {'\r', " "}});
}

// The limit that is exceeded most.
const Threshold* exceeded(const Measurement& measured) {
    const Threshold* most = nullptr;
    double worst = 0;
    for (const Threshold& one : measured.thresholds) {
        const auto limit = one.fail ? one.fail : one.warn;
        if (!limit)
            continue;
        const bool holds = one.higher_is_better ? one.value >= *limit : one.value <= *limit;
        const double over = one.higher_is_better ? *limit - one.value : one.value - *limit;
        if (!holds && (!most || over > worst)) {
            most = &one;
            worst = over;
        }
    }
    return most;
}

std::string summary_row(const FrameResult& frame) {
    std::string quantity, value, limit;
    std::vector<std::string> why = findings_of(frame);
    for (const Measurement& measured : frame.measurements) {
        const Threshold* over = measured.verdict.empty() ? exceeded(measured) : nullptr;
        if (!over || !quantity.empty())
            continue;
        quantity = measured.command + " " + over->quantity;
        value = format("{:.4f}", over->value);
        limit = format("{:.6g}", over->fail.value_or(over->warn.value_or(0)));
    }
    if (quantity.empty())
        why.insert(why.begin(), frame.message);
    const auto cell = [](const std::string& text) {
        return text.empty() ? " |" : " " + text + " |";
    };
    return "|" + cell(markdown_cell(ci_name(frame))) + cell(status_name(frame.status)) +
           cell(markdown_cell(quantity)) + cell(value) + cell(limit) +
           cell(markdown_cell(OIIO::Strutil::join(why, "; "))) + "\n";
}

// ---- measurements

std::string xml(const std::string& text) {
    return replaced(
        printable_lines(valid_utf8(text)),
        {{'<', "&lt;"}, {'>', "&gt;"}, {'&', "&amp;"}, {'"', "&quot;"}, {'\n', " "}, {'\r', " "}});
}

std::string number_line(const std::string& name, double value) {
    return format("<CTestMeasurement type=\"numeric/double\" name=\"{}\">{:.6g}"
                  "</CTestMeasurement>\n",
                  xml(name), value);
}

std::string number_lines(const FrameResult& frame, const std::string& start) {
    std::map<std::string, int> seen;
    std::string text;
    for (const Measurement& measured : frame.measurements) {
        const int number = ++seen[measured.command];
        const std::string name =
            start + measured.command + (number > 1 ? "#" + std::to_string(number) : "") + ".";
        for (const Threshold& one : measured.thresholds)
            text += number_line(name + one.quantity, one.value);
        if (measured.thresholds.empty() && !measured.quantities.empty())
            text += number_line(name + measured.quantities.front().first,
                                measured.quantities.front().second);
    }
    return text;
}

std::string verdict_line(const FrameResult& frame, const std::string& start) {
    return format(
        "<CTestMeasurement type=\"text/string\" name=\"{}\">{}</CTestMeasurement>\n",
        xml(start + "verdict"),
        xml(status_name(frame.status) + (frame.message.empty() ? "" : ": " + frame.message)));
}

std::string image_line(const char* name, const std::string& file) {
    return file.empty()
               ? ""
               : format("<CTestMeasurementFile type=\"image/png\" name=\"{}\">{}"
                        "</CTestMeasurementFile>\n",
                        name, xml(std::filesystem::absolute(file).lexically_normal().string()));
}

} // namespace

std::string ctest_text(const ShotResult& shot, const CaseFiles& images) {
    std::string text;
    for (const FrameResult& frame : shot.frames) {
        const std::string start = shot.frames.size() > 1 ? ci_name(frame) + "/" : "";
        text += number_lines(frame, start) + verdict_line(frame, start);
    }
    for (const size_t index : shot.worst) {
        const CaseFiles::Of of = images.find(shot.frames.at(index).item());
        if (of.any()) {
            return text + image_line("TestImage", of.test) +
                   image_line("ValidImage", of.reference) +
                   image_line("DifferenceImage2", of.error);
        }
    }
    return text;
}

std::string github_text(const ShotResult& shot) {
    return annotations("error", shot, bad_frames_of(shot, Status::Failed, Status::Crashed)) +
           annotations("warning", shot, bad_frames_of(shot, Status::Warning, Status::Warning));
}

namespace {

// What is to be approved after a look; empty where nothing can be.
std::string approve_text(const ShotResult& shot, const std::string& json) {
    const std::string command = approve_command(shot, json);
    return command.empty() ? "" : "\nTo approve: `" + printable_lines(valid_utf8(command)) + "`\n";
}

} // namespace

std::string summary_text(const ShotResult& shot, const std::string& json) {
    constexpr size_t most_rows = 200, most_bytes = 900000;
    std::string text =
        format("## {}: {}\n\n{}\n", markdown_cell(check_name(shot)), status_name(shot.verdict),
               markdown_cell(shot.sentence.substr(0, shot.sentence.find("; worst: "))));
    auto frames = bad_frames_of(shot, Status::Warning, Status::Crashed);
    for (const FrameResult& frame : shot.frames)
        if (frame.status == Status::Skipped)
            frames.push_back(&frame);
    if (frames.empty())
        return text;
    text +=
        format("\n| {} | status | quantity | value | limit | why |\n|---|---|---|--:|--:|---|\n",
               is_named(shot) ? "case" : "frame");
    size_t rows = 0;
    for (; rows < std::min(frames.size(), most_rows); ++rows) {
        const std::string row = summary_row(*frames[rows]);
        if (text.size() + row.size() > most_bytes)
            break;
        text += row;
    }
    if (rows < frames.size())
        text += format("\nand {} more\n", frames.size() - rows);
    return text + approve_text(shot, json);
}

void append_text(const std::string& text, const std::string& file) {
    const int to = ::open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    size_t written = 0;
    while (to >= 0 && written < text.size()) {
        const ssize_t count = ::write(to, text.data() + written, text.size() - written);
        if (count < 0 && errno != EINTR)
            break;
        written += count > 0 ? size_t(count) : 0;
    }
    const int failure = errno;
    const bool closed = to >= 0 && ::close(to) == 0;
    if (!closed || written < text.size())
        throw std::runtime_error(format("cannot write \"{}\": {}", file, std::strerror(failure)));
}

} // namespace tonetool::sequence
