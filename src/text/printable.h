// SPDX-License-Identifier: BSD-3-Clause
// Text for a terminal: a name from a file must not be taken for an order.
#pragma once

#include <ostream>
#include <streambuf>
#include <string>

namespace tonetool {

/// The text with "\n", "\x1b", "\u202e" in place of control characters and of those that turn the
/// direction of the text around them, in one line.
std::string printable(const std::string& text);

/// The same, but line breaks and tabs stay.
std::string printable_lines(const std::string& text);

/// The same text in JSON: "\u009b" in place of what JSON lets stand in its strings.
std::string printable_json(const std::string& json);

/// What goes through it reaches another buffer as printable_lines(). A "\r" stays where it goes
/// back over nothing: before a line break and at the start of a line or after a flush.
class PrintableBuffer final : public std::streambuf {
public:
    explicit PrintableBuffer(std::streambuf* to) : m_to(to) {}
    /// What has waited for its end is written without it.
    void finish() { put("", true); }

protected:
    int_type overflow(int_type c) override;
    std::streamsize xsputn(const char* text, std::streamsize size) override;
    int sync() override;

private:
    bool put(const std::string& text, bool all);

    std::streambuf* m_to;
    std::string m_rest; ///< the begin of what only the next characters tell
    bool m_at_start = true;
};

/// A stream is printable while this lives.
class PrintableStream {
public:
    explicit PrintableStream(std::ostream& stream)
        : m_stream(stream),
          m_buffer(stream.rdbuf()),
          m_before(stream.rdbuf(&m_buffer)) {}
    ~PrintableStream() {
        m_buffer.finish();
        m_stream.flush();
        m_stream.rdbuf(m_before);
    }
    PrintableStream(const PrintableStream&) = delete;
    PrintableStream& operator=(const PrintableStream&) = delete;

private:
    std::ostream& m_stream;
    PrintableBuffer m_buffer;
    std::streambuf* m_before;
};

} // namespace tonetool
