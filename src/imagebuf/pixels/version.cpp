// SPDX-License-Identifier: BSD-3-Clause
#include <OpenColorIO/OpenColorIO.h>
#include <OpenImageIO/imageio.h>
#include <OpenImageIO/strutil.h>

#include "kernels/curve_rows.h"
#include "tonetool/libraries.h"

namespace tonetool {

namespace {

// "openexr:OpenEXR 3.1.5;tiff:...": of what OpenImageIO's readers were built with.
std::string openexr_version() {
    // Asking for a format makes OpenImageIO list all of them.
    (void)OIIO::ImageOutput::create("exr");
    for (const std::string& one :
         OIIO::Strutil::splits(OIIO::get_string_attribute("library_list"), ";"))
        if (OIIO::Strutil::starts_with(one, "openexr:"))
            return one.substr(std::string("openexr:").size());
    return "OpenEXR unknown";
}

// In the words of processors: Highway says AVX3 for AVX-512, and adds what more there is.
std::string instruction_set() {
    const std::string name = kernels::curve_target();
    return OIIO::Strutil::starts_with(name, "AVX3") ? "AVX-512" + name.substr(4) : name;
}

} // namespace

const char* version() noexcept {
    return TONETOOL_VERSION;
}

std::vector<std::string> library_versions() {
    return {"OpenImageIO " + std::string(OIIO::get_string_attribute("version")),
            std::string("OpenColorIO ") + OCIO_NAMESPACE::GetVersion(), openexr_version(),
            "instruction set " + instruction_set()};
}

} // namespace tonetool
