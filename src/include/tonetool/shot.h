// SPDX-License-Identifier: BSD-3-Clause
// One exposure for all frames of a shot: what is measured of each, kept in files, and made of it.
//
// G. Krawczyk, K. Myszkowski, H.-P. Seidel, "Perceptual Effects in Real-time Tone Mapping" (2005),
// Eq. 6 and 7, for the time that eyes take to adapt.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <string>
#include <vector>

#include "tonetool/cgtmo.h"
#include "tonetool/export.h"
#include "tonetool/pixels.h"
#include "tonetool/shot_numbers.h"
#include "tonetool/tonemap.h"

namespace tonetool {

namespace ToneAlgo {

/// Measure a frame; its number and view are the caller's. Returns false with the reason in `error`:
/// deep images and images without colour are errors, black ones are not. The same bits with any
/// number of threads.
TONETOOL_API bool frame_light(FrameLight& light, const OIIO::ImageBuf& src, std::string& error,
                              const PixelOptions& options = {}, int nthreads = 0);

/// The exposure of a frame in the shot that `options` name.
TONETOOL_API bool shot_exposure(ShotExposure& exposure, const AdaptOptions& options,
                                std::string& error);

/// The numbers of the frames that steady=1 of CG-TMO makes a frame of, in their order: itself and
/// those up to 4 before and after that are in the statistics, between the same cuts. `frame` must
/// be set.
TONETOOL_API bool steady_window(std::vector<int>& numbers, const AdaptOptions& options,
                                std::string& error);

/// FrameLight::camera of an image; empty where its positions tell none.
TONETOOL_API bool frame_camera(std::vector<double>& camera, const OIIO::ImageBuf& src,
                               std::string& error, const CgTmoOptions& options = {},
                               int nthreads = 0);

/// How alike two frames are: the largest correlation of their thumbnails over shifts of up to two
/// cells, -1 to 1. Below 0.6 there is a cut between neighbours.
TONETOOL_API double shot_likeness(const FrameLight& a, const FrameLight& b);

/// The text of a file of statistics, "format": "tonetool-shot". Frames are in the order of their
/// numbers, whatever order they are given in.
TONETOOL_API bool shot_text(std::string& text, const ShotStatistics& shot, std::string& error);
/// The way back, to the bit.
TONETOOL_API bool shot_of_text(ShotStatistics& shot, const std::string& text, std::string& error);
TONETOOL_API bool read_shot(ShotStatistics& shot, const std::string& file, std::string& error);

/// All frames of the parts of a shot. A frame that is in two parts must be the same in both.
TONETOOL_API bool merge_shots(ShotStatistics& shot, const std::vector<ShotStatistics>& parts,
                              std::string& error);

/// Why the statistics of a shot do not tell what these options ask for, such as a median; empty:
/// they do.
TONETOOL_API std::string not_of_shots(const CgTmoOptions& options);
TONETOOL_API std::string not_of_shots(const CalibrationOptions& options);
/// Whether they ask for anything that is measured of a shot.
TONETOOL_API bool measures(const CgTmoOptions& options);
TONETOOL_API bool measures(const CalibrationOptions& options);

} // namespace ToneAlgo
} // namespace tonetool
