// SPDX-License-Identifier: BSD-3-Clause
// The one way a public function fails: inside, everything throws; no exception leaves it, dst
// carries the reason.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <exception>
#include <new>
#include <stdexcept>
#include <string>

#include "imagebuf/pixels/allocation.h"
#include "imagebuf/pixels/utf8.h"
#include "metrics/refusal.h"

namespace tonetool {

/// Whether `run()` came to its end: what it refuses, and every other exception, becomes an error of
/// UTF-8.
template <class Run>
bool contained(std::string& error, const Run& run) noexcept {
    error.clear();
    try {
        run();
        return true;
    } catch (const std::bad_alloc& e) {
        error = memory_text(e);
    } catch (const std::length_error&) { // a size that no vector or string can have
        error = "not enough memory";
    } catch (const std::exception& e) {
        error = valid_utf8(e.what());
    } catch (...) {
        error = "unknown exception";
    }
    if (error.empty())
        error = "failed without a reason";
    return false;
}

/// The same for a function with a destination: on failure it holds no pixels but "function: why".
template <class Run>
bool guarded(OIIO::ImageBuf& dst, const char* function, const Run& run) {
    std::string error;
    if (contained(error, run))
        return true;
    dst.clear();
    dst.errorfmt("{}: {}", function, error);
    return false;
}

} // namespace tonetool
