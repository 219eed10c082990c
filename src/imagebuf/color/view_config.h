// SPDX-License-Identifier: BSD-3-Clause
// A view of an OpenColorIO configuration, chosen and checked. Only color_source.cpp,
// view*.cpp and lut*.cpp include this.
#pragma once

#include <OpenColorIO/OpenColorIO.h>
#include <OpenImageIO/imageio.h>
#include <string>
#include <vector>

#include "imagebuf/pixels/colorimetry.h"
#include "tonetool/tonemap.h"

namespace tonetool {

namespace ocio = OCIO_NAMESPACE;

/// While one lives OpenColorIO writes no remarks to stderr: what matters comes as exceptions.
class QuietOcio {
public:
    QuietOcio();
    QuietOcio(const QuietOcio&) = delete;
    QuietOcio& operator=(const QuietOcio&) = delete;
    ~QuietOcio();
};

struct ChosenView {
    std::string file; ///< of the configuration, for messages
    ocio::ConstConfigRcPtr config;
    ocio::ConstContextRcPtr context;
    std::string display, view;
    std::string looked_at;      ///< the view with the looks that are asked for; has its own name
    std::string space;          ///< colour space of the result
    bool display_space = false; ///< whether that is a display's, not a scene's
};

/// Opens the configuration alone, with the context variables, which it must use.
ChosenView open_config(const ViewOptions& options);

ChosenView choose_view(const ViewOptions& options);

/// From a colour space of the configuration through the view.
ocio::ConstTransformRcPtr through_view(const ChosenView& chosen, const std::string& from);

/// A processor as stock programs run it.
ocio::ConstCPUProcessorRcPtr make_processor(const ChosenView& chosen,
                                            const ocio::ConstTransformRcPtr& transform);

/// The first of these names that the configuration knows as a space of scene light; else empty.
std::string find_scene_space(const ChosenView& chosen, const std::vector<std::string>& names);
/// The space that a role or a name stands for; null if there is none.
ocio::ConstColorSpaceRcPtr known_space(const ChosenView& chosen, const std::string& name);
std::vector<std::string> scene_spaces(const ChosenView& chosen);

/// A space of the configuration, and how its values become linear Rec.709.
struct SceneBridge {
    std::string space; ///< empty: there is none
    Matrix3 to_rec709{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
};
/// By one of the names of linear Rec.709, by the roles for interchange (ACES2065-1, CIE XYZ), or by
/// the names of other spaces that are known. A configuration that has none of these does not say
/// what its light is: where images are said to be in one of its spaces, `from`, its role
/// scene_linear (or else its reference, or that space) stands for Rec.709.
SceneBridge find_bridge(const ChosenView& chosen, const std::string& from = "");

ocio::MatrixTransformRcPtr matrix_transform(const Matrix3& m, double scale);

/// What OpenColorIO says, on one line.
std::string one_line(const char* message);

} // namespace tonetool
