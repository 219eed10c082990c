// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/compare/quantities.h"

#include <OpenImageIO/strutil.h>
#include <cmath>
#include <optional>

#include "metrics/refusal.h"
#include "tonetool/flip.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

struct Quantity {
    const char* name;
    double FlipPool::*value;
};

constexpr Quantity kQuantities[] = {{"mean", &FlipPool::mean},
                                    {"weighted-median", &FlipPool::weighted_median},
                                    {"weighted-q1", &FlipPool::weighted_q1},
                                    {"weighted-q3", &FlipPool::weighted_q3},
                                    {"p50", &FlipPool::p50},
                                    {"p95", &FlipPool::p95},
                                    {"p99", &FlipPool::p99},
                                    {"p99.9", &FlipPool::p999},
                                    {"min", &FlipPool::min},
                                    {"max", &FlipPool::max}};

const Quantity* usual(const std::string& name) {
    for (const Quantity& q : kQuantities)
        if (name == q.name)
            return &q;
    return nullptr;
}

// "99.95" of "p99.95" where `start` is "p": digits and a point, or a small number with an exponent.
std::optional<double> number_after(const std::string& start, const std::string& name) {
    const std::string rest = name.size() > start.size() ? name.substr(start.size()) : "";
    if (name.compare(0, start.size(), start) != 0 || rest.empty() || rest[0] < '0' ||
        rest[0] > '9' || rest.find_first_not_of("0123456789.e-") != std::string::npos ||
        !OIIO::Strutil::string_is_float(rest))
        return std::nullopt;
    return OIIO::Strutil::stod(rest);
}

std::optional<double> percentile(const std::string& name) {
    const auto percent = number_after("p", name);
    return percent && *percent <= 100 ? percent : std::nullopt;
}

std::optional<double> error_above(const std::string& name) {
    const auto error = number_after("above", name);
    return error && std::isfinite(*error) ? error : std::nullopt;
}

std::string percentile_name(double percent) {
    return format("p{}", percent);
}

std::string above_name(double error) {
    return format("above{}", error);
}

} // namespace

void plan_pool(const std::vector<std::string>& names, metrics::PoolRequest& request) {
    constexpr size_t most = 32;
    if (names.size() > most)
        throw Refusal(format("{} quantities; valid: at most {}", names.size(), most));
    for (const std::string& name : names) {
        const auto known = ToneAlgo::flip_quantity_name(name);
        if (!known)
            throw Refusal(
                format("unknown quantity \"{}\"; valid: {}, pNN (a percentile, 0 to 100), aboveE "
                       "(the share of the pixels above the error E)",
                       name, OIIO::Strutil::join(ToneAlgo::flip_quantities(), ", ")));
        if (usual(*known))
            continue;
        const auto percent = percentile(*known);
        (percent ? request.percentiles : request.above)
            .push_back(percent ? *percent : *error_above(*known));
    }
}

void name_further(const metrics::PoolRequest& request, FlipPool& pool) {
    for (size_t i = 0; i < request.percentiles.size(); ++i)
        pool.further[percentile_name(request.percentiles[i])] = request.found_percentiles[i];
    for (size_t i = 0; i < request.above.size(); ++i)
        pool.further[above_name(request.above[i])] = request.found_above[i];
}

namespace ToneAlgo {

std::optional<double> flip_quantity(const FlipPool& pool, const std::string& name) {
    const auto known = flip_quantity_name(name);
    if (const Quantity* q = known ? usual(*known) : nullptr)
        return pool.*q->value;
    const auto found = known ? pool.further.find(*known) : pool.further.end();
    return found == pool.further.end() ? std::nullopt : std::optional<double>(found->second);
}

std::vector<std::string> flip_quantities() {
    std::vector<std::string> names;
    for (const Quantity& q : kQuantities)
        names.emplace_back(q.name);
    return names;
}

std::optional<std::string> flip_quantity_name(const std::string& name) {
    if (usual(name))
        return name;
    if (const auto percent = percentile(name))
        return percentile_name(*percent);
    if (const auto error = error_above(name))
        return above_name(*error);
    return std::nullopt;
}

} // namespace ToneAlgo
} // namespace tonetool
