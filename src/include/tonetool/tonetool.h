// SPDX-License-Identifier: BSD-3-Clause
// Everything tonetool offers to C++.
#pragma once

#include "tonetool/against.h"
#include "tonetool/bias.h"
#include "tonetool/cgtmo.h"
#include "tonetool/color_tags.h"
#include "tonetool/compare.h"
#include "tonetool/display.h"
#include "tonetool/errors.h"
#include "tonetool/export.h"
#include "tonetool/flip.h"
#include "tonetool/libraries.h"
#include "tonetool/lights.h"
#include "tonetool/luminance.h"
#include "tonetool/lut.h"
#include "tonetool/parts.h"
#include "tonetool/pixels.h"
#include "tonetool/qc.h"
#include "tonetool/texture.h"
#include "tonetool/tmqi.h"
#include "tonetool/tonemap.h"
#include "tonetool/write.h"
