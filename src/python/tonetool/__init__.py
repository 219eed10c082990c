# SPDX-License-Identifier: BSD-3-Clause
"""HDR image comparison and tone mapping for rendering.

Images are OpenImageIO.ImageBuf objects, or numpy arrays of height x width (grey) or of height x width x
channels, of which there are 1 (grey), 3 (R, G, B) or 4 (R, G, B, A). image() names other channels. An
array's numbers say what they mean, as those of files do:

    float32, float16, float64   linear Rec.709; 64 bits become 32, in which everything is computed
    uint8, uint16               sRGB-encoded, 0 to 255 or 65535; alpha is 0 to 1 of that

pixels={"from": "acescg"} and the like say otherwise; other numbers (int64, bool, ...) are a TypeError.
What a function returns is an array (float32) where it was given one, and arrays and images change hands
without a copy of their pixels (float64, and an array that is not contiguous, are copied once).

Options are keywords, under the names of the fields in C++. An option that is a struct there takes a
mapping of its fields, or the value of the main one: curve="agx" is curve={"name": "agx"},
pixels="beauty" is pixels={"layer": "beauty"}, calibration="mean" is calibration={"method": "mean"}.

Errors: TypeError for an argument of a wrong type and for an unknown keyword, ValueError for an array
of a wrong shape and for an unknown name; tonetool.Error, a RuntimeError, for what the library refuses,
with the message that the program prints (CheckFailed: a threshold in chain() was exceeded). A file that
cannot be read whole (with roi=: the rows that it needs) is refused by every function, and the message
names it. Names in files may have bytes that are no UTF-8; here these are U+FFFD. Other Python threads
run while a function computes.

    >>> import OpenImageIO, tonetool
    >>> found = tonetool.hdr_flip(OpenImageIO.ImageBuf("ref.exr"), OpenImageIO.ImageBuf("test.exr"))
    >>> found.summary.pool.mean, found.map
"""

from collections import namedtuple

# Stands for an OpenImageIO.ROI where that module is missing.
_Region = namedtuple("_Region", "xbegin xend ybegin yend zbegin zend chbegin chend",
                     defaults=(0, 1, 0, 10000))

from . import _tonetool  # noqa: E402: it uses what is above
from ._tonetool import *  # noqa: F401,F403: its __all__ is the list of what there is
from ._tonetool import CheckFailed, Error, __version__

if __doc__:  # python3 -OO has none
    __doc__ += "\nMappings of options:\n" + _tonetool._mappings

__all__ = ["CheckFailed", "Error", *_tonetool.__all__]
