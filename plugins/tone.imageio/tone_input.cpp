#include "tone.imageio/tone_input.h"

#include <OpenImageIO/strutil.h>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mutex>

#include "include/tonetool/export.h"
#include "recipe/picture.h"

namespace tonetool {

namespace {

using recipe::PicturePtr;

bool is_named_so(const std::string& file) {
    return OIIO::Strutil::iends_with(file, std::string(".") + tone_extensions[0]);
}

std::string misnamed_text(const std::string& file) {
    return "\"" + file + "\" is a recipe of tonetool, whose name must end in .tone";
}

// For where hosts do not ask the reader what was wrong: beside the text of their own, once.
void say(const std::string& text) {
    static std::mutex lock;
    static std::string last;
    const std::lock_guard<std::mutex> hold(lock);
    if (text != last) {
        last = text;
        std::fprintf(stderr, "%s\n", text.c_str());
    }
}

class ToneInput final : public OIIO::ImageInput {
public:
    const char* format_name() const override { return "tone"; }
    int supports(OIIO::string_view feature) const override;
    bool valid_file(const std::string& name) const override;
    bool open(const std::string& name, OIIO::ImageSpec& spec) override {
        return open(name, spec, OIIO::ImageSpec());
    }
    bool open(const std::string& name, OIIO::ImageSpec& spec,
              const OIIO::ImageSpec& config) override;
    bool close() override;
    int current_subimage() const override { return m_subimage; }
    bool seek_subimage(int subimage, int miplevel) override;
    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override {
        return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
    }
    bool read_native_scanlines(int subimage, int miplevel, int begin, int end, int z,
                               void* data) override;

private:
    bool guarded(bool (ToneInput::*step)());
    bool make();
    bool renew();
    bool fail(const std::string& why) {
        errorfmt("{}", why);
        return false;
    }

    recipe::Source m_source;
    PicturePtr m_picture;
    int m_subimage = 0;
};

int ToneInput::supports(OIIO::string_view feature) const {
    // Not "procedural": for names with parameters it makes no difference, and 2.4's oiiotool aborts
    // where such a file is missing.
    return feature == "arbitrary_metadata" || feature == "multiimage";
}

// A file of our extension is ours, whatever is in it: the error is to be ours, too.
bool ToneInput::valid_file(const std::string& name) const {
    try {
        const std::string file = recipe::parse_source(name, OIIO::ImageSpec()).file;
        return is_named_so(file) || recipe::has_magic(file);
    } catch (...) {
        return is_named_so(name.substr(0, name.find('?')));
    }
}

bool ToneInput::guarded(bool (ToneInput::*step)()) {
    try {
        return (this->*step)();
    } catch (const std::exception& problem) {
        return fail(problem.what());
    } catch (...) {
        return fail("unknown error");
    }
}

bool ToneInput::make() {
    m_picture = recipe::picture_of(m_source);
    return true;
}

bool ToneInput::open(const std::string& name, OIIO::ImageSpec& spec,
                     const OIIO::ImageSpec& config) {
    close();
    // Every format is being tried, under a lock that reading any other image would wait for.
    if (config.get_int_attribute("nowait") != 0) {
        if (!is_named_so(name) && recipe::has_magic(name)) {
            say(misnamed_text(name));
        }
        return false;
    }
    try {
        m_source = recipe::parse_source(name, config);
    } catch (const std::exception& problem) {
        return fail(problem.what());
    }
    if (!is_named_so(m_source.file)) {
        return fail(misnamed_text(m_source.file));
    }
    if (!guarded(&ToneInput::make)) {
        // oiiotool then looks for a file of the whole name, and says that there is none.
        if (!m_source.parameters.empty() && name != m_source.file) {
            say(geterror(false));
        }
        return false;
    }
    m_spec = m_picture->subimages.front().spec();
    spec = m_spec;
    return true;
}

bool ToneInput::close() {
    m_picture.reset();
    m_subimage = 0;
    m_spec = OIIO::ImageSpec();
    return true;
}

bool ToneInput::seek_subimage(int subimage, int miplevel) {
    const bool there = m_picture && subimage >= 0 && miplevel == 0 &&
                       size_t(subimage) < m_picture->subimages.size();
    if (there && subimage != m_subimage) {
        m_subimage = subimage;
        m_spec = m_picture->subimages[size_t(subimage)].spec();
    }
    return there;
}

// The picture anew, where an input is another than when it was made.
bool ToneInput::renew() {
    if (recipe::is_current(m_picture->inputs)) {
        return true;
    }
    const PicturePtr before = m_picture;
    make();
    bool same = m_picture->subimages.size() == before->subimages.size();
    for (size_t i = 0; same && i < before->subimages.size(); ++i) {
        const OIIO::ImageSpec& a = before->subimages[i].spec();
        const OIIO::ImageSpec& b = m_picture->subimages[i].spec();
        same = a.roi() == b.roi() && a.format == b.format;
    }
    if (!same) {
        m_picture = before;
        return fail("recipe \"" + m_source.file +
                    "\": an input has changed, and with it the size (valid: open it again)");
    }
    m_spec = m_picture->subimages[size_t(m_subimage)].spec();
    return true;
}

bool ToneInput::read_native_scanlines(int subimage, int miplevel, int begin, int end, int z,
                                      void* data) {
    lock_guard lock(*this);
    if (!seek_subimage(subimage, miplevel)) {
        return fail("recipe \"" + m_source.file + "\" has no subimage " + std::to_string(subimage) +
                    " of MIP level " + std::to_string(miplevel));
    }
    if (begin == m_spec.y && !guarded(&ToneInput::renew)) {
        return false;
    }
    const OIIO::ImageBuf& pixels = m_picture->subimages[size_t(subimage)];
    const size_t bytes = size_t(m_spec.scanline_bytes());
    auto* to = static_cast<char*>(data);
    for (int y = begin; y < end; ++y, to += bytes) {
        const void* row = pixels.pixeladdr(m_spec.x, y, z);
        if (!row || y < m_spec.y || y >= m_spec.y + m_spec.height) {
            return fail("recipe \"" + m_source.file + "\" has no row " + std::to_string(y));
        }
        std::memcpy(to, row, bytes);
    }
    return true;
}

} // namespace

OIIO::ImageInput* create_tone_input() {
    return new ToneInput;
}

void register_tone_format() {
    OIIO::declare_imageio_format("tone", create_tone_input, tone_extensions, nullptr, nullptr,
                                 "tonetool " TONETOOL_VERSION);
}

} // namespace tonetool
