"""HDR image comparison and tone mapping for rendering.

Images are OpenImageIO.ImageBuf objects, or numpy arrays of float32: height x width x channels (R, G,
B first), or height x width for one channel. What a function returns is an array where it was given
one, and arrays and images change hands without a copy of their pixels (an array that is not contiguous
is copied once). Arrays are taken for linear Rec.709; pixels={"from": "srgb"} and the like say otherwise.

Options are keywords, under the names of the fields in C++. An option that is a struct there takes a
mapping of its fields, or the value of the main one: curve="agx" is curve={"name": "agx"},
pixels="beauty" is pixels={"layer": "beauty"}, calibration="mean" is calibration={"method": "mean"}.

Errors: TypeError for an argument of a wrong type and for an unknown keyword, ValueError for an array
of a wrong shape and for an unknown name; tonetool.Error, a RuntimeError, for what the library refuses,
with the message that the program prints (CheckFailed: a threshold in chain() was exceeded). Other
Python threads run while a function computes.

    >>> import OpenImageIO, tonetool
    >>> found = tonetool.hdr_flip(OpenImageIO.ImageBuf("ref.exr"), OpenImageIO.ImageBuf("test.exr"))
    >>> found.summary.pool.mean, found.map
"""

from . import _tonetool
from ._tonetool import *  # noqa: F401,F403: its __all__ is the list of what there is
from ._tonetool import CheckFailed, Error, __version__

if __doc__:  # python3 -OO has none
    __doc__ += "\nMappings of options:\n" + _tonetool._mappings

__all__ = ["CheckFailed", "Error", *_tonetool.__all__]
