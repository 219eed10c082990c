// SPDX-License-Identifier: BSD-3-Clause
// The files that an OpenColorIO configuration refers to.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include "imagebuf/color/view_config.h"
#include "imagebuf/pixels/guard.h"

namespace tonetool {
namespace {

namespace fs = std::filesystem;

class FileWalk {
public:
    explicit FileWalk(ocio::ConstConfigRcPtr config)
        : m_config(std::move(config)),
          m_context(m_config->getCurrentContext()) {}

    std::set<std::string> files() {
        take_color_spaces();
        take_view_transforms();
        take_looks();
        take_named_transforms();
        if (m_unresolved || (!m_files.empty() && search_path_varies()))
            take_search_path();
        return std::move(m_files);
    }

private:
    void take(const ocio::ConstTransformRcPtr& transform) {
        if (const auto group = OCIO_DYNAMIC_POINTER_CAST<const ocio::GroupTransform>(transform))
            for (int i = 0; i < group->getNumTransforms(); ++i)
                take(group->getTransform(i));
        else if (const auto file = OCIO_DYNAMIC_POINTER_CAST<const ocio::FileTransform>(transform))
            take_file(file->getSrc());
    }

    // A name with a context variable, which a command may give, can be any file of the search path.
    void take_file(const std::string& name) {
        try {
            const std::string found = m_context->resolveFileLocation(name.c_str());
            m_files.insert(found);
            for (const std::string& file : ToneAlgo::lut_references(found))
                m_files.insert(file);
            m_unresolved |= has_variable(name);
        } catch (const ocio::Exception&) {
            m_unresolved = true;
        }
    }

    bool search_path_varies() const {
        for (int i = 0; i < m_config->getNumSearchPaths(); ++i)
            if (has_variable(m_config->getSearchPath(i)))
                return true;
        return false;
    }

    static bool has_variable(const std::string& text) {
        return text.find_first_of("$%") != std::string::npos;
    }

    // Up to the folder whose name depends on a variable.
    void take_search_path() {
        const fs::path folder = m_config->getWorkingDir();
        for (int i = 0; i < m_config->getNumSearchPaths(); ++i) {
            const std::string path = m_config->getSearchPath(i);
            const std::string plain = path.substr(0, path.find_first_of("$%"));
            const fs::path place =
                folder / (plain == path ? plain : plain.substr(0, plain.rfind('/') + 1));
            std::error_code why;
            for (fs::recursive_directory_iterator entry(place, why), end; !why && entry != end;
                 entry.increment(why))
                if (entry->is_regular_file(why))
                    m_files.insert(entry->path().string());
        }
    }

    void take_color_spaces() {
        const auto kind = ocio::SEARCH_REFERENCE_SPACE_ALL;
        const int count = m_config->getNumColorSpaces(kind, ocio::COLORSPACE_ALL);
        for (int i = 0; i < count; ++i) {
            const auto space = m_config->getColorSpace(
                m_config->getColorSpaceNameByIndex(kind, ocio::COLORSPACE_ALL, i));
            take(space->getTransform(ocio::COLORSPACE_DIR_TO_REFERENCE));
            take(space->getTransform(ocio::COLORSPACE_DIR_FROM_REFERENCE));
        }
    }

    void take_view_transforms() {
        for (int i = 0; i < m_config->getNumViewTransforms(); ++i) {
            const auto view = m_config->getViewTransform(m_config->getViewTransformNameByIndex(i));
            take(view->getTransform(ocio::VIEWTRANSFORM_DIR_TO_REFERENCE));
            take(view->getTransform(ocio::VIEWTRANSFORM_DIR_FROM_REFERENCE));
        }
    }

    void take_looks() {
        for (int i = 0; i < m_config->getNumLooks(); ++i) {
            const auto look = m_config->getLook(m_config->getLookNameByIndex(i));
            take(look->getTransform());
            take(look->getInverseTransform());
        }
    }

    void take_named_transforms() {
        const int count = m_config->getNumNamedTransforms(ocio::NAMEDTRANSFORM_ALL);
        for (int i = 0; i < count; ++i) {
            const auto named = m_config->getNamedTransform(
                m_config->getNamedTransformNameByIndex(ocio::NAMEDTRANSFORM_ALL, i));
            take(named->getTransform(ocio::TRANSFORM_DIR_FORWARD));
            take(named->getTransform(ocio::TRANSFORM_DIR_INVERSE));
        }
    }

    ocio::ConstConfigRcPtr m_config;
    ocio::ConstContextRcPtr m_context;
    std::set<std::string> m_files;
    bool m_unresolved = false;
};

} // namespace

std::vector<std::string> ToneAlgo::lut_references(const std::string& file) {
    std::set<std::string> known{file};
    std::vector<std::string> found, open{file};
    static const std::regex reference("<Reference[^>]*\\spath\\s*=\\s*[\"']([^\"']+)[\"']");
    while (!open.empty()) {
        const std::string name = std::move(open.back());
        open.pop_back();
        std::string text;
        const bool refers =
            OIIO::Strutil::iends_with(name, ".ctf") || OIIO::Strutil::iends_with(name, ".clf");
        if (!refers || !OIIO::Filesystem::read_text_file(name, text))
            continue;
        for (std::sregex_iterator match(text.begin(), text.end(), reference), end; match != end;
             ++match) {
            const std::string other =
                (fs::path(name).parent_path() / (*match)[1].str()).lexically_normal().string();
            if (known.insert(other).second) {
                found.push_back(other);
                open.push_back(other);
            }
        }
    }
    return found;
}

bool ToneAlgo::color_config_files(const std::string& config, std::vector<std::string>& files,
                                  std::string& error) {
    return contained(error, [&] {
        const QuietOcio quiet;
        const std::set<std::string> found =
            FileWalk(ocio::Config::CreateFromFile(config.c_str())).files();
        files.assign(found.begin(), found.end());
    });
}

} // namespace tonetool
