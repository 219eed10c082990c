// SPDX-License-Identifier: BSD-3-Clause
#include "tonetool/export.h"

namespace tonetool {

const char* version() noexcept {
    return TONETOOL_VERSION;
}

} // namespace tonetool
