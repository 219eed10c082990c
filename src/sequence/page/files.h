// SPDX-License-Identifier: BSD-3-Clause
// The parts of the report's page, which the build embeds in the program.
#pragma once

namespace tonetool::sequence::page {

extern const char* const html;  ///< template with {{names}}
extern const char* const style; ///< CSS
extern const char* const script;
extern const char* const chart;    ///< Chart.js
extern const char* const licences; ///< of Chart.js, HTML

// SHA-256 in hexadecimal digits.
extern const char* const style_hash;
extern const char* const script_hash;
extern const char* const chart_hash;

} // namespace tonetool::sequence::page
