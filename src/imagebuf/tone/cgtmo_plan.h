// SPDX-License-Identifier: BSD-3-Clause
// The options of CG-TMO as numbers.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>

#include "imagebuf/color/tone_rows.h"
#include "tonemap/clip.h"
#include "tonemap/local.h"
#include "tonemap/wls.h"
#include "tonetool/cgtmo.h"

namespace tonetool {

enum class BaseFilter { Guided, Bilateral, Wls, None };
enum class LocalShow { Picture, Base, Detail, Share };

inline constexpr double kLuminanceSigma = 0.4; ///< in log10: Durand and Dorsey's

struct LocalPlan {
    BaseFilter filter = BaseFilter::Guided;
    LocalShow show = LocalShow::Picture;
    Encoding encode = nullptr;
    tonemap::Clip clip = tonemap::Clip::Channel;
    tonemap::LocalOperator what; ///< without the luminances of the scene and the footprint
    tonemap::WlsTerms wls;
    int half = 0;    ///< of the window, in pixels
    int samples = 0; ///< of the window; all of it where it holds no more
};

/// The options with the preset's in place of those that are unset.
CgTmoOptions with_preset(const CgTmoOptions& options);

/// Refuses steady where there is no shot to be steady in. Options have all the preset's.
void check_steady(const CgTmoOptions& options);

/// The plan of options that have all the preset's.
LocalPlan plan_local(const CgTmoOptions& options);

/// The offsets that the filter looks at.
kernels::TapSets taps_of(const LocalPlan& plan, double sigma);

} // namespace tonetool
