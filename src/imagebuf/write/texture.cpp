// Textures, written with the promise of all other outputs.
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

bool make(OIIO::ImageBufAlgo::MakeTextureMode mode, const OIIO::ImageBuf& image, Job& job,
          ImageSpec config, std::string& error) {
    config.attribute("maketx:fileformatname", kFormat);
    const std::string name = job.target.unused_name();
    std::ostringstream told;
    g_job = &job;
    const bool made = OIIO::ImageBufAlgo::make_texture(mode, image, name, config, &told);
    g_job = nullptr;
    for (const std::string& left : {name, job.opened})
        ::unlink(left.c_str());
    if (made)
        return true;
    error = OIIO::geterror();
    return false;
}

bool write_checked(OIIO::ImageBufAlgo::MakeTextureMode mode, const OIIO::ImageBuf& image,
                   const std::string& filename, const ImageSpec& config, std::string& error) {
    const std::string kind(config.get_string_attribute("maketx:fileformatname"));
    Job job(filename);
    job.writer = ImageOutput::create(kind.empty() ? filename : kind);
    if (!job.writer) {
        error = OIIO::geterror();
        return false;
    }
    const bool proxied = takes_proxy(*job.writer);
    if (!job.target.open(error))
        return false;
    if (job.target.is_device()) {
        error = "textures cannot be written to a device or pipe";
        return false;
    }
    declare_format();
    const bool made = make(mode, image, job, config, error);
    if (!job.proxy.failure().empty())
        error = job.proxy.failure();
    if (made && job.proxy.failure().empty() && (proxied || reads_back(job.target.path(), 1, error)))
        return job.target.commit(error);
    error = job.target.in_its_name(error);
    return false;
}

} // namespace

bool write_texture(OIIO::ImageBufAlgo::MakeTextureMode mode, const OIIO::ImageBuf& image,
                   const std::string& filename, const ImageSpec& config, std::string& error) {
    return contained(error, [&](std::string& why) {
        // make_texture() takes what a reader has not read for black.
        OIIO::ImageBuf whole;
        if (!has_pixels(image)) {
            why = with_name(image, "the image holds no pixels");
            return false;
        }
        if (image.deep()) {
            why = with_name(image, "deep images cannot be turned into textures");
            return false;
        }
        if (is_file_to_read(image)) {
            if (!read_whole(image, image.nativespec().format, whole, why))
                return false;
            return write_checked(mode, whole, filename, config, why);
        }
        return write_checked(mode, image, filename, config, why);
    });
}

} // namespace tonetool
