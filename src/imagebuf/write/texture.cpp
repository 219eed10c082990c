// SPDX-License-Identifier: BSD-3-Clause
// Textures, written whole or not at all, as all other outputs.
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/strutil.h>
#include <fcntl.h>
#include <memory>
#include <mutex>
#include <sstream>
#include <unistd.h>

#include "imagebuf/pixels/guard.h"
#include "imagebuf/pixels/has_pixels.h"
#include "imagebuf/write/output_target.h"
#include "imagebuf/write/write_checks.h"
#include "metrics/refusal.h"
#include "tonetool/texture.h"

namespace tonetool {
namespace {

using OIIO::ImageOutput;
using OIIO::ImageSpec;
using OIIO::stride_t;
using OIIO::TypeDesc;
using OIIO::Strutil::fmt::format;

// A texture that is being made on this thread.
struct Job {
    explicit Job(const std::string& filename) : target(filename), proxy(target) {}
    OutputTarget target;
    CheckedProxy proxy;
    std::unique_ptr<ImageOutput> writer;
    std::string opened; ///< the name that make_texture opens
};

thread_local Job* g_job = nullptr;

struct Current {
    explicit Current(Job& job) { g_job = &job; }
    Current(const Current&) = delete;
    Current& operator=(const Current&) = delete;
    ~Current() { g_job = nullptr; }
};

// make_texture opens the file that it writes by a name of its own, and the tiled EXR writer (3.1)
// waits for ever once a write has failed. It is given this writer, which writes to the job's target
// and leaves an empty file to be renamed.
class TargetOutput final : public ImageOutput {
public:
    TargetOutput() : m_job(*g_job), m_writer(std::move(g_job->writer)) {}

    const char* format_name() const override { return m_writer->format_name(); }
    int supports(OIIO::string_view feature) const override { return m_writer->supports(feature); }
    bool open(const std::string& name, const ImageSpec& spec, OpenMode mode) override {
        if (mode == Create) {
            m_job.opened = name;
            if (takes_proxy(*m_writer))
                m_writer->set_ioproxy(&m_job.proxy);
        }
        return told(m_writer->open(m_job.target.path(), spec, mode)) &&
               (m_spec = m_writer->spec(), true);
    }
    bool close() override {
        const bool closed = told(m_writer->close());
        const int fd = ::open(m_job.opened.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
        if (fd >= 0)
            ::close(fd);
        return closed;
    }
    bool write_scanline(int y, int z, TypeDesc type, const void* data, stride_t x) override {
        return told(m_writer->write_scanline(y, z, type, data, x));
    }
    bool write_scanlines(int begin, int end, int z, TypeDesc type, const void* data, stride_t x,
                         stride_t y) override {
        return told(m_writer->write_scanlines(begin, end, z, type, data, x, y));
    }
    bool write_tile(int x, int y, int z, TypeDesc type, const void* data, stride_t xs, stride_t ys,
                    stride_t zs) override {
        return told(m_writer->write_tile(x, y, z, type, data, xs, ys, zs));
    }
    bool write_tiles(int xbegin, int xend, int ybegin, int yend, int zbegin, int zend,
                     TypeDesc type, const void* data, stride_t x, stride_t y, stride_t z) override {
        return told(
            m_writer->write_tiles(xbegin, xend, ybegin, yend, zbegin, zend, type, data, x, y, z));
    }
    bool write_rectangle(int xbegin, int xend, int ybegin, int yend, int zbegin, int zend,
                         TypeDesc type, const void* data, stride_t x, stride_t y,
                         stride_t z) override {
        return told(m_writer->write_rectangle(xbegin, xend, ybegin, yend, zbegin, zend, type, data,
                                              x, y, z));
    }
    bool write_image(TypeDesc type, const void* data, stride_t x, stride_t y, stride_t z,
                     OIIO::ProgressCallback progress, void* progress_data) override {
        return told(m_writer->write_image(type, data, x, y, z, progress, progress_data));
    }

private:
    bool told(bool done) {
        if (!done)
            errorfmt("{}", m_writer->geterror());
        return done;
    }

    Job& m_job;
    std::unique_ptr<ImageOutput> m_writer;
};

constexpr char kFormat[] = "tonetool_texture";

ImageOutput* create_target_output() {
    return g_job && g_job->writer ? new TargetOutput : nullptr;
}

void declare_format() {
    static std::once_flag once;
    std::call_once(once, [] {
        static const char* none[] = {nullptr};
        OIIO::declare_imageio_format(kFormat, nullptr, none, create_target_output, none,
                                     "tonetool");
    });
}

void make(OIIO::ImageBufAlgo::MakeTextureMode mode, const OIIO::ImageBuf& image, Job& job,
          ImageSpec config) {
    config.attribute("maketx:fileformatname", kFormat);
    const std::string name = job.target.unused_name();
    std::ostringstream told;
    const Current current(job);
    const bool made = OIIO::ImageBufAlgo::make_texture(mode, image, name, config, &told);
    for (const std::string& left : {name, job.opened})
        ::unlink(left.c_str());
    if (!made)
        throw Refusal(OIIO::geterror());
}

void write_checked(OIIO::ImageBufAlgo::MakeTextureMode mode, const OIIO::ImageBuf& image,
                   const std::string& filename, const ImageSpec& config) {
    const std::string kind(config.get_string_attribute("maketx:fileformatname"));
    Job job(filename);
    job.writer = ImageOutput::create(kind.empty() ? filename : kind);
    if (!job.writer)
        throw Refusal(OIIO::geterror());
    const bool proxied = takes_proxy(*job.writer);
    job.target.open();
    if (job.target.is_device())
        throw Refusal("textures cannot be written to a device or pipe");
    declare_format();
    const auto said_of_target = [&](const std::string& why) {
        return job.target.in_its_name(job.proxy.failure().empty() ? why : job.proxy.failure());
    };
    refusing_as(said_of_target, [&] {
        make(mode, image, job, config);
        job.proxy.check();
        if (!proxied)
            check_reads_back(job.target.path(), 1);
    });
    job.target.commit();
}

} // namespace

bool write_texture(OIIO::ImageBufAlgo::MakeTextureMode mode, const OIIO::ImageBuf& image,
                   const std::string& filename, const ImageSpec& config, std::string& error) {
    return contained(error, [&] {
        // make_texture() takes what a reader has not read for black.
        if (!has_pixels(image))
            throw Refusal(with_name(image, "the image holds no pixels"));
        if (image.deep())
            throw Refusal(with_name(image, "deep images cannot be turned into textures"));
        const bool on_disk = is_file_to_read(image);
        const OIIO::ImageBuf whole =
            on_disk ? read_whole(image, image.nativespec().format) : OIIO::ImageBuf();
        write_checked(mode, on_disk ? whole : image, filename, config);
    });
}

} // namespace tonetool
