// SPDX-License-Identifier: BSD-3-Clause
// --licenses.
#include <ostream>

#include "chain/manual/licenses.h"
#include "chain/session/call.h"
#include "chain/session/session.h"

namespace tonetool::chain {

namespace {

void run_licenses(Session& session, const Call&) {
    session.outcome.produced = true;
    session.out << kLicenceTexts;
}

} // namespace

Rows licence_commands() {
    return {command("licenses|licences", "Print the licences of tonetool and of the software in it",
                    run_licenses)};
}

} // namespace tonetool::chain
