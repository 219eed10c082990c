# Made from the module by src/scripts/write_stubs.py: do not edit.
import os
from collections.abc import Mapping, Sequence
from typing import Literal, TypedDict, Union

import numpy as np
from numpy.typing import NDArray
from OpenImageIO import ROI, ImageBuf

# Image and the mappings of options are for annotations: the module does not have them.
Image = Union[
    ImageBuf,
    NDArray[np.float32],
    NDArray[np.float16],
    NDArray[np.float64],
    NDArray[np.uint8],
    NDArray[np.uint16],
]

__version__: str

class Error(RuntimeError): ...

class CheckFailed(Error):
    result: ChainResult

PixelOptions = TypedDict(
    "PixelOptions",
    {
        "layer": str,
        "from": str,
    },
    total=False,
)

class ColorChoice:
    """Where the colour of an image is."""

    @property
    def r(self) -> int: ...
    @property
    def g(self) -> int: ...
    @property
    def b(self) -> int: ...
    @property
    def a(self) -> int: ...
    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...
    @property
    def display_encoded(self) -> bool: ...

class FlipPool:
    """Pooled values of an error map."""

    @property
    def mean(self) -> float: ...
    @property
    def weighted_q1(self) -> float: ...
    @property
    def weighted_median(self) -> float: ...
    @property
    def weighted_q3(self) -> float: ...
    @property
    def p50(self) -> float: ...
    @property
    def p95(self) -> float: ...
    @property
    def p99(self) -> float: ...
    @property
    def p999(self) -> float: ...
    @property
    def min(self) -> float: ...
    @property
    def max(self) -> float: ...
    @property
    def min_x(self) -> int: ...
    @property
    def min_y(self) -> int: ...
    @property
    def max_x(self) -> int: ...
    @property
    def max_y(self) -> int: ...
    @property
    def histogram(self) -> list[int]: ...
    @property
    def pixels(self) -> int: ...
    @property
    def further(self) -> dict[str, float]: ...

class FlipSide:
    """How one image was read and what was found in it."""

    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...
    @property
    def nonfinite(self) -> int: ...
    @property
    def negative(self) -> int: ...
    @property
    def uncovered(self) -> int: ...

