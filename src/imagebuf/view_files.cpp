// The files that an OpenColorIO configuration refers to.
#include <OpenImageIO/filesystem.h>
#include <algorithm>
#include <filesystem>
#include <set>

#include "imagebuf/guard.h"
#include "imagebuf/view_config.h"

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
        if (m_unresolved)
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

    // A name with a context variable that only a command gives can be any file of the search path.
    void take_file(const char* name) {
        try {
            m_files.insert(m_context->resolveFileLocation(name));
        } catch (const ocio::Exception&) {
            m_unresolved = true;
        }
    }

    void take_search_path() {
        const fs::path folder = m_config->getWorkingDir();
        for (int i = 0; i < m_config->getNumSearchPaths(); ++i) {
            const fs::path place = folder / m_context->resolveStringVar(m_config->getSearchPath(i));
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

bool ToneAlgo::color_config_files(const std::string& config, std::vector<std::string>& files,
                                  std::string& error) {
    return contained(error, [&](std::string&) {
        const QuietOcio quiet;
        const std::set<std::string> found =
            FileWalk(ocio::Config::CreateFromFile(config.c_str())).files();
        files.assign(found.begin(), found.end());
        return true;
    });
}

} // namespace tonetool
