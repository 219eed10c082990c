// SPDX-License-Identifier: BSD-3-Clause
// One exposure for the frames of a shot.
#include "tonetool/shot.h"

#include "imagebuf/options/shot_options.h"
#include "python/families.h"
#include "python/shot.h"

namespace tonetool::python {

template <>
const Table<AdaptOptions>& table_of<AdaptOptions>() {
    using O = AdaptOptions;
    static const Table<O> table = {
        "AdaptOptions", "adapt", "The shot that an image is exposed by", [] {
            Fields<O> fields = described<O, AdaptOptions>();
            fields.front().text = "File of a shot's statistics; \"frame\": the image has an "
                                  "exposure of its own.";
            fields.push_back({"statistics", Python<ShotStatistics>::wanted() + " | None", "None",
                              "Instead of a file; None: the file.",
                              [](O& options, py::handle value, const std::string& where) {
                                  if (!value.is_none())
                                      options.statistics =
                                          Python<ShotStatistics>::from(value, where);
                              }});
            return fields;
        }()};
    return table;
}

namespace {

const std::string kShotSource = "G. Krawczyk, K. Myszkowski, H.-P. Seidel, \"Perceptual Effects in "
                                "Real-time Tone Mapping\", 2005, Eq. 6 and 7.";

struct LightOptionsOfFrame {
    PixelOptions pixels;
    int frame = 0;
    std::string view;
    int nthreads = 0;
};

py::object frame_light(std::vector<py::object>& images, const LightOptionsOfFrame& options) {
    const InputImage image(images[0], "frame_light: image");
    FrameLight light;
    run_or_raise("frame_light", [&](std::string& error) {
        return ToneAlgo::frame_light(light, image.buf(), error, options.pixels, options.nthreads);
    });
    light.frame = options.frame;
    light.view = options.view;
    return py::cast(light);
}

py::object read_shot(std::vector<py::object>& arguments) {
    ShotStatistics shot;
    const std::string file = to_text(arguments[0], "read_shot: file");
    run_or_raise("read_shot",
                 [&](std::string& error) { return ToneAlgo::read_shot(shot, file, error); });
    return py::cast(shot);
}

py::object shot_text(std::vector<py::object>& arguments) {
    std::string text;
    const auto shot = Python<ShotStatistics>::from(arguments[0], "shot_text: statistics");
    run_or_raise("shot_text",
                 [&](std::string& error) { return ToneAlgo::shot_text(text, shot, error); });
    return to_str(text);
}

py::object shot_likeness(std::vector<py::object>& arguments) {
    const auto a = Python<FrameLight>::from(arguments[0], "shot_likeness: a");
    const auto b = Python<FrameLight>::from(arguments[1], "shot_likeness: b");
    return py::float_(ToneAlgo::shot_likeness(a, b));
}

py::object shot_exposure(std::vector<py::object>& arguments, const AdaptOptions& given) {
    AdaptOptions options = given;
    options.statistics = Python<ShotStatistics>::from(arguments[0], "shot_exposure: statistics");
    ShotExposure found;
    run_or_raise("shot_exposure", [&](std::string& error) {
        return ToneAlgo::shot_exposure(found, options, error);
    });
    return py::cast(found);
}

struct CameraOptions {
    PixelOptions pixels;
    std::string position, depth;
    int nthreads = 0;
};

py::object frame_camera(std::vector<py::object>& images, const CameraOptions& given) {
    const InputImage image(images[0], "frame_camera: image");
    CgTmoOptions options;
    options.pixels = given.pixels;
    options.position = given.position;
    options.depth = given.depth;
    std::vector<double> camera;
    run_or_raise("frame_camera", [&](std::string& error) {
        return ToneAlgo::frame_camera(camera, image.buf(), error, options, given.nthreads);
    });
    return list_of(camera);
}

py::object steady_window(std::vector<py::object>& arguments, const AdaptOptions& given) {
    AdaptOptions options = given;
    options.statistics = Python<ShotStatistics>::from(arguments[0], "steady_window: statistics");
    std::vector<int> numbers;
    run_or_raise("steady_window", [&](std::string& error) {
        return ToneAlgo::steady_window(numbers, options, error);
    });
    return list_of(numbers);
}

void add_shot_results(Module& module) {
    using F = FrameLight;
    ResultClass<F>(module, "FrameLight", "What the exposure of a shot follows from, of one frame.")
        .field("frame", &F::frame, "Its number.")
        .field("view", &F::view, "Of a stereo pair; \"\": there are none.")
        .field("lwa", &F::lwa, "Geometric mean of the means of cells; 0: it is black.")
        .field("lwa_geometric", &F::lwa_geometric, "Geometric mean of the pixels with light.")
        .field("lmax", &F::lmax, "Luminance that one of ten thousand pixels exceeds.")
        .field("maximum", &F::maximum, "The largest.")
        .field("counted", &F::counted, "Pixels with light.")
        .field("shown", &F::shown, "Share of the pixels that show something.")
        .field("unit", &F::unit, "cd/m2 of a pixel value of 1; 0: the header does not say.")
        .field("fps", &F::fps, "Frames per second; 0: the header does not say.")
        .field("histogram", &F::histogram, "Pixels by log2 of luminance, from -20, half a stop.")
        .field("thumbnail", &F::thumbnail, "ln of the means of 32 x 18 cells, by rows.")
        .field("camera", &F::camera, "Twelve numbers, as of frame_camera; []: not asked for, none.")
        .finish();
    using S = ShotStatistics;
    ResultClass<S>(module, "ShotStatistics", "The light of the frames of a shot.")
        .field("mode", &S::mode, "\"shot\", \"eye\" or \"smooth\".")
        .field("frames", &S::frames, "By number and view.")
        .finish();
    using E = ShotExposure;
    ResultClass<E>(module, "ShotExposure", "The luminances that a frame is exposed by.")
        .field("lwa", &E::lwa, "Of cells.")
        .field("lwa_geometric", &E::lwa_geometric, "Of pixels.")
        .field("lmax", &E::lmax, "What becomes white.")
        .field("first", &E::first, "First frame between the cuts.")
        .field("last", &E::last, "Last frame between the cuts.")
        .field("counted", &E::counted, "Pixels with light in all of these.")
        .field("mode", &E::mode, "\"shot\", \"eye\" or \"smooth\".")
        .field("warnings", &E::warnings, "What a user must know, one sentence each.")
        .field("notes", &E::notes, "What was assumed.")
        .finish();
}

// What says how a shot is followed, without what says which one.
Fields<AdaptOptions> fields_beside_statistics() {
    Fields<AdaptOptions> fields;
    for (const Field<AdaptOptions>& row : table_of<AdaptOptions>().fields)
        if (row.name != "adapt" && row.name != "statistics")
            fields.push_back(row);
    return fields;
}

void add_functions(Module& module) {
    const Parameter statistics{"statistics", "ShotStatistics | Sequence[FrameLight]",
                               "Of all frames of the shot, in any order.", ""};
    define(module,
           Description{
               "frame_light",
               "Measure what the exposure of a shot follows from.",
               {image_parameter("image", "Needs R, G, B.")},
               "FrameLight",
               "The figures.",
               "Shapes: height x width x channels, R, G, B first, or an ImageBuf. Units: that of "
               "the image, in linear Rec.709.\nAlpha: pixels of alpha 0 are not measured. NaN, "
               "Inf, negative: not measured.",
               "No colour, deep images, an unreadable file.",
               kShotSource},
           Fields<LightOptionsOfFrame>{
               field<LightOptionsOfFrame>("pixels", &LightOptionsOfFrame::pixels,
                                          "Layer and colour space."),
               field<LightOptionsOfFrame>("frame", &LightOptionsOfFrame::frame,
                                          "Its number in the shot."),
               field<LightOptionsOfFrame>("view", &LightOptionsOfFrame::view,
                                          "Of a stereo pair; \"\": there are none."),
               threads_field<LightOptionsOfFrame>()},
           frame_light);
    define(module,
           Description{"shot_exposure",
                       "The exposure of a frame of a shot.",
                       {statistics},
                       "ShotExposure",
                       "The luminances, and of which frames they are.",
                       "Units: that of the images. The same bits whatever order the frames have.",
                       "No frames, no light in any, a frame that is not there, a value out of "
                       "range.",
                       kShotSource},
           fields_beside_statistics(), shot_exposure);
    define(
        module,
        Description{"steady_window",
                    "The frames that cg_tmo with steady=True makes a frame of.",
                    {statistics},
                    "list[int]",
                    "Numbers: `frame` and those up to 4 before and after, between the same cuts.",
                    "Units: numbers of frames.",
                    "No `frame`, no frames, a frame that is not there.",
                    "None: it is tonetool's own."},
        fields_beside_statistics(), steady_window);
    define(module,
           Description{
               "frame_camera",
               "The camera that an image was seen by, from the positions of its pixels.",
               {image_parameter("image", "Needs R, G, B and a layer of positions of the scene.")},
               "list[float]",
               "Three rows of four numbers, of norm 1: with (a, b, c) = rows (x, y, z, 1) a point "
               "is seen at a/c and b/c in widths of the image from its middle, x to the right and "
               "y down. Empty: no camera sees 99 % of the positions within 0.25 pixels of where "
               "they are, or they are in a plane.",
               "Shapes: height x width x channels, or an ImageBuf. Units: that of the "
               "positions.\nNaN, Inf: no surface.",
               "No colour, deep images, a layer that is not there.",
               "R. Hartley, A. Zisserman, \"Multiple View Geometry in Computer Vision\", 2003, "
               "section 7.1."},
           Fields<CameraOptions>{
               field<CameraOptions>("pixels", &CameraOptions::pixels, "Layer and colour space."),
               field<CameraOptions>("position", &CameraOptions::position,
                                    "Layer or file of positions; \"\": found by its name."),
               field<CameraOptions>("depth", &CameraOptions::depth,
                                    "Layer or file of depth, which tells the background; \"\": "
                                    "found by its name."),
               threads_field<CameraOptions>()},
           frame_camera);
    define(module,
           Description{
               "shot_likeness",
               "How alike two frames are, whatever their light.",
               {{"a", "FrameLight", "One of them.", ""}, {"b", "FrameLight", "The other.", ""}},
               "float",
               "The largest correlation of their thumbnails over shifts of up to two cells.",
               "Units: -1 to 1; below 0.6 there is a cut between neighbours.",
               "Another type.",
               kShotSource},
           shot_likeness);
    define(module,
           Description{"read_shot",
                       "Read the statistics of a shot.",
                       {{"file", "str | os.PathLike", "That --statistics or shot_text made.", ""}},
                       "ShotStatistics",
                       "The statistics, to the bit.",
                       "Units: that of the images.",
                       "No such file, one of another kind, one that is damaged.",
                       kShotSource},
           read_shot);
    define(module,
           Description{"shot_text",
                       "The statistics of a shot as the text of a file.",
                       {statistics},
                       "str",
                       "JSON.",
                       "A frame that is there twice must be the same.",
                       "Two frames of one number that differ, figures that are not whole.",
                       kShotSource},
           shot_text);
}

} // namespace

void add_shot(Module& module) {
    add_shot_results(module);
    module.add_mapping(table_of<AdaptOptions>());
    add_functions(module);
}

} // namespace tonetool::python
