// SPDX-License-Identifier: BSD-3-Clause
#include "runs/progress.h"

#include <OpenImageIO/strutil.h>
#include <cstdio>
#include <iostream>
#include <unistd.h>

#include "sequence/results/results_json.h"
#include "text/printable.h"

namespace tonetool::runs {

Progress::Progress(std::ostream& stream, const FramePlan& plan)
    : m_stream(stream),
      m_json(plan.progress == "json"),
      m_terminal(!m_json && plan.loops && &stream == &std::cerr && isatty(STDERR_FILENO) == 1),
      m_verbose(!m_json && plan.loops && plan.verbose && !plan.line.compat),
      m_total(plan.runs.size()),
      m_noun(plan.named ? "cases" : "frames") {}

void Progress::done(const FrameRun& run, int status, const std::string& words, double seconds) {
    ++m_done;
    double elapsed = m_time();
    double rate = elapsed > 0 ? double(m_done) / elapsed : 0;
    double left = rate > 0 ? double(m_total - m_done) / rate : 0;
    if (m_json) {
        const std::string name =
            run.frame.item().named()
                ? "\"case\": " + sequence::json_string(sequence::item_name(run.frame.item())) + ", "
                : "";
        m_stream << OIIO::Strutil::fmt::format(
                        "{{{}\"frame\": {}, \"status\": {}, \"done\": {}, \"total\": {}, "
                        "\"frames_per_second\": {:.4g}, \"seconds_left\": {:.1f}}}",
                        name, run.frame.number, status, m_done, m_total, rate, left)
                 << std::endl;
    } else if (m_verbose) {
        m_stream << OIIO::Strutil::fmt::format("{}: {}, {:.2f} s, {:.0f} s left",
                                               printable(sequence::item_title(run.frame.item())),
                                               words, seconds, left)
                 << std::endl;
    } else if (m_terminal) {
        draw(OIIO::Strutil::fmt::format("{} of {} {}, {:.3g} a second, {:.0f} s left", m_done,
                                        m_total, m_noun, rate, left));
    }
}

// Past the stream, which lets no name go back in its line, and nothing else either.
void Progress::clear() {
    if (m_drawn)
        std::fputs("\r\x1b[K", stderr);
    m_drawn = false;
}

void Progress::draw(const std::string& text) {
    std::cout.flush(); // what came before must not appear behind the line
    clear();
    m_drawn = m_done < m_total;
    if (m_drawn)
        std::fputs(text.c_str(), stderr);
}

} // namespace tonetool::runs
