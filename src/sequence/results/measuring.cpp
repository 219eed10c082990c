// SPDX-License-Identifier: BSD-3-Clause
#include "sequence/results/measuring.h"

#include "metrics/errors.h"
#include "tonetool/tonetool.h"

namespace tonetool::sequence {

std::string MeasuringCommand::first_quantity(const std::string& metric) const {
    if (quantity)
        return quantity;
    return scoring == Scoring::Error   ? metric
           : scoring == Scoring::Index ? ToneAlgo::tmqi_quantities().front()
                                       : ToneAlgo::flip_quantities().front();
}

const MeasuringCommand* measuring_command(const std::string& name) {
    for (const MeasuringCommand& command : kMeasuringCommands)
        if (name == command.name)
            return &command;
    return nullptr;
}

bool higher_is_better(const std::string& command, const std::string& quantity) {
    const MeasuringCommand* known = measuring_command(command);
    const metrics::ErrorMetric* metric = metrics::find_error_metric(quantity);
    return known &&
           (known->scoring == Scoring::Index ||
            (known->scoring == Scoring::Error && metric && metric->has(metrics::kDecibels)));
}

} // namespace tonetool::sequence
