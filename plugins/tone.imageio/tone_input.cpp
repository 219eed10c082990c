// SPDX-License-Identifier: BSD-3-Clause
#include "tone.imageio/tone_input.h"

#include <OpenImageIO/strutil.h>
#include <cstdio>
#include <cstring>
#include <exception>
#include <mutex>
#include <optional>

#include "recipe/picture.h"
#include "recipe/plan.h"
#include "text/printable.h"
#include "tonetool/export.h"

namespace tonetool {

namespace {

using recipe::PicturePtr;

bool is_named_so(const std::string& file) {
    return OIIO::Strutil::iends_with(file, std::string(".") + kToneExtensions[0]);
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
        std::fprintf(stderr, "%s\n", printable_lines(text).c_str());
    }
}

// oiiotool opens what it could not read once more to learn why; that must not be planned only.
thread_local recipe::Source failed_last;

class ToneInput final : public OIIO::ImageInput {
public:
    const char* format_name() const override { return "tone"; }
    int supports(OIIO::string_view feature) const override;
    bool valid_file(const std::string& name) const override;
    /// Reads headers only, where they tell the size; what else the header says comes with spec().
    bool open(const std::string& name, OIIO::ImageSpec& spec) override {
        return begin(name, OIIO::ImageSpec()) && (plan() || make_at_open(name)) && told(spec);
    }
    bool open(const std::string& name, OIIO::ImageSpec& spec,
              const OIIO::ImageSpec& config) override;
    bool close() override;
    const OIIO::ImageSpec& spec() const override;
    OIIO::ImageSpec spec(int subimage, int miplevel) override;
    int current_subimage() const override { return m_subimage; }
    bool seek_subimage(int subimage, int miplevel) override;
    bool read_native_scanline(int subimage, int miplevel, int y, int z, void* data) override {
        return read_native_scanlines(subimage, miplevel, y, y + 1, z, data);
    }
    bool read_native_scanlines(int subimage, int miplevel, int begin, int end, int z,
                               void* data) override;

private:
    bool guarded(bool (ToneInput::*step)());
    bool begin(const std::string& name, const OIIO::ImageSpec& config);
    bool plan();
    bool make_at_open(const std::string& name);
    bool told(OIIO::ImageSpec& spec) const {
        spec = m_spec;
        return true;
    }
    bool make();
    bool make_as_planned();
    bool renew();
    bool fail(const std::string& why) {
        errorfmt("{}", why);
        return false;
    }

    recipe::Source m_source;
    PicturePtr m_picture; ///< nullptr: only planned so far
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

bool ToneInput::begin(const std::string& name, const OIIO::ImageSpec& config) {
    close();
    // Every format is being tried, under a lock that reading any other image would wait for.
    if (config.get_int_attribute("nowait") != 0) {
        if (!is_named_so(name) && recipe::has_magic(name))
            say(misnamed_text(name));
        return false;
    }
    try {
        m_source = recipe::parse_source(name, config);
    } catch (const std::exception& problem) {
        return fail(problem.what());
    }
    return is_named_so(m_source.file) || fail(misnamed_text(m_source.file));
}

bool ToneInput::plan() {
    if (m_source.file == failed_last.file && m_source.parameters == failed_last.parameters)
        return false;
    const std::optional<OIIO::ImageSpec> header = recipe::planned_header(m_source);
    m_spec = header.value_or(m_spec);
    return header.has_value();
}

bool ToneInput::make_at_open(const std::string& name) {
    failed_last = {};
    if (!guarded(&ToneInput::make)) {
        failed_last = m_source;
        // oiiotool then looks for a file of the whole name, and says that there is none.
        if (!m_source.parameters.empty() && name != m_source.file)
            say(geterror(false));
        return false;
    }
    m_spec = m_picture->subimages.front().spec();
    return true;
}

// Who hands over a configuration, as the image cache does, takes the header as it is now for good.
bool ToneInput::open(const std::string& name, OIIO::ImageSpec& spec,
                     const OIIO::ImageSpec& config) {
    return begin(name, config) && make_at_open(name) && told(spec);
}

bool ToneInput::make_as_planned() {
    if (m_picture)
        return true;
    const PicturePtr picture = recipe::picture_of(m_source);
    const OIIO::ImageSpec& made = picture->subimages.front().spec();
    if (made.roi() != m_spec.roi() || made.format != m_spec.format) {
        return fail("recipe \"" + m_source.file +
                    "\": an input has changed, and with it the size (valid: open it again)");
    }
    m_picture = picture;
    m_spec = made;
    return true;
}

// Where the chain fails, this is the header as planned, and reading tells why.
const OIIO::ImageSpec& ToneInput::spec() const {
    lock_guard lock(*this);
    auto* self = const_cast<ToneInput*>(this);
    if (m_spec.width > 0)
        (void)self->guarded(&ToneInput::make_as_planned);
    return m_spec;
}

OIIO::ImageSpec ToneInput::spec(int subimage, int miplevel) {
    (void)spec();
    return ImageInput::spec(subimage, miplevel);
}

bool ToneInput::close() {
    m_picture.reset();
    m_subimage = 0;
    m_spec = OIIO::ImageSpec();
    return true;
}

bool ToneInput::seek_subimage(int subimage, int miplevel) {
    if (!m_picture && subimage == 0 && miplevel == 0)
        return m_spec.width > 0;
    const bool there = m_spec.width > 0 && guarded(&ToneInput::make_as_planned) && subimage >= 0 &&
                       miplevel == 0 && size_t(subimage) < m_picture->subimages.size();
    if (there && subimage != m_subimage) {
        m_subimage = subimage;
        m_spec = m_picture->subimages[size_t(subimage)].spec();
    }
    return there;
}

// The picture anew, where an input is another than when it was made.
bool ToneInput::renew() {
    if (sequence::is_current(m_picture->inputs))
        return true;
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
    if (!guarded(&ToneInput::make_as_planned))
        return false;
    if (!seek_subimage(subimage, miplevel)) {
        return fail("recipe \"" + m_source.file + "\" has no subimage " + std::to_string(subimage) +
                    " of MIP level " + std::to_string(miplevel));
    }
    if (begin == m_spec.y && !guarded(&ToneInput::renew))
        return false;
    const OIIO::ImageBuf& pixels = m_picture->subimages[size_t(subimage)];
    const size_t bytes = size_t(m_spec.scanline_bytes());
    auto* to = static_cast<char*>(data);
    for (int y = begin; y < end; ++y, to += bytes) {
        const void* row = pixels.pixeladdr(m_spec.x, y, z);
        if (!row || y < m_spec.y || y >= m_spec.y + m_spec.height)
            return fail("recipe \"" + m_source.file + "\" has no row " + std::to_string(y));
        std::memcpy(to, row, bytes);
    }
    return true;
}

} // namespace

OIIO::ImageInput* create_tone_input() {
    return new ToneInput;
}

void register_tone_format() {
    OIIO::declare_imageio_format("tone", create_tone_input, kToneExtensions, nullptr, nullptr,
                                 "tonetool " TONETOOL_VERSION);
}

} // namespace tonetool
