#include "chain/chain.h"

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <map>
#include <memory>
#include <mutex>
#include <sstream>
#include <thread>

#include "chain/error.h"
#include "chain/frames.h"
#include "chain/help.h"
#include "chain/output.h"
#include "chain/runner.h"

namespace tonetool::chain {

namespace {

std::string full_command_line(const Strings& words, bool compat) {
    std::string line = "tonetool";
    for (const std::string& word : words) {
        bool quoted = word.find_first_of(" \t\n") != std::string::npos;
        line += " " + (!compat ? shell_quoted(word) : (quoted ? '"' + word + '"' : word));
    }
    return line;
}

// Statuses by rank: an error dominates a failed threshold, and that a warning.
int worse(int a, int b) {
    const auto rank = [](int status) { return status == 1 ? 4 : status; };
    return rank(a) > rank(b) ? a : b;
}

class Loop {
public:
    Loop(const FramePlan& plan, std::ostream& out, std::ostream& err)
        : m_plan(plan),
          m_out(out),
          m_err(err),
          m_progress(err, plan) {}

    int run() {
        int jobs = std::min(m_plan.parallel, int(m_plan.runs.size()));
        if (jobs > 1) {
            run_parallel(jobs);
        } else {
            for (size_t i = 0; i < m_plan.runs.size() && !ends(); ++i) {
                finished(i, run_one(m_plan.runs[i], m_out, m_err));
            }
        }
        return m_status;
    }

private:
    int run_one(const FrameRun& run, std::ostream& out, std::ostream& err) const {
        Session session(out, err, full_command_line(run.words, m_plan.compat));
        session.compat = m_plan.compat;
        session.frame = run.frame;
        session.plan = &m_plan;
        session.parallel = m_plan.parallel;
        Runner(session, run.words).run_all();
        return session.exit_status();
    }

    bool ends() const { return m_status == 1 && !m_plan.skip_bad; }

    void finished(size_t index, int status) {
        m_status = worse(m_status, status);
        m_progress.done(m_plan.runs[index], status);
    }

    void run_parallel(int jobs);
    void work();

