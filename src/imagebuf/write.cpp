// Files that are either the old one or the whole new one.
#include "include/tonetool/write.h"

#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fcntl.h>
#include <memory>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "imagebuf/guard.h"
#include "imagebuf/temporary_names.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

// Temporary files now being written, for a signal handler: fixed storage, no locks.
constexpr int kMaxUnfinished = 64;
struct Unfinished {
    std::atomic<bool> used{false}, ready{false};
    char path[PATH_MAX]{};
};
Unfinished g_unfinished[kMaxUnfinished];

int remember(const std::string& path) {
    for (int i = 0; i < kMaxUnfinished && path.size() < PATH_MAX; ++i)
        if (!g_unfinished[i].used.exchange(true)) {
            std::memcpy(g_unfinished[i].path, path.c_str(), path.size() + 1);
            g_unfinished[i].ready = true;
            return i;
        }
    return -1;
}

void forget(int slot) {
    if (slot < 0)
        return;
    g_unfinished[slot].ready = false;
    g_unfinished[slot].used = false;
}

std::string reason() {
    return std::strerror(errno);
}

/// The file behind a name: symbolic links followed, also one that points to nothing yet.
std::string resolve(const std::string& name) {
    std::string path = name;
    for (int hops = 0; hops < 40; ++hops) {
        char target[PATH_MAX];
        const ssize_t n = ::readlink(path.c_str(), target, sizeof target - 1);
        if (n < 0)
            break;
        const std::string to(target, size_t(n));
        const auto slash = path.rfind('/');
        path = to[0] == '/' || slash == std::string::npos ? to : path.substr(0, slash + 1) + to;
    }
    return path;
}

// The descriptor a file is written through, and where it ends up.
class Target {
public:
    explicit Target(const std::string& name) : m_final(resolve(name)) {}
    Target(const Target&) = delete;
    Target& operator=(const Target&) = delete;

    ~Target() {
        if (m_fd >= 0)
            ::close(m_fd);
        if (!m_temporary.empty())
            ::unlink(m_temporary.c_str());
        forget(m_slot);
    }

    bool open(std::string& error) {
        struct stat info {};
        const bool exists = ::stat(m_final.c_str(), &info) == 0;
        if (exists && S_ISDIR(info.st_mode)) {
            error = "is a directory";
            return false;
        }
        if (exists && !S_ISREG(info.st_mode)) {
            m_fd = ::open(m_final.c_str(), O_WRONLY | O_CLOEXEC);
            error = m_fd < 0 ? reason() : "";
            return m_fd >= 0;
        }
        if (exists && ::access(m_final.c_str(), W_OK) != 0) {
            error = reason();
            return false;
        }
        return open_temporary(exists ? info.st_mode & 0777 : 0, error);
    }

    // Everything to the disk, then the new name in one step.
    bool commit(std::string& error) {
        const bool regular = !m_temporary.empty();
        if (regular && ::fsync(m_fd) != 0) {
            error = reason();
            return false;
        }
        const int closed = ::close(m_fd);
        m_fd = -1;
        if (closed != 0 || (regular && ::rename(m_temporary.c_str(), m_final.c_str()) != 0)) {
            error = reason();
            return false;
        }
        m_temporary.clear();
        return true;
    }

    int fd() const { return m_fd; }
    bool is_device() const { return m_temporary.empty(); }
    /// What a writer is told to open: never the final name of a file.
    const std::string& path() const { return is_device() ? m_final : m_temporary; }

private:
    // Tells remove_abandoned_outputs that somebody still writes. False where that was quicker and
    // has removed the file; a file system without locks is none of its business.
    bool hold() {
        struct stat info {};
        ::flock(m_fd, LOCK_EX | LOCK_NB);
        if (::fstat(m_fd, &info) != 0 || info.st_nlink > 0)
            return true;
        ::close(m_fd);
        return false;
    }

