// Errors of single pixels; include/tonetool/errors.h says what each is and where it comes from.
#pragma once

#include <cstdint>
#include <vector>

namespace tonetool::metrics {

enum class ErrorKind { Absolute, Squared, RelativeAbsolute, RelativeSquared, Symmetric, Exposed };

struct PixelError {
    ErrorKind kind = ErrorKind::Absolute;
    double eps = 0;

    /// Errors are at most 1.
    bool bounded() const { return kind == ErrorKind::Symmetric || kind == ErrorKind::Exposed; }
};

/// The error of `count` pixels of linear Rec.709, finite and >= 0. `stops` are the exposures of
/// ErrorKind::Exposed; the other kinds do not look at them. Where the pixels are equal it is 0.
void error_row(const PixelError& error, const std::vector<double>& stops,
               const float* const reference[3], const float* const test[3], float* out,
               int64_t count);

} // namespace tonetool::metrics
