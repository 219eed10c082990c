// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/aov/aov_names.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cctype>
#include <utility>

#include "imagebuf/pixels/names.h"

namespace tonetool {
namespace {

using OIIO::Strutil::contains;
using OIIO::Strutil::ends_with;
using OIIO::Strutil::starts_with;
using Names = std::vector<std::string>;

// Best first. World space comes before a name that may mean camera space, shading normals before
// geometric ones, what was rendered for the picture before what was rendered for a denoiser. Not
// here, on purpose: Pref, ObjectPosition (they stay when the object moves), Pz as a position,
// motion, Mist, and everything with a variance.
const Names kPositions = {
    "pworld",        // RenderMan __Pworld
    "worldposition", // V-Ray, Redshift, Unreal
    "worldpos",
    "wp",
    "p",        // Arnold, Karma, Redshift, MoonRay, pbrt; in RenderMan that of the camera
    "position", // Blender, Octane
    "pos",      // Mitsuba, by the usual name
    "hitp",     // Karma ray:hitP
    "rayhitp",
    "ppp",
};
const Names kNormals = {
    "ns",            // pbrt, beside the geometric N
    "shnormal",      // Mitsuba
    "shadingnormal", // Octane
    "bumpnormals",   // V-Ray, Redshift, beside Normals
    "nworld",        // RenderMan __Nworld
    "worldnormal",   // Unreal
    "n",             // Arnold, Karma, Redshift, MoonRay
    "normal",        // Blender, OIDN
    "normals",       // V-Ray, Redshift
    "nn",            // RenderMan, Mitsuba
    "smoothnormal",  // Octane
    "hitn",
    "rayhitn",
    "nrm",
    "denoisingnormal", // Blender
    "denoisenormal",   // Arnold, Octane
    "geonormal",
    "geometricnormal",
    "ng",
};
const Names kAlbedos = {
    "albedo",            // Arnold, RenderMan, Karma, pbrt, Mitsuba, OIDN
    "basecolor",         // Unreal
    "diffcol",           // Blender up to 4
    "diffusecolor",      // Blender 5
    "diffusefilter",     // V-Ray, Redshift
    "diffusefilterinfo", // Octane
    "diffusealbedo",     // Arnold, Karma
    "alb",
    "denoisingalbedo", // Blender
    "denoisealbedo",   // Arnold, Octane
    "diffuse",         // V-Ray only: elsewhere it is light
};
const Names kDepths = {
    "depth",      // Blender, Karma, Redshift, RenderMan __depth
    "z",          // Arnold, RenderMan, Redshift
    "worlddepth", // Unreal
    "zdepth",     // V-Ray, Octane
    "pz",         // Karma
    "hitpz",
    "rayhitpz",
    "dist",
    "distance",
    "dd",
    "denoisingdepth", // Blender
    "zfiltered",      // RenderMan
};

struct Words {
    AovKind kind;
    Names whole;  ///< names of passes that are no guides
    Names within; ///< words that tell wherever they stand in a name
};

// In this order: a variance of normals is a statistic, and so is what a denoiser wants of it.
const std::vector<Words>& known_words() {
    static const std::vector<Words> words = {
        {AovKind::Id,
         {"id", "ids", "objectindex", "materialindex", "indexob", "indexma", "shapeindex",
          "primindex", "primid", "lightindex", "instanceid", "multimatte", "puzzlematte"},
         {"crypto", "objectid", "materialid", "renderid", "nodeid", "assetid", "hitproxymask"}},
        {AovKind::Statistic,
         {"mse", "var", "samples", "aasamples", "samplerate", "sampleinfo", "cputime", "time"},
         {"variance", "samplecount", "samplerate"}},
        {AovKind::Motion,
         {"vector", "vectors", "mv", "mvec", "speed", "flow", "opticalflow", "motionvec", "vel"},
         {"motion", "velocity"}},
        {AovKind::Position,
         {"pref", "pobj", "pobject", "pcam", "pcamera", "peye", "pworldref", "wpos", "posw", "wpp",
          "restposition", "rest", "pointworld", "worldpoint", "location"},
         {"position", "worldpos", "pworld"}},
        {AovKind::Normal,
         {"norm", "norms", "nrml", "nrms", "nref", "neye", "ncam", "ncamera", "nobj", "nobject",
          "wn", "tangents", "dpdu", "dpdv", "dpdus", "dpdvs", "smoothn", "nsmooth", "ngworld"},
         {"normal", "nworld", "tangent", "binormal"}},
        {AovKind::Albedo,
         {"glosscol", "transcol", "subsurfacecol", "glossycolor", "transmissioncolor",
          "subsurfacecolor", "reflectionfilter", "refractionfilter", "reflectionfilterinfo",
          "refractionfilterinfo", "transmissionfilterinfo", "reflectfilter", "refractfilter",
          "texturecolor", "speccolor", "specularcolor", "diffusetint"},
         {"albedo", "basecolor", "diffusefilter"}},
        {AovKind::Depth,
         {"zbuffer", "zbuf", "zback", "mist", "deep", "dofdepth", "zcam", "zw", "rayhitdist"},
         {"depth", "distance"}},
        {AovKind::Coordinates,
         {"uv", "uvs", "st", "sts", "uvw", "uvpass", "texcoord", "barycentric", "objectcoords",
          "generated", "duvdx", "duvdy", "dzdx", "dzdy", "dudx", "dvdy"},
         {"texcoord", "texturecoord"}},
    };
    return words;
}

bool has(const Names& names, const std::string& word) {
    return std::find(names.begin(), names.end(), word) != names.end();
}

// A name that a layer of light has all the same.
bool tells_light(const std::string& pass) {
    return contains(pass, "normaliz") || contains(pass, "normalis") || contains(pass, "depthof");
}

AovKind kind_of_pass(const std::string& pass) {
    for (const Words& words : known_words()) {
        const bool guide = pass != "diffuse" && has(guide_passes(words.kind), pass);
        if (guide || has(words.whole, pass))
            return words.kind;
    }
    if (tells_light(pass))
        return AovKind::Light;
    for (const Words& words : known_words())
        for (const std::string& word : words.within)
            if (contains(pass, word))
                return words.kind;
    return AovKind::Light;
}

// "N" of "N_world": what follows says only which normals, or how they were made.
std::string first_word(const std::string& layer_name) {
    static const Names remarks = {"world",  "camera",   "cam",  "object",   "obj",   "view",
                                  "screen", "filtered", "raw",  "denoised", "noisy", "aov",
                                  "pass",   "layer",    "map",  "ref",      "rest",  "local",
                                  "space",  "buffer",   "data", "closest",  "min",   "max"};
    const size_t end = layer_name.find_first_of(" _-:", 1);
    if (end == std::string::npos)
        return "";
    std::string rest = layer_name.substr(end);
    for (char& c : rest)
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : ' ';
    for (const std::string& word : OIIO::Strutil::splits(rest))
        if (!has(remarks, lower(word)) && !OIIO::Strutil::string_is_int(word))
            return "";
    return plain_word(layer_name.substr(0, end));
}

} // namespace

const char* plural_of(AovKind kind) {
    constexpr const char* names[] = {"light",
                                     "positions",
                                     "normals",
                                     "albedo",
                                     "depths",
                                     "motion",
                                     "coordinates",
                                     "numbers of objects",
                                     "statistics of samples"};
    return names[size_t(kind)];
}

const Names& guide_passes(AovKind kind) {
    static const Names none;
    switch (kind) {
    case AovKind::Position:
        return kPositions;
    case AovKind::Normal:
        return kNormals;
    case AovKind::Albedo:
        return kAlbedos;
    case AovKind::Depth:
        return kDepths;
    default:
        return none;
    }
}

std::string bare_pass(const std::string& pass) {
    if (starts_with(pass, "vray"))
        return pass.substr(4);
    if (starts_with(pass, "finalimage"))
        for (const char* end : {"worlddepth", "worldposition", "worldnormal", "basecolor"})
            if (ends_with(pass, end))
                return end;
    return pass;
}

AovKind kind_of_layer(const std::string& layer_name) {
    const AovKind whole = kind_of_pass(bare_pass(plain_word(layer_name)));
    const std::string first = first_word(layer_name);
    return whole != AovKind::Light || first.empty() ? whole : kind_of_pass(first);
}

std::string plain_word(const std::string& name) {
    std::string word;
    for (const char c : lower(name)) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) || byte >= 0x80) // letters of other alphabets tell names apart
            word += c;
    }
    return word;
}

bool is_eye(const std::string& word) {
    return has({"left", "right", "l", "r", "lft", "rgt", "lefteye", "righteye", "eyeleft",
                "eyeright", "eyel", "eyer", "lefteyeview", "righteyeview"},
               word);
}

} // namespace tonetool