    bool open_temporary(mode_t mode, std::string& error) {
        const auto slash = m_final.rfind('/');
        const std::string folder = slash == std::string::npos ? "" : m_final.substr(0, slash + 1);
        const std::string base = m_final.substr(slash == std::string::npos ? 0 : slash + 1);
        // 0666 less the umask for a new file, the old file's rights for a replaced one.
        static std::atomic<unsigned> counter{0};
        for (int attempt = 0; attempt < 100 && m_fd < 0; ++attempt) {
            m_temporary = folder + temporary_name(base, ::getpid(), counter++);
            m_fd = ::open(m_temporary.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
            if (m_fd < 0 && errno != EEXIST)
                break;
            if (m_fd >= 0 && !hold())
                m_fd = -1;
        }
        if (m_fd < 0) {
            m_temporary.clear();
            error =
                "cannot create a file in \"" + (folder.empty() ? "." : folder) + "\": " + reason();
            return false;
        }
        m_slot = remember(m_temporary);
        if (mode != 0 && ::fchmod(m_fd, mode) != 0) {
            error = reason();
            return false;
        }
        return true;
    }

    std::string m_final, m_temporary;
    int m_fd = -1, m_slot = -1;
};

// OpenImageIO's writers write through this. The first failure is kept and the writer is told that
// all is well: the EXR writer (2.4) uses freed memory when it closes after a failed write.
class CheckedProxy final : public OIIO::Filesystem::IOProxy {
public:
    explicit CheckedProxy(const Target& target) : IOProxy(target.path(), Write), m_target(target) {}
    const char* proxytype() const override { return "tonetool"; }
    bool seek(int64_t offset) override {
        if (m_target.is_device() && offset != m_pos)
            note("cannot seek in a device or pipe");
        m_pos = offset;
        return true;
    }
    size_t write(const void* data, size_t size) override {
        pwrite(data, size, m_pos);
        m_pos += int64_t(size);
        return size;
    }
    size_t pwrite(const void* data, size_t size, int64_t offset) override {
        for (size_t done = 0; done < size && m_failure.empty();) {
            const char* from = static_cast<const char*>(data) + done;
            const ssize_t n = m_target.is_device() ? ::write(m_target.fd(), from, size - done)
                                                   : ::pwrite(m_target.fd(), from, size - done,
                                                              offset + int64_t(done));
            if (n < 0 && errno == EINTR)
                continue;
            if (n <= 0)
                note(n < 0 ? reason() : "nothing could be written");
            else
                done += size_t(n);
        }
        m_size = std::max(m_size, offset + int64_t(size));
        return size;
    }
    size_t size() const override { return size_t(m_size); }
    const std::string& failure() const { return m_failure; }

private:
    void note(const std::string& what) {
        if (m_failure.empty())
            m_failure = what;
    }

