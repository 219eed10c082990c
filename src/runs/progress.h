// SPDX-License-Identifier: BSD-3-Clause
// What a person sees while frames run.
#pragma once

#include <OpenImageIO/timer.h>
#include <ostream>
#include <streambuf>
#include <string>

#include "runs/frames.h"

namespace tonetool::runs {

/// Frames done, rate and time left: a line on a terminal, or a line for each frame.
class Progress {
public:
    Progress(std::ostream& stream, const FramePlan& plan);
    /// With the status in words, for -v.
    void done(const FrameRun& run, int status, const std::string& words, double seconds);
    /// There is a line on a terminal that is written over again and again.
    bool on_terminal() const { return m_terminal; }
    /// Takes that line off the screen, for what is printed next.
    void clear();

private:
    void draw(const std::string& text);

    std::ostream& m_stream;
    bool m_json, m_terminal, m_verbose, m_drawn = false;
    size_t m_total;
    const char* m_noun; ///< "frames" or "cases"
    size_t m_done = 0;
    OIIO::Timer m_time;
};

/// While this lives, the stream takes the progress line off the screen before it prints.
class ClearingStream final : std::streambuf {
public:
    ClearingStream(std::ostream& stream, Progress& progress)
        : m_stream(stream),
          m_progress(progress),
          m_to(stream.rdbuf()) {
        if (progress.on_terminal())
            exchange(this);
    }
    ~ClearingStream() override {
        if (m_progress.on_terminal())
            exchange(m_to);
    }
    ClearingStream(const ClearingStream&) = delete;
    ClearingStream& operator=(const ClearingStream&) = delete;

private:
    // A write that has failed stays known, which rdbuf() alone forgets.
    void exchange(std::streambuf* buffer) {
        const std::ios_base::iostate state = m_stream.rdstate();
        m_stream.rdbuf(buffer);
        m_stream.setstate(state);
    }
    int_type overflow(int_type c) override {
        m_progress.clear();
        return m_to->sputc(traits_type::to_char_type(c));
    }
    std::streamsize xsputn(const char* text, std::streamsize size) override {
        m_progress.clear();
        return m_to->sputn(text, size);
    }
    int sync() override { return m_to->pubsync(); }

    std::ostream& m_stream;
    Progress& m_progress;
    std::streambuf* m_to;
};

} // namespace tonetool::runs
