// SPDX-License-Identifier: BSD-3-Clause
// What the commands that compare tests with a reference have in common.
#pragma once

#include <functional>
#include <vector>

#include "chain/commands/flip_report.h"
#include "chain/commands/options.h"
#include "sequence/report/report_pictures.h"
#include "sequence/results/measurement.h"
#include "text/printable.h"

namespace tonetool::chain {

using Maps = std::vector<OIIO::ImageBuf>;
using Tests = std::vector<const OIIO::ImageBuf*>;
using Views = std::vector<OIIO::ImageBuf>;
using CompareFunction = std::function<bool(Maps&, const OIIO::ImageBuf&, const Tests&)>;

// What the images of a command are looked at for: call.images is the reference and the tests.
struct Look {
    PixelOptions reference, tests;
    bool alike = true; ///< both are the picture that was rendered, and none is made of the other
    /// Many times: the images are read before, unless their memory is bounded.
    bool again = false;
};
Look same_look(const Call& call, bool again = false);

// The images as they were compared, and a map for each test.
struct Compared {
    Views views;
    Maps maps;
};

// Reads the images, warns of what makes them no pair, and compares them.
Compared compare_tests(Session& session, const Call& call, const Look& look,
                       const CompareFunction& function);

inline std::string left_out_text(const PairSummary& summary) {
    return ignored_text(summary.ignored);
}
inline std::string left_out_text(const TmqiSummary&) {
    return "";
}

template <class Summary>
void print_summary(Session& session, const Call& call, const Summary& summary,
                   const std::string& test, bool judged) {
    const std::string label = call.row().label(), reference = call.images.front()->name();
    const Detail what = detail(session, call);
    if (what == Detail::All)
        session.print(summary_text(label, summary, reference, test));
    else if (what == Detail::Brief)
        session.print(brief_text(label, summary, reference, test));
    else if (what == Detail::Line && !judged)
        session.print(label + ": " + numbers_text(summary) + left_out_text(summary) + " (" +
                      printable(test) + ")");
}

// `limits` are what judge() will say a line of.
template <class Summary>
void tell_summary(Session& session, const Call& call, const Summary& summary, const Limits& limits,
                  size_t test = 0) {
    for (const std::string& warning : summary.warnings)
        session.warning(call.row().label(), warning);
    record(session, call, sequence::measurement(summary), test);
    print_summary(session, call, summary, call.images.at(test + 1)->name(), !limits.empty());
}

// The pair for the report; of maps without a bound there are no colours that mean the same in all
// frames.
sequence::PictureRequest pair_request(const Views& views, size_t test = 0);

void push_result(Session& session, const Call& call, OIIO::ImageBuf result);

// The map lies as its pictures do.
void push_map(Session& session, const Call& call, OIIO::ImageBuf map);

// tests=, and the images that a command takes for it.
int test_count(const Call& call);
int compared_pops(const Call& call);

} // namespace tonetool::chain