    const FramePlan& m_plan;
    std::ostream& m_out;
    std::ostream& m_err;
    Progress m_progress;
    int m_status = 0;
    std::mutex m_mutex;
    size_t m_next = 0, m_printed = 0;
    struct Texts {
        std::string out, err;
    };
    std::map<size_t, Texts> m_texts; ///< of frames that wait for earlier ones to be printed
};

// What frames print comes in their order.
void Loop::work() {
    for (;;) {
        size_t index = 0;
        {
            std::lock_guard<std::mutex> lock(m_mutex);
            if (m_next == m_plan.runs.size() || ends()) {
                return;
            }
            index = m_next++;
        }
        std::ostringstream out, err;
        int status = run_one(m_plan.runs[index], out, err);
        std::lock_guard<std::mutex> lock(m_mutex);
        m_texts[index] = {out.str(), err.str()};
        for (auto text = m_texts.find(m_printed); text != m_texts.end();
             text = m_texts.find(++m_printed)) {
            m_out << text->second.out << std::flush;
            m_err << text->second.err << std::flush;
        }
        finished(index, status);
    }
}

void Loop::run_parallel(int jobs) {
    std::vector<std::thread> threads;
    for (int i = 0; i < jobs; ++i) {
        threads.emplace_back([this] { work(); });
    }
    for (std::thread& thread : threads) {
        thread.join();
    }
}

// An image from outside is like one that was read.
void push_given(Session& session, OIIO::ImageBuf& pixels, size_t index) {
    const std::string which = "image " + std::to_string(index + 1);
    const bool unread = pixels.spec().undefined() || pixels.storage() == OIIO::ImageBuf::IMAGECACHE;
    const OIIO::ImageSpec native = unread ? pixels.nativespec() : pixels.spec();
    if (!pixels.initialized() ||
        (unread && !pixels.read(pixels.subimage(), pixels.miplevel(), true, OIIO::TypeFloat))) {
        const std::string why = pixels.geterror();
        throw CommandError(which + " has no pixels" + (why.empty() ? "" : ": " + why));
    }
    const DataFormat format{native.format, {}, native.get_int_attribute("oiio:BitsPerSample")};
    const bool integer = !native.format.is_floating_point();
    const std::string name = pixels.name().empty() ? which : std::string(pixels.name());
    std::vector<OIIO::ImageBuf> levels(1);
    const bool is_float = pixels.spec().deep || pixels.spec().format == OIIO::TypeFloat;
    levels[0] = is_float ? std::move(pixels) : pixels.copy(OIIO::TypeFloat);
    auto part = std::make_shared<Part>(std::move(levels), format, integer);
    session.read_format = format;
    session.first_header = session.first_header.value_or(part->header());
    session.push(std::make_shared<Image>(name, std::vector<PartPtr>{part}));
}

Left left(Session& session, const Image& image, const std::string& label) {
    Left out{image.name(), label, {}, {}};
    for (const PartPtr& part : image.parts()) {
        const OIIO::ImageBuf& pixels = part->pixels();
        out.subimages.push_back(pixels.copy(pixels.spec().format));
        out.formats.push_back(output_type(session, *part));
    }
    return out;
}

void take_images(Session& session, Evaluation& result) {
    std::map<ImagePtr, std::string> labels;
    for (const auto& [label, image] : session.labels) {
        labels.emplace(image, label);
    }
    for (const ImagePtr& image : session.stack) {
        auto label = labels.find(image);
        result.stack.push_back(left(session, *image, label == labels.end() ? "" : label->second));
    }
}

void evaluate_one(Session& session, std::vector<OIIO::ImageBuf>& images, FramePlan plan,
                  Evaluation& result) {
    if (plan.runs.size() != 1) {
        throw CommandError("wildcards fit " + std::to_string(plan.runs.size()) +
                           " frames, not one (--frames N chooses one)");
    }
    for (size_t i = 0; i < images.size(); ++i) {
        push_given(session, images[i], i);
    }
    session.frame = plan.runs[0].frame;
    session.plan = &plan;
    Runner(session, plan.runs[0].words).run_all();
    if (session.errors == 0) {
        take_images(session, result);
    }
}

} // namespace

Evaluation evaluate(const Strings& words, std::vector<OIIO::ImageBuf> images,
                    const Policy& policy) {
    Evaluation result;
    std::ostringstream out, err;
    Session session(out, err, full_command_line(words, false));
    session.compat = is_compat(words);
    session.policy = policy;
    session.for_images = true;
    try {
        evaluate_one(session, images, plan_frames(words, policy.directory), result);
    } catch (const std::exception& problem) {
        session.error("", problem.what());
    }
    result.status = session.exit_status();
    result.error = session.first_error;
    if (result.error.empty() && result.status != 0 && result.status != 2) {
        result.error = result.status == 3 ? "a threshold was exceeded" : "the images differ";
    }
    result.out = out.str();
    result.err = err.str();
    result.warnings = session.warning_texts;
    result.files = session.files;
    if (session.errors > 0) {
        result.stack.clear();
    }
    return result;
}

int run(const Strings& words, std::ostream& out, std::ostream& err) {
    if (words.empty()) {
        err << usage_text();
        return 1;
    }
    int status = 0;
    const bool compat = is_compat(words);
    Session whole(out, err, compat ? "" : full_command_line(words, false));
    whole.compat = compat;
    try {
        FramePlan plan = plan_frames(words);
        status = Loop(plan, out, err).run();
        if (plan.runs.empty()) {
            whole.warning("", no_output);
        }
    } catch (const std::exception& problem) {
        whole.error("", problem.what());
    }
    out.flush();
    if (!out) {
        whole.error("", "cannot write to the standard output");
    }
    return worse(status, whole.exit_status());
}

} // namespace tonetool::chain
