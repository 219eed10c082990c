// SPDX-License-Identifier: BSD-3-Clause
// What is looked at when the words of a frame have run.
#include <OpenImageIO/imagecache.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/sysutil.h>
#include <ostream>

#include "chain/session/io.h"
#include "chain/session/runner.h"
#include "text/error.h"

namespace tonetool::chain {

void Runner::print_statistics() {
    std::string text = OIIO::Strutil::fmt::format(
        "\nThreads: {}\ntonetool runtime statistics:\n  Total time: {:.2f}s\n",
        OIIO::get_int_attribute("threads"), m_time());
    double rest = m_time();
    for (const auto& [name, seconds] : m_session.outcome.seconds) {
        text += OIIO::Strutil::fmt::format("      {:<12} : {:5.2f}\n", name, seconds);
        rest -= seconds;
    }
    text += OIIO::Strutil::fmt::format("      {:<12} : {:5.2f}\n", "unaccounted", rest);
    m_session.out << text << "  Peak memory:    "
                  << OIIO::Strutil::memformat(OIIO::Sysutil::memory_used(true))
                  << "\n  Current memory: "
                  << OIIO::Strutil::memformat(OIIO::Sysutil::memory_used()) << "\n\n"
                  << OIIO::ImageCache::create()->getstats(2) << "\n";
}

// A shell's * in place of #, or a forgotten tests=, leaves images that nothing has looked at.
void Runner::refuse_what_was_not_compared() const {
    for (const ImagePtr& image : m_session.stack.images) {
        if (m_session.judges && !image->worked_on && !image->written) {
            throw CommandError("\"" + image->name() +
                               "\" was never compared (valid: names with # "
                               "for sequences, tests=K for K tests of one reference, or --pop)");
        }
    }
}

// "ref a b --hdrflip" compares a with b: the forgotten tests=2 must not go unnoticed.
void Runner::warn_of_unused() {
    const bool listing = m_session.settings.listing() || m_session.outcome.produced_by_name;
    for (const ImagePtr& image : m_session.stack.images) {
        const bool result = m_session.for_images && image == m_session.stack.top();
        if (!listing && !result && !image->used && image->part().from_file())
            m_session.warning("", "\"" + image->name() + "\" was read, but no command used it");
    }
}

void Runner::finish() {
    if (m_session.settings.compat) {
        finish_leniently();
        return;
    }
    if (!m_postponed.empty()) {
        const Call& call = m_postponed.front();
        m_where = call.row().label();
        throw CommandError("never executed: " + m_session.stack.lacks(call.pops()));
    }
    if (!m_session.flow.blocks.empty()) {
        throw CommandError("--" + m_session.flow.blocks.back().kind + " without its --end" +
                           m_session.flow.blocks.back().kind);
    }
    if (!m_session.outcome.unused_limit.empty()) {
        m_where = m_session.outcome.unused_limit;
        throw CommandError("no --diff ran after it, so nothing was held to this limit (other "
                           "measurements have their own, as --hdrflip:fail=X)");
    }
    check_outputs(m_session);
    refuse_what_was_not_compared();
    warn_of_unused();
    if (!m_session.outcome.produced && !m_session.outcome.wrote && !m_session.for_images) {
        if (m_session.settings.listing())
            throw CommandError("printed nothing: --info, --stats and --hash are of the files that "
                               "are named after them (valid: --info FILE)");
        throw CommandError("produced no output. Did you forget -o?");
    }
}

void Runner::finish_leniently() {
    refuse_what_was_not_compared();
    if (!m_postponed.empty())
        m_session.warning(m_postponed.front().text(), "pending command never executed");
    if (!m_session.flow.blocks.empty()) {
        const std::string& kind = m_session.flow.blocks.back().kind;
        m_session.warning(kind, "unterminated " + kind);
    }
    if (!m_session.outcome.produced && !m_session.settings.listing() &&
        !m_session.settings.dry_run && !m_session.for_images) {
        const Image* top = m_session.stack.images.empty() ? nullptr : m_session.stack.top().get();
        if (top && !top->written && !top->part().from_file())
            m_session.warning("", "modified images without outputting them. Did you forget -o?");
        else if (!m_session.outcome.wrote)
            m_session.warning("", kNoOutput);
    }
}

} // namespace tonetool::chain