class FlipSummary:
    """What FLIP found, and what it was found with."""

    @property
    def pool(self) -> FlipPool: ...
    @property
    def reference(self) -> FlipSide: ...
    @property
    def test(self) -> FlipSide: ...
    @property
    def nonfinite_both(self) -> int: ...
    @property
    def nonfinite_unlike(self) -> int: ...
    @property
    def alpha_ignored(self) -> int: ...
    @property
    def region(self) -> ROI: ...
    @property
    def alpha_compared(self) -> bool: ...
    @property
    def alpha_mean(self) -> float: ...
    @property
    def alpha_max(self) -> float: ...
    @property
    def alpha_max_x(self) -> int: ...
    @property
    def alpha_max_y(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def ppd(self) -> float: ...
    @property
    def hdr(self) -> bool: ...
    @property
    def tonemapper(self) -> str: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    @property
    def on(self) -> str: ...
    @property
    def coeffs(self) -> list[float]: ...
    @property
    def bright(self) -> float: ...
    @property
    def baked(self) -> bool: ...
    @property
    def bake_error_max(self) -> float: ...
    @property
    def bake_error_mean(self) -> float: ...
    @property
    def exposures(self) -> list[float]: ...
    @property
    def max_luminance(self) -> float: ...
    @property
    def median_luminance(self) -> float: ...
    @property
    def median_of_lit(self) -> bool: ...

class FlipExposure:
    """One exposure of HDR-FLIP."""

    @property
    def stops(self) -> float: ...
    @property
    def reference(self) -> Image: ...
    @property
    def test(self) -> Image: ...
    @property
    def flip(self) -> Image: ...

class FlipResult:
    """The map of FLIP and its summary."""

    @property
    def map(self) -> Image: ...
    @property
    def summary(self) -> FlipSummary: ...
    @property
    def exposure_stops(self) -> Image | None: ...
    @property
    def exposure_index(self) -> Image | None: ...
    @property
    def exposures(self) -> list[FlipExposure]: ...

class FilmstripResult:
    """A filmstrip and its summary."""

    @property
    def image(self) -> Image: ...
    @property
    def summary(self) -> FlipSummary: ...

class ErrorSummary:
    """A measure of the error, and how it was made."""

    @property
    def metric(self) -> str: ...
    @property
    def value(self) -> float: ...
    @property
    def decibels(self) -> bool: ...
    @property
    def eps(self) -> float: ...
    @property
    def peak(self) -> float: ...
    @property
    def exposures(self) -> list[float]: ...
    @property
    def max_luminance(self) -> float: ...
    @property
    def median_luminance(self) -> float: ...
    @property
    def median_of_lit(self) -> bool: ...
    @property
    def pool(self) -> FlipPool: ...
    @property
    def reference(self) -> FlipSide: ...
    @property
    def test(self) -> FlipSide: ...
    @property
    def nonfinite_both(self) -> int: ...
    @property
    def nonfinite_unlike(self) -> int: ...
    @property
    def alpha_ignored(self) -> int: ...
    @property
    def region(self) -> ROI: ...
    @property
    def alpha_compared(self) -> bool: ...
    @property
    def alpha_mean(self) -> float: ...
    @property
    def alpha_max(self) -> float: ...
    @property
    def alpha_max_x(self) -> int: ...
    @property
    def alpha_max_y(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...

class ErrorResult:
    """The map of an error and its summary."""

    @property
    def map(self) -> Image: ...
    @property
    def summary(self) -> ErrorSummary: ...

class TmqiScore:
    """The tone-mapped image quality index, 0 to 1, and its parts."""

    @property
    def q(self) -> float: ...
    @property
    def s(self) -> float: ...
    @property
    def n(self) -> float: ...
    @property
    def scales(self) -> list[float]: ...
    @property
    def mean(self) -> float: ...
    @property
    def deviation(self) -> float: ...

class TmqiSummary:
    """What TMQI found, and in what."""

    @property
    def score(self) -> TmqiScore: ...
    @property
    def hdr(self) -> FlipSide: ...
    @property
    def ldr(self) -> FlipSide: ...
    @property
    def region(self) -> ROI: ...
    @property
    def warnings(self) -> list[str]: ...

class TmqiResult:
    """The map of structural fidelity and the index."""

    @property
    def map(self) -> Image: ...
    @property
    def summary(self) -> TmqiSummary: ...

CurveOptions = TypedDict(
    "CurveOptions",
    {
        "name": str,
        "parameters": Mapping[str, float],
        "coeffs": Sequence[float],
        "on": str,
        "saturation": float,
    },
    total=False,
)

ViewOptions = TypedDict(
    "ViewOptions",
    {
        "config": str,
        "display": str,
        "view": str,
        "looks": str,
        "context": Mapping[str, str],
    },
    total=False,
)

CalibrationOptions = TypedDict(
    "CalibrationOptions",
    {
        "method": Literal["manual", "mean", "auto"],
        "stops": float,
        "key": float,
        "level": int,
        "epsilon": float,
        "skip_black": bool,
        "skip_transparent": bool,
        "white_percentile": float | None,
    },
    total=False,
)

class CalibrationSummary:
    """The exposure that was found."""

    @property
    def mean(self) -> float: ...
    @property
    def key(self) -> float: ...
    @property
    def exposure(self) -> float: ...
    @property
    def white(self) -> float: ...
    @property
    def pixels(self) -> int: ...

class TonemapSummary:
    """What a picture was tone mapped with."""

    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...
    @property
    def curve(self) -> str: ...
    @property
    def parameters(self) -> dict[str, float]: ...
    @property
    def on(self) -> str: ...
    @property
    def calibration(self) -> CalibrationSummary: ...
    @property
    def nonfinite(self) -> int: ...
    @property
    def negative(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...

class TonemapResult:
    """A tone-mapped picture and its summary."""

    @property
    def image(self) -> Image: ...
    @property
    def summary(self) -> TonemapSummary: ...

class CalibrateResult:
    """An exposed picture and its summary."""

    @property
    def image(self) -> Image: ...
    @property
    def summary(self) -> CalibrationSummary: ...

class ToneCurveParameter:
    """A parameter of a tone curve."""

    @property
    def name(self) -> str: ...
    @property
    def help(self) -> str: ...
    @property
    def value(self) -> float: ...
    @property
    def low(self) -> float: ...
    @property
    def high(self) -> float: ...
    @property
    def flip_value(self) -> float: ...

class ToneCurveInfo:
    """A tone curve of the registry."""

    @property
    def name(self) -> str: ...
    @property
    def title(self) -> str: ...
    @property
    def source(self) -> str: ...
    @property
    def formula(self) -> str: ...
    @property
    def note(self) -> str: ...
    @property
    def domain(self) -> str: ...
    @property
    def encoded(self) -> bool: ...
    @property
    def parameters(self) -> list[ToneCurveParameter]: ...
    @property
    def coefficients(self) -> list[float]: ...

class CgTmoSummary:
    """What CG-TMO found and used."""

    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...
    @property
    def position(self) -> str: ...
    @property
    def normal(self) -> str: ...
    @property
    def albedo(self) -> str: ...
    @property
    def depth(self) -> str: ...
    @property
    def adaptation(self) -> float: ...
    @property
    def maximum(self) -> float: ...
    @property
    def adaptation_from(self) -> str: ...
    @property
    def maximum_from(self) -> str: ...
    @property
    def maximum_light(self) -> str: ...
    @property
    def light_index(self) -> str: ...
    @property
    def footprint(self) -> float: ...
    @property
    def samples(self) -> int: ...
    @property
    def background(self) -> int: ...
    @property
    def nonfinite(self) -> int: ...
    @property
    def negative(self) -> int: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def notes(self) -> list[str]: ...

class CgTmoResult:
    """A tone-mapped picture and its summary."""

    @property
    def image(self) -> Image: ...
    @property
    def summary(self) -> CgTmoSummary: ...

LightOptions = TypedDict(
    "LightOptions",
    {
        "table": str,
        "unit": str,
        "layer": str,
        "index": str,
        "groups": Sequence[str],
    },
    total=False,
)

class LightGroupSummary:
    """A group of lights in an image."""

    @property
    def name(self) -> str: ...
    @property
    def layer(self) -> str: ...
    @property
    def pixels(self) -> int: ...
    @property
    def maximum(self) -> float: ...
    @property
    def luminance(self) -> float | None: ...

class LightIndexSummary:
    """The light groups of an image."""

    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...
    @property
    def groups(self) -> list[LightGroupSummary]: ...
    @property
    def unlit(self) -> int: ...
    @property
    def sum(self) -> float: ...
    @property
    def difference(self) -> float: ...
    @property
    def warnings(self) -> list[str]: ...

class LightIndexResult:
    """The index of lights and its summary."""

    @property
    def map(self) -> Image: ...
    @property
    def summary(self) -> LightIndexSummary: ...

class PanoramaStats:
    """Luminances of a latitude-longitude panorama."""

    @property
    def pixels(self) -> int: ...
    @property
    def nonfinite(self) -> int: ...
    @property
    def negative(self) -> int: ...
    @property
    def uncovered(self) -> int: ...
    @property
    def geometric(self) -> float: ...
    @property
    def harmonic(self) -> float: ...
    @property
    def mean(self) -> float: ...
    @property
    def median(self) -> float: ...
    @property
    def max(self) -> float: ...
    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...

class LuminanceStats:
    """Luminance over the finite pixels of an image."""

    @property
    def pixels(self) -> int: ...
    @property
    def nonfinite(self) -> int: ...
    @property
    def negative(self) -> int: ...
    @property
    def black(self) -> int: ...
    @property
    def min(self) -> float: ...
    @property
    def max(self) -> float: ...
    @property
    def mean(self) -> float: ...
    @property
    def median(self) -> float: ...
    @property
    def median_lit(self) -> float: ...
    @property
    def log_average(self) -> float: ...
    @property
    def p1(self) -> float: ...
    @property
    def p99(self) -> float: ...
    @property
    def p999(self) -> float: ...
    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...

class LutSummary:
    """What was written, and how far from the exact curve it is."""

    @property
    def format(self) -> str: ...
    @property
    def structure(self) -> str: ...
    @property
    def input(self) -> str: ...
    @property
    def low(self) -> float: ...
    @property
    def high(self) -> float: ...
    @property
    def max_error(self) -> float: ...
    @property
    def mean_error(self) -> float: ...
    @property
    def grey_max_error(self) -> float: ...
    @property
    def samples(self) -> int: ...

class QcSpot:
    """A pixel, and what it has."""

    @property
    def x(self) -> int: ...
    @property
    def y(self) -> int: ...
    @property
    def value(self) -> float: ...
    @property
    def around(self) -> float: ...

class QcCount:
    """How many pixels have something."""

    @property
    def pixels(self) -> int: ...
    @property
    def first(self) -> list[QcSpot]: ...

class QcLayer:
    """The values of a layer."""

    @property
    def name(self) -> str: ...
    @property
    def kind(self) -> str: ...
    @property
    def constant(self) -> bool: ...
    @property
    def lit(self) -> int: ...
    @property
    def min(self) -> float: ...
    @property
    def max(self) -> float: ...
    @property
    def mean(self) -> float: ...
    @property
    def nan(self) -> QcCount: ...
    @property
    def inf(self) -> QcCount: ...
    @property
    def negative(self) -> QcCount: ...

class QcPart:
    """The header of a part of the file."""

    @property
    def name(self) -> str: ...
    @property
    def data(self) -> list[int]: ...
    @property
    def display(self) -> list[int]: ...
    @property
    def compression(self) -> str: ...
    @property
    def metadata(self) -> dict[str, str]: ...

class QcPicture:
    """The colour that a viewer looks at."""

    @property
    def layer(self) -> str: ...
    @property
    def space(self) -> str: ...
    @property
    def thumbnail(self) -> list[int]: ...
    @property
    def peaks(self) -> list[int]: ...
    @property
    def hash(self) -> str: ...
    @property
    def alpha_low(self) -> QcCount: ...
    @property
    def alpha_high(self) -> QcCount: ...
    @property
    def spike_count(self) -> int: ...
    @property
    def spikes(self) -> list[QcSpot]: ...
    @property
    def groups(self) -> int: ...
    @property
    def group_sum(self) -> float: ...
    @property
    def group_difference(self) -> float: ...
    @property
    def group_worst(self) -> QcSpot: ...

class QcFacts:
    """Facts of a picture's header and pixels."""

    @property
    def parts(self) -> list[QcPart]: ...
    @property
    def channels(self) -> dict[str, str]: ...
    @property
    def layers(self) -> list[QcLayer]: ...
    @property
    def picture(self) -> QcPicture: ...

class ChainResult:
    """What a command line has left."""

    @property
    def images(self) -> list[Image]: ...
    @property
    def names(self) -> list[str]: ...
    @property
    def out(self) -> str: ...
    @property
    def warnings(self) -> list[str]: ...
    @property
    def status(self) -> int: ...

def find_color(
    image: Image,
    *,
    layer: str = ...,
    from_: str = ...,
) -> ColorChoice: ...

def color_layers(
    image: Image,
) -> list[str]: ...

def color_spaces() -> list[str]: ...

def image(
    pixels: Image,
    *,
    channels: Sequence[str] = ...,
) -> ImageBuf: ...

def flip_quantity(
    pool: FlipPool,
    name: str,
) -> float: ...

def ldr_flip(
    reference: Image,
    test: Image,
    *,
    pixels: PixelOptions | str | None = ...,
    size: Literal["match", "resize", "crop"] = ...,
    alpha: Literal["ignore", "error"] = ...,
    memory: int = ...,
    quantities: Sequence[str] = ...,
    ppd: float | None = ...,
    distance: float = ...,
    width: float = ...,
    pixels_across: float = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> FlipResult: ...

def hdr_flip(
    reference: Image,
    test: Image | Sequence[Image],
    *,
    pixels: PixelOptions | str | None = ...,
    size: Literal["match", "resize", "crop"] = ...,
    alpha: Literal["ignore", "error"] = ...,
    memory: int = ...,
    quantities: Sequence[str] = ...,
    ppd: float | None = ...,
    distance: float = ...,
    width: float = ...,
    pixels_across: float = ...,
    curve: CurveOptions | str | None = ...,
    view: ViewOptions | str | None = ...,
    encoding: str = ...,
    peak: float | None = ...,
    exact: bool = ...,
    start_exposure: float | None = ...,
    stop_exposure: float | None = ...,
    num_exposures: int | None = ...,
    max_luminance: float | None = ...,
    median_luminance: float | None = ...,
    want_exposure_map: bool = ...,
    want_exposures: bool = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> FlipResult: ...

def flip_filmstrip(
    reference: Image,
    test: Image,
    *,
    pixels: PixelOptions | str | None = ...,
    size: Literal["match", "resize", "crop"] = ...,
    alpha: Literal["ignore", "error"] = ...,
    memory: int = ...,
    quantities: Sequence[str] = ...,
    ppd: float | None = ...,
    distance: float = ...,
    width: float = ...,
    pixels_across: float = ...,
    curve: CurveOptions | str | None = ...,
    view: ViewOptions | str | None = ...,
    encoding: str = ...,
    peak: float | None = ...,
    exact: bool = ...,
    start_exposure: float | None = ...,
    stop_exposure: float | None = ...,
    num_exposures: int | None = ...,
    max_luminance: float | None = ...,
    median_luminance: float | None = ...,
    want_exposure_map: bool = ...,
    want_exposures: bool = ...,
    thumb_width: int = ...,
    max_columns: int = ...,
    font: str = ...,
    nthreads: int = ...,
) -> FilmstripResult: ...

def flip_tonemappers() -> list[str]: ...

def flip_quantities() -> list[str]: ...

def error_map(
    reference: Image,
    test: Image,
    *,
    metric: str = ...,
    eps: float = ...,
    peak: float = ...,
    start_exposure: float | None = ...,
    stop_exposure: float | None = ...,
    num_exposures: int | None = ...,
    pixels: PixelOptions | str | None = ...,
    size: Literal["match", "resize", "crop"] = ...,
    alpha: Literal["ignore", "error"] = ...,
    memory: int = ...,
    quantities: Sequence[str] = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> ErrorResult: ...

def error_metrics() -> list[str]: ...

def tmqi(
    hdr: Image,
    ldr: Image,
    *,
    hdr_pixels: PixelOptions | str | None = ...,
    ldr_pixels: PixelOptions | str | None = ...,
    crop: bool = ...,
    memory: int = ...,
    nthreads: int = ...,
) -> TmqiResult: ...

def tmqi_quantity(
    score: TmqiScore,
    name: str,
) -> float: ...

def tmqi_quantities() -> list[str]: ...

def tonemap(
    image: Image,
    *,
    curve: CurveOptions | str | None = ...,
    view: ViewOptions | str | None = ...,
    calibration: CalibrationOptions | str | None = ...,
    pixels: PixelOptions | str | None = ...,
    primaries: str = ...,
    encode: str = ...,
    clamp: bool = ...,
    unpremult: bool = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> TonemapResult: ...

def calibrate(
    image: Image,
    *,
    method: Literal["manual", "mean", "auto"] = ...,
    stops: float = ...,
    key: float = ...,
    level: int = ...,
    epsilon: float = ...,
    skip_black: bool = ...,
    skip_transparent: bool = ...,
    white_percentile: float | None = ...,
    pixels: PixelOptions | str | None = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> CalibrateResult: ...

def display_encodings() -> list[str]: ...

def tone_curves() -> list[ToneCurveInfo]: ...

def tone_curve_names() -> list[str]: ...

def tone_curve_response(
    values: Sequence[float],
    *,
    name: str = ...,
    parameters: Mapping[str, float] = ...,
    coeffs: Sequence[float] = ...,
    on: str = ...,
    saturation: float = ...,
) -> NDArray[np.float64]: ...

def cg_tmo(
    image: Image,
    *,
    pixels: PixelOptions | str | None = ...,
    preset: str = ...,
    domain: str = ...,
    lumsigma: float | None = ...,
    position: str = ...,
    normal: str = ...,
    albedo: str = ...,
    depth: str = ...,
    fov: float | None = ...,
    strict: bool = ...,
    sigma: float = ...,
    samples: int = ...,
    normaldist: str = ...,
    footprint: str = ...,
    filter: str = ...,
    wlsalpha: float | None = ...,
    wlslambda: float | None = ...,
    lwa: str = ...,
    env: str = ...,
    weight: str = ...,
    lmax: float | None = ...,
    maximum: str = ...,
    max_percentile: float = ...,
    lights: LightOptions | str | None = ...,
    bias: float = ...,
    ldmax: float = ...,
    saturation: float = ...,
    encode: str = ...,
    clamp: bool = ...,
    show: str = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> CgTmoResult: ...

def light_index(
    image: Image,
    *,
    table: str = ...,
    unit: str = ...,
    layer: str = ...,
    index: str = ...,
    groups: Sequence[str] = ...,
    pixels: PixelOptions | str | None = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> LightIndexResult: ...

def panorama_stats(
    image: Image,
    *,
    pixels: PixelOptions | str | None = ...,
    weight: str = ...,
    nthreads: int = ...,
) -> PanoramaStats: ...

def luminance_stats(
    image: Image,
    *,
    pixels: PixelOptions | str | None = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> LuminanceStats: ...

def exposure(
    image: Image,
    stops: float,
    *,
    pixels: PixelOptions | str | None = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> Image: ...

def color_map(
    image: Image,
    map: str | Sequence[float],
    *,
    channel: int = ...,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> Image: ...

def color_maps() -> list[str]: ...

def encode_srgb(
    image: Image,
    *,
    roi: ROI | None = ...,
    nthreads: int = ...,
) -> Image: ...

def export_lut(
    filename: str | os.PathLike[str],
    *,
    curve: CurveOptions | str | None = ...,
    view: ViewOptions | str | None = ...,
    from_: str = ...,
    encode: str = ...,
    shaper: str = ...,
    min: float = ...,
    max: float = ...,
    size: int = ...,
) -> LutSummary: ...

def lut_shapers() -> list[str]: ...

def lut_formats() -> list[str]: ...

def qc_facts(
    image: Image,
    *,
    pixels: PixelOptions | str | None = ...,
    groups: Sequence[str] = ...,
    nthreads: int = ...,
) -> QcFacts: ...

def write_image(
    image: Image,
    filename: str | os.PathLike[str],
    *,
    format: str = ...,
    compression: str = ...,
) -> None: ...

def write_images(
    images: Sequence[Image],
    filename: str | os.PathLike[str],
    *,
    format: str = ...,
    compression: str = ...,
) -> None: ...

def write_bytes(
    data: bytes,
    filename: str | os.PathLike[str],
) -> None: ...

def remove_abandoned_outputs(
    filenames: Sequence[str],
) -> None: ...

def remove_unfinished_outputs() -> None: ...

def chain(
    command: str | Sequence[str],
    images: Sequence[Image] | None = ...,
    *,
    read_only: bool = ...,
) -> ChainResult: ...
