// SPDX-License-Identifier: BSD-3-Clause
#include "imagebuf/lut/lut_write.h"

#include <OpenImageIO/strutil.h>
#include <algorithm>
#include <array>
#include <locale>
#include <sstream>

#include "metrics/refusal.h"

namespace tonetool {
namespace {

using OIIO::Strutil::fmt::format;

std::string triple(const float (&v)[3]) {
    return format("{:.6g} {:.6g} {:.6g}", v[0], v[1], v[2]);
}

std::vector<std::string> lines_of(const LutRemarks& remarks) {
    std::vector<std::string> lines = {remarks.title, "input: " + remarks.taken(),
                                      "result: " + remarks.output};
    if (!remarks.note.empty())
        lines.push_back(remarks.note);
    return lines;
}

std::string cube_text(const LutSteps& steps, const LutRemarks& remarks) {
    std::string text;
    for (const std::string& line : lines_of(remarks))
        text += "# " + line + "\n";
    text += "TITLE \"" + OIIO::Strutil::replace(remarks.title, "\"", "'", true) + "\"\n";
    const unsigned long n = steps.cube ? steps.cube->getGridSize() : steps.table->getLength();
    text += format("LUT_{}D_SIZE {}\n", steps.cube ? 3 : 1, n);
    text += "DOMAIN_MIN 0 0 0\nDOMAIN_MAX 1 1 1\n";
    float v[3];
    if (steps.table) {
        for (unsigned long i = 0; i < n; ++i) {
            steps.table->getValue(i, v[0], v[1], v[2]);
            text += triple(v) + "\n";
        }
        return text;
    }
    for (unsigned long b = 0; b < n; ++b)
        for (unsigned long g = 0; g < n; ++g)
            for (unsigned long r = 0; r < n; ++r) {
                steps.cube->getValue(r, g, b, v[0], v[1], v[2]);
                text += triple(v) + "\n";
            }
    return text;
}

std::string spi1d_text(const LutSteps& steps, const LutRemarks& remarks) {
    const unsigned long n = steps.table->getLength();
    bool grey = true;
    std::array<std::string, 2> tables; // of red alone, and of all
    for (unsigned long i = 0; i < n; ++i) {
        float v[3];
        steps.table->getValue(i, v[0], v[1], v[2]);
        grey = grey && v[0] == v[1] && v[0] == v[2];
        tables[0] += format("    {:.6g}\n", v[0]);
        tables[1] += "    " + triple(v) + "\n";
    }
    std::string text =
        format("Version 1\nFrom 0 1\nLength {}\nComponents {}\n{{\n", n, grey ? 1 : 3);
    text += tables[grey ? 0 : 1];
    text += "}\n";
    for (const std::string& line : lines_of(remarks))
        text += "# " + line + "\n";
    return text;
}

std::string spi3d_text(const LutSteps& steps, const LutRemarks& remarks) {
    const unsigned long n = steps.cube->getGridSize();
    std::string text = format("SPILUT 1.0\n3 3\n{0} {0} {0}\n", n);
    for (unsigned long r = 0; r < n; ++r)
        for (unsigned long g = 0; g < n; ++g)
            for (unsigned long b = 0; b < n; ++b) {
                float v[3];
                steps.cube->getValue(r, g, b, v[0], v[1], v[2]);
                text += format("{} {} {} ", r, g, b) + triple(v) + "\n";
            }
    for (const std::string& line : lines_of(remarks))
        text += "# " + line + "\n";
    return text;
}

std::string process_list(const std::string& format, const LutSteps& steps,
                         const LutRemarks& remarks) {
    ocio::FormatMetadata& about = steps.group->getFormatMetadata();
    about.setID("tonetool");
    about.setName(remarks.title.c_str());
    about.addChildElement("Description", remarks.title.c_str());
    about.addChildElement("InputDescriptor", remarks.input.c_str());
    about.addChildElement("OutputDescriptor", remarks.output.c_str());
    std::ostringstream text;
    text.imbue(std::locale::classic());
    steps.group->write(ocio::Config::CreateRaw(),
                       format == "ctf" ? "Color Transform Format" : "Academy/ASC Common LUT Format",
                       text);
    return text.str();
}

} // namespace

bool holds_scene_light(const std::string& format) {
    return format == "clf" || format == "ctf";
}

void check_format(const std::string& format, const LutSource& source) {
    const auto formats = ToneAlgo::lut_formats();
    if (std::find(formats.begin(), formats.end(), format) == formats.end())
        throw Refusal((format.empty() ? "the file name has no extension"
                                      : "no format has the extension \"." + format + "\"") +
                      "; valid: ." + OIIO::Strutil::join(formats, ", ."));
    const bool per_channel = source.structure() == LutSource::Structure::Channel;
    if (format == "spi1d" && !per_channel && !source.curve().use.on_luminance)
        throw Refusal(source.name() +
                      ": a .spi1d file has one table per channel, but this mixes the "
                      "channels; valid: .cube, .spi3d, .clf, .ctf");
    if (format == "spi3d" && per_channel)
        throw Refusal(source.name() + ": a .spi3d file is a cube, but this is a table per channel; "
                                      "valid: .cube, .spi1d, .clf, .ctf");
}

std::string lut_text(const std::string& format, const LutSteps& steps, const LutRemarks& remarks) {
    if (holds_scene_light(format))
        return process_list(format, steps, remarks);
    return format == "cube"    ? cube_text(steps, remarks)
           : format == "spi1d" ? spi1d_text(steps, remarks)
                               : spi3d_text(steps, remarks);
}

std::vector<std::string> ToneAlgo::lut_formats() {
    return {"cube", "spi1d", "spi3d", "clf", "ctf", "acv"};
}

} // namespace tonetool
