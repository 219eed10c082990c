// SPDX-License-Identifier: BSD-3-Clause
// --figure: named cases and their methods side by side, for a paper.
#pragma once

#include <OpenImageIO/imagebuf.h>
#include <optional>
#include <string>
#include <vector>

#include "sequence/report/case_pictures.h"
#include "sequence/report/report_store.h"
#include "sequence/results/results.h"

namespace tonetool::sequence {

/// A part of the picture, in the file's pixels.
struct Inset {
    int width = 0, height = 0, x = 0, y = 0;
};

struct FigureOptions {
    std::vector<std::string> names{};   ///< in that order; empty: all
    std::vector<std::string> methods{}; ///< likewise
    std::vector<Inset> insets{};        ///< empty: the whole pictures
    int scale = 0;                      ///< 0: 4 of insets, 1 of whole pictures
    std::optional<double> stops{};      ///< else the middle of the row's exposures
    int text = 16;                      ///< height of the labels in pixels
    bool dark = false;                  ///< else white, as paper is

    bool wants(const Item& item) const;
};

/// "96x64+120+40"; nullopt for anything else.
std::optional<Inset> parse_inset(const std::string& text);

/// A case's pictures as text, which another process may have drawn.
std::string figure_text(const CasePictures& pictures);

/// A row for each name: the reference with numbered frames of the insets, then the insets of
/// reference and methods, each above its error map, and the first number of each method below;
/// pixels are repeated, never filtered. At the right a bar of the errors' colours. `warning` says
/// that no font was found, or that tests beside the first were not drawn. Throws a runtime_error if
/// nothing can be drawn.
OIIO::ImageBuf figure(const ShotResult& shot, const PictureStore& pictures,
                      const FigureOptions& options, std::string& warning);

} // namespace tonetool::sequence
