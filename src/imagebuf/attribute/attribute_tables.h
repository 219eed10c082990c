// SPDX-License-Identifier: BSD-3-Clause
// The tables of attribute(), one after the other.
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "imagebuf/attribute/attribute_input.h"

namespace tonetool {

/// The errors of other tests than the one that came, by the metric of the options.
class ErrorMeter {
public:
    /// `held`: bytes that are not to be had.
    ErrorMeter(const AttributeInput& input, const AttributeOptions& options, uint64_t held,
               int nthreads)
        : m_input(input),
          m_options(options),
          m_held(held),
          m_nthreads(nthreads) {}

    /// Makes a test: R, G, B of each pixel, linear Rec.709.
    using Maker = std::function<void(std::vector<float>& rgb)>;
    /// The mean error of each, all against the reference, which is prepared once for as many tests
    /// as fit into memory.
    std::vector<double> means(const std::vector<Maker>& tests);
    /// The map of the test as it came.
    std::vector<float> map();

private:
    std::vector<double> run(const std::vector<Maker>& tests, std::vector<OIIO::ImageBuf>& maps);

    const AttributeInput& m_input;
    const AttributeOptions& m_options;
    uint64_t m_held;
    int m_nthreads;
};

/// The picture of a side with the other side's light in these groups, by index; behind the last of
/// them is the rest.
void exchange_lights(const AttributeInput& input, size_t side, const std::vector<size_t>& groups,
                     std::vector<float>& rgb);

/// Lights, and the test with the reference's light in every group that has a finding.
struct ExchangedLights {
    std::vector<AttributedLight> lights;
    std::vector<float> test;
};
ExchangedLights attribute_lights(const AttributeInput& input, ErrorMeter& meter, double mean,
                                 bool alone);

/// `error` and `test`: of each pixel, and its R, G, B.
std::vector<AttributedType> attribute_mattes(const AttributeInput& input,
                                             const std::vector<float>& error,
                                             const std::vector<float>& test,
                                             std::vector<std::string>& warnings);

std::vector<AttributedLayer> attribute_layers(const AttributeInput& input);

/// Findings first, each half in the order it has.
template <class Row>
void findings_first(std::vector<Row>& rows) {
    std::stable_partition(rows.begin(), rows.end(),
                          [](const Row& row) { return !row.finding.empty(); });
}

} // namespace tonetool
