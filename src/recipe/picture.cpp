// SPDX-License-Identifier: BSD-3-Clause
#include "recipe/picture.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <OpenImageIO/thread.h>
#include <algorithm>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <thread>

#include "recipe/nesting.h"
#include "recipe/shelf.h"
#include "runs/runs.h"

namespace tonetool::recipe {

namespace {

// Words that a chain may run, so that an endless --while ends.
constexpr size_t kMostWords = 100000;

// In a task of OpenImageIO's pool everything runs on one thread. A reader may be called from a
// task, or while tasks wait for it, so it must never wait for the pool itself.
class WithoutPool {
public:
    WithoutPool() : m_registered(!m_pool->is_worker()) {
        if (m_registered)
            m_pool->register_worker(std::this_thread::get_id());
    }
    ~WithoutPool() {
        if (m_registered)
            m_pool->deregister_worker(std::this_thread::get_id());
    }
    WithoutPool(const WithoutPool&) = delete;
    WithoutPool& operator=(const WithoutPool&) = delete;

private:
    OIIO::thread_pool* m_pool = OIIO::default_thread_pool();
    bool m_registered;
};

std::string folder_of(const std::string& file) {
    return std::filesystem::path(file).parent_path().string();
}

// All that the picture depends on but the content of files.
std::string key_of(const Source& source, const Strings& words) {
    std::error_code ignored;
    const char* config = std::getenv("OCIO");
    const std::string folder = std::filesystem::absolute(folder_of(source.file), ignored).string();
    return folder + '\0' + (config ? config : "") + '\0' + join(words, std::string(1, '\0'));
}

std::string chain_text(const Strings& words) {
    Strings quoted;
    for (const std::string& word : words)
        quoted.push_back(shell_quoted(word));
    return join(quoted, " ");
}

// Attributes of every subimage.
struct Notes {
    std::string recipe, chain, inputs, warnings;
};

void add_subimages(Picture& picture, runs::Left& image, const Notes& notes) {
    for (size_t i = 0; i < image.subimages.size(); ++i) {
        OIIO::ImageBuf& pixels = image.subimages[i];
        if (pixels.deep())
            throw RecipeError("its image \"" + image.name + "\" is deep (valid: --flatten)");
        const bool converted = pixels.spec().format != image.formats[i];
        picture.subimages.push_back(converted ? pixels.copy(image.formats[i]) : std::move(pixels));
        OIIO::ImageSpec& spec = picture.subimages.back().specmod();
        spec.channelformats.clear();
        spec.tile_width = spec.tile_height = spec.tile_depth = 0;
        if (!image.label.empty() && image.subimages.size() == 1)
            spec.attribute("oiio:subimagename", image.label);
        spec.attribute("tone:recipe", notes.recipe);
        spec.attribute("tone:chain", notes.chain);
        spec.attribute("tone:inputs", notes.inputs);
        if (!notes.warnings.empty())
            spec.attribute("tone:warnings", notes.warnings);
        picture.bytes += size_t(spec.image_bytes());
    }
}

std::shared_ptr<Picture> make_picture(const Source& source, const Strings& words,
                                      Nesting& nesting) {
    WithoutPool serial;
    runs::Evaluation found = runs::evaluate(words, {}, {true, folder_of(source.file), kMostWords});
    nesting.note_files(found.files);
    if (found.status != 0)
        throw RecipeError(found.error.empty() ? join(found.warnings, "; ") : found.error);
    if (found.stack.empty())
        throw RecipeError("it leaves no image on the stack");
    const Notes notes{source.file, chain_text(words), join(found.files, ";"),
                      join(found.warnings, "; ")};
    auto picture = std::make_shared<Picture>();
    std::reverse(found.stack.begin(), found.stack.end());
    for (runs::Left& image : found.stack)
        add_subimages(*picture, image, notes);
    return picture;
}

PicturePtr find_or_make(const Source& source, Nesting& nesting) {
    nesting.note_files({source.file});
    const Strings words = parse(read_text(source.file), source.parameters);
    // The holder of a place waits for nobody, so that recipes that read each other, which two
    // threads begin from both ends, come to be refused.
    Shelf::Place place(key_of(source, words), nesting.is_outermost());
    if (PicturePtr known = place.picture()) {
        Strings files;
        for (const sequence::Stamp& stamp : known->inputs)
            files.push_back(stamp.file);
        nesting.note_files(files);
        return known;
    }
    const int64_t begun = sequence::now_in_nanoseconds();
    std::shared_ptr<Picture> picture = make_picture(source, words, nesting);
    Strings files = nesting.files();
    std::sort(files.begin(), files.end());
    files.erase(std::unique(files.begin(), files.end()), files.end());
    for (const std::string& file : files)
        picture->inputs.push_back(sequence::stamp_of(file));
    if (sequence::are_older(picture->inputs, begun))
        place.keep(picture);
    return picture;
}

} // namespace

Source parse_source(const std::string& name, const OIIO::ImageSpec& config) {
    Source source{name, {}};
    const size_t question = name.find('?');
    if (question != std::string::npos && !OIIO::Filesystem::exists(name)) {
        source.file = name.substr(0, question);
        for (const std::string& pair : split(name.substr(question + 1), '&')) {
            const size_t equals = pair.find('=');
            if (equals == std::string::npos || equals == 0) {
                throw RecipeError("recipe \"" + name + "\": \"" + pair +
                                  "\" is no parameter (valid: FILE.tone?name=value&name=value)");
            }
            source.parameters[pair.substr(0, equals)] = pair.substr(equals + 1);
        }
    }
    for (const OIIO::ParamValue& hint : config.extra_attribs)
        if (OIIO::Strutil::starts_with(hint.name(), "tone:"))
            source.parameters.emplace(std::string(hint.name().substr(5)), hint.get_string());
    return source;
}

PicturePtr picture_of(const Source& source) {
    Nesting nesting(source.file);
    try {
        return find_or_make(source, nesting);
    } catch (const std::exception& problem) {
        throw RecipeError(nesting.trimmed(problem.what()));
    }
}

} // namespace tonetool::recipe
