// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/pixels/colorimetry.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "imagebuf/pixels/names.h"
#include "metrics/refusal.h"
#include "tonetool/pixels.h"

namespace tonetool {
namespace {

constexpr double kD65[2] = {0.3127, 0.3290};
// Exponents that files state of values that are encoded for a screen.
constexpr double kLeastGamma = 1, kMostGamma = 4;
const OIIO::TypeDesc kEightFloats("float[8]");

// Spaces by name, with the spellings of the ACES configs and ASWF's interop IDs; and with what
// headers call them, but configurations of OpenColorIO may call others.
struct Known {
    const char* name;
    bool srgb_encoded;
    Chromaticities primaries;
    std::vector<const char*> aliases, in_headers;

    bool is_interchanged(const std::string& n) const {
        const auto same = [&](const char* alias) { return n == alias; };
        return n == name || std::any_of(aliases.begin(), aliases.end(), same);
    }
    bool is_called(const std::string& n) const {
        const auto same = [&](const char* alias) { return n == alias; };
        return is_interchanged(n) || std::any_of(in_headers.begin(), in_headers.end(), same);
    }
};

const std::vector<Known>& known_spaces() {
    constexpr Chromaticities rec709 = {
        {0.640, 0.330}, {0.300, 0.600}, {0.150, 0.060}, {0.3127, 0.3290}};
    static const std::vector<Known> spaces = {
        {"rec709",
         false,
         rec709,
         {"lin_rec709", "lin_rec709_scene", "lin_srgb", "linear rec.709 (srgb)",
          "utility - linear - srgb", "utility - linear - rec.709"},
         {"rec.709", "linear", "scene_linear"}},
        {"acescg",
         false,
         {{0.713, 0.293}, {0.165, 0.830}, {0.128, 0.044}, {0.32168, 0.33767}},
         {"acescg", "lin_ap1", "lin_ap1_scene", "aces - acescg"},
         {}},
        {"aces2065-1",
         false,
         {{0.7347, 0.2653}, {0.0, 1.0}, {0.0001, -0.077}, {0.32168, 0.33767}},
         {"aces2065-1", "lin_ap0", "lin_ap0_scene", "aces - aces2065-1"},
         {"aces"}},
        {"rec2020",
         false,
         {{0.708, 0.292}, {0.170, 0.797}, {0.131, 0.046}, {0.3127, 0.3290}},
         {"lin_rec2020", "lin_rec2020_scene", "linear rec.2020", "utility - linear - rec.2020"},
         {"rec.2020"}},
        {"p3-d65",
         false,
         {{0.680, 0.320}, {0.265, 0.690}, {0.150, 0.060}, {0.3127, 0.3290}},
         {"lin_p3d65", "lin_p3d65_scene", "linear p3-d65", "utility - linear - p3-d65"},
         {"p3d65"}},
        {"srgb",
         true,
         rec709,
         {"srgb_tx", "srgb_texture", "srgb texture", "srgb_rec709_scene", "srgb - texture",
          "utility - srgb - texture", "srgb"},
         {"srgb_rec709_display", "output - srgb", "srgb - display"}}};
    return spaces;
}

const Known* find_known(const std::string& name) {
    const std::string n = lower(name);
    for (const Known& space : known_spaces())
        if (space.is_called(n))
            return &space;
    return nullptr;
}

std::string known_names() {
    return OIIO::Strutil::join(ToneAlgo::color_spaces(), ", ");
}

Matrix3 multiply(const Matrix3& a, const Matrix3& b) {
    Matrix3 out{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            for (size_t k = 0; k < 3; ++k)
                out[i][j] += a[i][k] * b[k][j];
    return out;
}

std::optional<Matrix3> inverse(const Matrix3& m) {
    const auto minor = [&](size_t i, size_t j) {
        const size_t r0 = (i + 1) % 3, r1 = (i + 2) % 3, c0 = (j + 1) % 3, c1 = (j + 2) % 3;
        return m[r0][c0] * m[r1][c1] - m[r0][c1] * m[r1][c0];
    };
    const double det = m[0][0] * minor(0, 0) + m[0][1] * minor(0, 1) + m[0][2] * minor(0, 2);
    if (!std::isfinite(det) || std::abs(det) < 1e-9)
        return std::nullopt;
    Matrix3 out{};
    for (size_t i = 0; i < 3; ++i)
        for (size_t j = 0; j < 3; ++j)
            out[i][j] = minor(j, i) / det;
    return out;
}

std::array<double, 3> xyz_of(const double (&xy)[2]) {
    return {xy[0] / xy[1], 1.0, (1.0 - xy[0] - xy[1]) / xy[1]};
}

// RGB to XYZ from primaries and white, as SMPTE RP 177 derives it.
std::optional<Matrix3> rgb_to_xyz(const Chromaticities& c) {
    const double(*primaries[3])[2] = {&c.red, &c.green, &c.blue};
    Matrix3 m{};
    for (size_t j = 0; j < 3; ++j) {
        const double x = (*primaries[j])[0], y = (*primaries[j])[1];
        m[0][j] = x;
        m[1][j] = y;
        m[2][j] = 1.0 - x - y;
    }
    const auto inv = inverse(m);
    if (!inv || !(c.white[1] > 0))
        return std::nullopt;
    const auto white = xyz_of(c.white);
    for (size_t j = 0; j < 3; ++j) {
        const double scale =
            (*inv)[j][0] * white[0] + (*inv)[j][1] * white[1] + (*inv)[j][2] * white[2];
        for (size_t i = 0; i < 3; ++i)
            m[i][j] *= scale;
    }
    return m;
}

// Bradford adaptation from one white to D65.
Matrix3 adapt_to_d65(const double (&white)[2]) {
    const Matrix3 cone{
        {{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}};
    const auto response = [&](const double(&xy)[2]) {
        const auto xyz = xyz_of(xy);
        std::array<double, 3> out{};
        for (size_t i = 0; i < 3; ++i)
            out[i] = cone[i][0] * xyz[0] + cone[i][1] * xyz[1] + cone[i][2] * xyz[2];
        return out;
    };
    const auto source = response(white), target = response(kD65);
    Matrix3 scaled = cone;
    for (size_t i = 0; i < 3; ++i)
        for (double& v : scaled[i])
            v *= target[i] / source[i];
    return multiply(*inverse(cone), scaled);
}

bool finite(const Matrix3& m) {
    return std::all_of(m.begin(), m.end(), [](const auto& row) {
        return std::all_of(row.begin(), row.end(), [](double v) { return std::isfinite(v); });
    });
}

bool nearly_equal(const Chromaticities& a, const Chromaticities& b) {
    // Two units of the third decimal: files carry rounded figures.
    const auto near = [](const double(&p)[2], const double(&q)[2]) {
        return std::abs(p[0] - q[0]) < 2e-3 && std::abs(p[1] - q[1]) < 2e-3;
    };
    return near(a.red, b.red) && near(a.green, b.green) && near(a.blue, b.blue) &&
           near(a.white, b.white);
}

// The axes of CIE XYZ as primaries.
bool is_xyz(const Chromaticities& c) {
    const Chromaticities axes = {{1, 0}, {0, 1}, {0, 0}, {c.white[0], c.white[1]}};
    return nearly_equal(c, axes);
}

std::optional<Chromaticities> read_chromaticities(const OIIO::ImageSpec& spec) {
    float v[8] = {};
    if (!spec.getattribute("chromaticities", kEightFloats, v))
        return std::nullopt;
    return Chromaticities{{v[0], v[1]}, {v[2], v[3]}, {v[4], v[5]}, {v[6], v[7]}};
}

ColorSpace space_of(const Known& known) {
    ColorSpace space;
    space.name = known.name;
    space.srgb_encoded = known.srgb_encoded;
    space.is_rec709 = nearly_equal(known.primaries, known_spaces()[0].primaries);
    if (!space.is_rec709)
        matrix_to_rec709(known.primaries, space.to_rec709);
    return space;
}

ColorSpace space_of(const Chromaticities& c) {
    for (const Known& known : known_spaces())
        if (nearly_equal(c, known.primaries))
            return space_of(known);
    ColorSpace space = {"chromaticities", false, false, {}};
    if (!matrix_to_rec709(c, space.to_rec709))
        throw Refusal(
            OIIO::Strutil::fmt::format("unusable chromaticities: red {} {}, green {} {}, blue {} "
                                       "{}, white {} {}; pass from= one of: {}",
                                       c.red[0], c.red[1], c.green[0], c.green[1], c.blue[0],
                                       c.blue[1], c.white[0], c.white[1], known_names()));
    return space;
}

// The exponent of "g18_rec709_scene", as the colour interop forum of the Academy Software
// Foundation names spaces and OpenImageIO 3.1 tags files; 0 for other tags.
double gamma_of_interop(const std::string& tag) {
    const std::string t = lower(tag);
    const bool named = t.size() >= 10 && t[0] == 'g' && t.compare(3, 7, "_rec709") == 0 &&
                       OIIO::Strutil::string_is_int(t.substr(1, 2));
    const std::string rest = named ? t.substr(10) : "";
    const bool whole = rest.empty() || rest == "_scene" || rest == "_display" || rest == "_tx";
    return named && whole ? OIIO::Strutil::stoi(t.substr(1, 2)) / 10.0 : 0;
}

// The exponent of these, and of "GammaCorrected1.8", "Gamma2.2" or "gamma2.2"; 0 for other tags.
double gamma_of_tag(const std::string& tag) {
    if (const double gamma = gamma_of_interop(tag); gamma >= kLeastGamma && gamma <= kMostGamma)
        return gamma;
    std::string number;
    for (const char* start : {"gammacorrected", "gamma"})
        if (number.empty() && OIIO::Strutil::starts_with(lower(tag), start))
            number = OIIO::Strutil::strip(tag.substr(std::string(start).size()));
    if (!OIIO::Strutil::string_is_float(number))
        return 0;
    const double gamma = double(OIIO::Strutil::stof(number));
    return gamma >= kLeastGamma && gamma <= kMostGamma ? gamma : 0;
}

ColorSpace of_gamma(double gamma) {
    ColorSpace space;
    space.name = gamma == 1 ? "rec709" : OIIO::Strutil::fmt::format("gamma{:.5g}", gamma);
    space.gamma = gamma == 1 ? 0 : gamma;
    return space;
}

// OpenImageIO's readers call the Rec.709 camera curve so, not the linear space; they put it on
// files (PPM, DPX) that are made for a screen, like every other integer file, and on PFM files,
// which hold light.
bool is_camera_curve(const OIIO::ImageSpec& spec, const std::string& tag) {
    return lower(tag) == "rec709" &&
           (!spec.format.is_floating_point() || spec.find_attribute("pnm:bigendian"));
}

// What names the space: oiio:ColorSpace, or colorInteropID where that says no more than "linear".
struct Tag {
    std::string attribute, text;
};
Tag tag_of(const OIIO::ImageSpec& spec) {
    const std::string tag = spec.get_string_attribute("oiio:ColorSpace");
    const std::string id = spec.get_string_attribute("colorInteropID");
    const bool names = !id.empty() && lower(id) != "unknown" && lower(id) != "data";
    if (names && says_only_linear(tag))
        return {"colorInteropID", id};
    return {"oiio:ColorSpace", tag};
}

ColorSpace space_of(const OIIO::ImageSpec& spec) {
    const auto [attribute, tag] = tag_of(spec);
    const auto chromaticities = read_chromaticities(spec);
    const bool camera_curve = is_camera_curve(spec, tag);
    const bool integer = !spec.format.is_floating_point();
    if (const double gamma = stated_gamma(spec); gamma > 0)
        return of_gamma(gamma);
    const Known* known = tag.empty() || lower(tag) == "rec709" ? nullptr : find_known(tag);
    if (!tag.empty() && !known && !camera_curve)
        throw Refusal("unknown colour space \"" + tag + "\" in " + attribute +
                      "; pass from= one of: " + known_names());
    // A display-encoded tag is what a conversion leaves; the file's old chromaticities stay behind.
    if (known && known->srgb_encoded)
        return space_of(*known);
    if (chromaticities && known && !says_only_linear(tag) &&
        !nearly_equal(*chromaticities, known->primaries))
        throw Refusal(attribute + " says \"" + tag +
                      "\" but the chromaticities are those of another space; pass from= one of: " +
                      known_names());
    if (chromaticities)
        return space_of(*chromaticities);
    return space_of(known ? *known : *find_known(integer ? "srgb" : "rec709"));
}

} // namespace

// Readers tag with these where the file says no more.
bool says_only_linear(const std::string& tag) {
    return tag.empty() || lower(tag) == "linear" || lower(tag) == "scene_linear";
}

std::vector<std::string> interchange_names(const std::string& name) {
    for (const Known& space : known_spaces())
        if (name == space.name)
            return {space.aliases.begin(), space.aliases.end()};
    return {};
}

bool is_interchange_name(const std::string& name) {
    const Known* known = find_known(name);
    return known && known->is_interchanged(lower(name));
}

std::vector<std::string> linear_spaces() {
    std::vector<std::string> names;
    for (const Known& space : known_spaces())
        if (!space.srgb_encoded)
            names.push_back(space.name);
    return names;
}

Matrix3 known_to_rec709(const std::string& name) {
    const Known* known = find_known(name);
    return known ? space_of(*known).to_rec709 : ColorSpace().to_rec709;
}

Matrix3 xyz_to_rec709() {
    return *inverse(*rgb_to_xyz(known_spaces()[0].primaries));
}

bool matrix_to_rec709(const Chromaticities& primaries, Matrix3& matrix) {
    const auto source = rgb_to_xyz(primaries);
    const auto rec709 = rgb_to_xyz(known_spaces()[0].primaries);
    if (!source || !rec709)
        return false;
    matrix =
        multiply(*inverse(*rec709),
                 is_xyz(primaries) ? *source : multiply(adapt_to_d65(primaries.white), *source));
    return finite(matrix);
}

ColorSpace find_space(const OIIO::ImageSpec& spec, const std::string& from) {
    const Known* known = find_known(from);
    const double gamma = gamma_of_tag(from);
    if (gamma <= 0 && !from.empty() && !known)
        throw Refusal(unknown_name("colour space", from, ToneAlgo::color_spaces()));
    ColorSpace space = gamma > 0 ? of_gamma(gamma) : known ? space_of(*known) : space_of(spec);
    space.scale = 1 / stated_exposure(spec);
    return space;
}

double stated_gamma(const OIIO::ImageSpec& spec) {
    const std::string tag = tag_of(spec).text;
    // A PNG file with a gAMA chunk and no sRGB chunk is tagged "sRGB" all the same.
    const double gamma = double(spec.get_float_attribute("oiio:Gamma"));
    const bool encoded = lower(tag) == "srgb" || tag.empty();
    if (encoded && gamma >= kLeastGamma && gamma <= kMostGamma)
        return gamma;
    return gamma_of_tag(tag);
}

double stated_exposure(const OIIO::ImageSpec& spec) {
    const double exposure = double(spec.get_float_attribute("hdr:exposure", 1));
    return std::isfinite(exposure) && exposure > 0 ? exposure : 1;
}

void drop_profile(OIIO::ImageSpec& spec) {
    spec.erase_attribute("ICCProfile");
    spec.erase_attribute("ICCProfile:.*");
    spec.erase_attribute("oiio:Gamma");
}

void retag(OIIO::ImageSpec& spec, const std::string& tag, bool same_primaries) {
    drop_profile(spec);
    for (const char* old : {"hdr:exposure", "colorInteropID", kStoredType})
        spec.erase_attribute(old);
    if (!same_primaries)
        spec.erase_attribute("chromaticities");
    spec.attribute("oiio:ColorSpace", tag);
}

void state_chromaticities(OIIO::ImageSpec& spec) {
    const std::string tag = spec.get_string_attribute("oiio:ColorSpace");
    const Known* known = says_only_linear(tag) ? nullptr : find_known(tag);
    // The name of what was converted.
    const std::string id = spec.get_string_attribute("colorInteropID");
    if ((known || gamma_of_tag(tag) > 0) &&
        (find_known(id) != known || gamma_of_tag(id) != gamma_of_tag(tag)))
        spec.erase_attribute("colorInteropID");
    if (gamma_of_tag(tag) > 0 || (known && known->srgb_encoded)) {
        spec.erase_attribute("chromaticities");
    } else if (known) {
        const Chromaticities& c = known->primaries;
        const double* const points[4] = {c.red, c.green, c.blue, c.white};
        float v[8];
        for (size_t i = 0; i < 8; ++i)
            v[i] = float(points[i / 2][i % 2]);
        spec.attribute("chromaticities", kEightFloats, v);
    }
}

double ColorSpace::light(double value, double alpha) const {
    // A pixel of alpha 0 or above 1 has not been multiplied by it.
    const double a = straight && alpha > 0 && alpha < 1 ? alpha : 1;
    value /= alpha_power == 1 ? a : std::pow(a, alpha_power);
    if (srgb_encoded)
        value = srgb_to_linear(value);
    else if (gamma > 0)
        value = std::copysign(std::pow(std::abs(value), gamma), value);
    return value * a * scale;
}

double srgb_to_linear(double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
}

double linear_to_srgb(double v) {
    return v <= 0.0031308 ? v * 12.92 : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
}

std::vector<std::string> ToneAlgo::color_spaces() {
    std::vector<std::string> names;
    for (const Known& space : known_spaces())
        names.emplace_back(space.name);
    return names;
}

} // namespace tonetool