    const Target& m_target;
    int64_t m_size = 0;
    std::string m_failure;
};

// In pieces, so that a conversion does not take another image's memory.
bool write_pixels(const OIIO::ImageBuf& image, OIIO::ImageOutput& out) {
    constexpr int rows_at_once = 512; // whole blocks of every compression, enough for all threads
    const OIIO::ImageSpec& spec = image.spec();
    if (!image.localpixels() || spec.deep || spec.depth > 1 || out.spec().tile_width > 0)
        return image.write(&out);
    for (int y = spec.y; y < spec.y + spec.height; y += rows_at_once) {
        const int end = std::min(y + rows_at_once, spec.y + spec.height);
        if (!out.write_scanlines(y, end, spec.z, spec.format, image.pixeladdr(spec.x, y),
                                 image.pixel_stride(), image.scanline_stride()))
            return false;
    }
    return true;
}

bool write_through(OIIO::ImageOutput& out, const std::vector<OutputImage>& images,
                   const std::string& filename, std::string& error) {
    std::vector<OIIO::ImageSpec> specs;
    for (const OutputImage& image : images)
        if (!image.mip_level)
            specs.push_back(image.spec);
    for (size_t i = 0; i < images.size(); ++i) {
        const bool opened =
            i > 0 ? out.open(filename, images[i].spec,
                             images[i].mip_level ? OIIO::ImageOutput::AppendMIPLevel
                                                 : OIIO::ImageOutput::AppendSubimage)
                  : (specs.size() > 1 ? out.open(filename, int(specs.size()), specs.data())
                                      : out.open(filename, specs[0]));
        if (!opened) {
            error = out.geterror();
            return false;
        }
        if (!write_pixels(*images[i].pixels, out)) {
            error = images[i].pixels->geterror();
            if (error.empty())
                error = out.geterror();
            return false;
        }
    }
    if (out.close())
        return true;
    error = out.geterror();
    return false;
}

size_t count_subimages(const std::vector<OutputImage>& images) {
    return size_t(std::count_if(images.begin(), images.end(),
                                [](const OutputImage& image) { return !image.mip_level; }));
}

bool check_images(const std::vector<OutputImage>& images, const OIIO::ImageOutput& out,
                  std::string& error) {
    if (images.empty()) {
        error = "there is no image to write";
        return false;
    }
    for (const OutputImage& image : images)
        if (!image.pixels || !image.pixels->initialized() || image.pixels->has_error()) {
            const std::string why = image.pixels ? image.pixels->geterror() : "";
            error = why.empty() ? "the image holds no pixels" : why;
            return false;
        }
    for (const OutputImage& image : images)
        if (image.spec.roi() != image.pixels->roi() ||
            image.spec.deep != image.pixels->spec().deep) {
            error = "the spec to write does not have the image's size and channels";
            return false;
        }
    if (count_subimages(images) > 1 && !out.supports("multiimage")) {
        error = format("{} files hold one image, there are {}", out.format_name(), images.size());
        return false;
    }
    return true;
}

// Rows that are read back at once: whole strips and tiles of most files.
constexpr int kRowsBack = 256;

bool read_back_rows(OIIO::ImageInput& in, int subimage, const OIIO::ImageSpec& spec) {
    std::vector<unsigned char> pixels;
    if (spec.depth > 1) {
        pixels.resize(spec.image_bytes(true));
        return in.read_image(subimage, 0, 0, -1, OIIO::TypeUnknown, pixels.data());
    }
    const bool tiled = spec.tile_width > 0;
    const int block = tiled ? spec.tile_height : 1;
    const int step = std::max(kRowsBack / block, 1) * block;
    for (int y = spec.y; y < spec.y + spec.height; y += step) {
        const int end = std::min(y + step, spec.y + spec.height);
        pixels.resize(size_t(end - y) * spec.scanline_bytes(true));
        const bool read =
            tiled ? in.read_tiles(subimage, 0, spec.x, spec.x + spec.width, y, end, 0, 1, 0,
                                  spec.nchannels, OIIO::TypeUnknown, pixels.data())
                  : in.read_scanlines(subimage, 0, y, end, 0, 0, spec.nchannels, OIIO::TypeUnknown,
                                      pixels.data());
        if (!read)
            return false;
    }
    return true;
}

// Reads every pixel of a file back; a writer that buffers may not notice that its last bytes were
// lost.
bool reads_back(const std::string& path, size_t subimages, std::string& error) {
    const auto in = OIIO::ImageInput::open(path);
    for (int s = 0; in && s < int(subimages); ++s) {
        const OIIO::ImageSpec spec = in->spec(s, 0);
        if (spec.undefined())
            break;
        OIIO::DeepData deep;
        const bool read =
            spec.deep ? in->read_native_deep_image(s, 0, deep) : read_back_rows(*in, s, spec);
        if (!read)
            break;
        if (s + 1 == int(subimages))
            return true;
    }
    error = "the file that was written cannot be read back: " +
            (in ? in->geterror() : OIIO::geterror());
    return false;
}

// TIFF files with Exif data come out corrupt through a proxy (OpenImageIO 2.4, libtiff 4.5).
bool takes_proxy(const OIIO::ImageOutput& out) {
    return out.supports("ioproxy") && std::strcmp(out.format_name(), "tiff") != 0;
}

bool write_checked(const std::vector<OutputImage>& images, const std::string& filename,
                   std::string& error) {
    const std::string kind = images.empty() ? "" : images.front().format_name;
    const auto out = OIIO::ImageOutput::create(kind.empty() ? filename : kind);
    if (!out) {
        error = OIIO::geterror();
        return false;
    }
    if (!check_images(images, *out, error))
        return false;
    Target target(filename);
    if (!target.open(error))
        return false;
    CheckedProxy proxy(target);
    if (takes_proxy(*out))
        out->set_ioproxy(&proxy);
    else if (target.is_device()) {
        error = format("{} files cannot be written to a device or pipe", out->format_name());
        return false;
    }
    const bool written = write_through(*out, images, target.path(), error);
    if (!proxy.failure().empty())
        error = proxy.failure();
    if (!written || !proxy.failure().empty())
        return false;
    // Writers without a proxy, and those that pass it over (several subimages, deep pixels), have
    // opened the file by its name.
    if (proxy.size() == 0 && !reads_back(target.path(), count_subimages(images), error))
        return false;
    return target.commit(error);
}

// Runs a write; an error names the file.
template <class Run>
bool named(const std::string& filename, std::string& error, const Run& run) {
    if (contained(error, run))
        return true;
    if (error.find(filename) == std::string::npos)
        error = format("could not write \"{}\": {}", filename, error);
    return false;
}

} // namespace

bool write_images(const std::vector<OutputImage>& images, const std::string& filename,
                  std::string& error) {
    return named(filename, error,
                 [&](std::string& why) { return write_checked(images, filename, why); });
}

bool write_image(const OIIO::ImageBuf& image, const std::string& filename, std::string& error) {
    return write_images({{&image, image.spec()}}, filename, error);
}

bool write_bytes(const std::string& bytes, const std::string& filename, std::string& error) {
    return named(filename, error, [&](std::string& why) {
        Target target(filename);
        if (!target.open(why))
            return false;
        CheckedProxy proxy(target);
        proxy.write(bytes.data(), bytes.size());
        why = proxy.failure();
        return why.empty() && target.commit(why);
    });
}

void remove_unfinished_outputs() noexcept {
    for (Unfinished& entry : g_unfinished)
        if (entry.ready)
            ::unlink(entry.path);
}

} // namespace tonetool
