// SPDX-License-Identifier: BSD-3-Clause
// Images as evaluate() takes them: files, arrays and ImageBufs, with the colour that its arguments
// say they have.
#pragma once

#include <memory>
#include <string>

#include "python/images.h"

namespace tonetool::python {

enum class Encoding {
    Scene,  ///< scene light: floats
    Srgb,   ///< 0 to 1, sRGB-encoded; files and ImageBufs as they say
    Linear, ///< 0 to 1, linear; so are the integers of files and ImageBufs
};

class EvaluatedImage {
public:
    EvaluatedImage(const py::object& object, const std::string& where, Encoding encoding);

    const OIIO::ImageBuf& buf() const { return m_own.initialized() ? m_own : m_given->buf(); }
    /// What a user must know of it; empty: nothing.
    const std::string& warning() const { return m_warning; }

private:
    void open(const std::string& path, const std::string& where);
    void check_range(const std::string& where);
    void tag(const char* space);

    std::unique_ptr<InputImage> m_given; ///< null: it is a file
    std::shared_ptr<void> m_cache;       ///< of the file's header
    OIIO::ImageBuf m_own;                ///< the file, or what was given with another header
    std::string m_warning;
};

/// A UserWarning.
void warn(const std::string& text);

} // namespace tonetool::python
