// The one way a public function fails: no exception leaves it, dst carries the reason.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <exception>
#include <new>
#include <string>

namespace tonetool {

/// Runs `run(error)`, which returns whether it succeeded; every exception becomes an error.
template <class Run>
bool contained(std::string& error, const Run& run) noexcept {
    try {
        error.clear();
        if (run(error))
            return true;
        if (error.empty())
            error = "failed without a reason";
    } catch (const std::bad_alloc&) {
        error = "not enough memory";
    } catch (const std::exception& e) {
        error = e.what();
    } catch (...) {
        error = "unknown exception";
    }
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
