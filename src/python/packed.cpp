// SPDX-License-Identifier: BSD-3-Clause
// Images in pickles. An OpenImageIO.ImageBuf is kept as a dictionary of its header and pixels,
// since it does not pickle itself.
#include "python/images.h"
#include "python/results.h"

namespace tonetool::python {

namespace {

const char kMark[] = "tonetool.ImageBuf";

struct SpecField {
    const char* name;
    int OIIO::ImageSpec::*member;
};
const SpecField kSpecFields[] = {
    {"x", &OIIO::ImageSpec::x},
    {"y", &OIIO::ImageSpec::y},
    {"z", &OIIO::ImageSpec::z},
    {"width", &OIIO::ImageSpec::width},
    {"height", &OIIO::ImageSpec::height},
    {"depth", &OIIO::ImageSpec::depth},
    {"full_x", &OIIO::ImageSpec::full_x},
    {"full_y", &OIIO::ImageSpec::full_y},
    {"full_z", &OIIO::ImageSpec::full_z},
    {"full_width", &OIIO::ImageSpec::full_width},
    {"full_height", &OIIO::ImageSpec::full_height},
    {"full_depth", &OIIO::ImageSpec::full_depth},
    {"tile_width", &OIIO::ImageSpec::tile_width},
    {"tile_height", &OIIO::ImageSpec::tile_height},
    {"tile_depth", &OIIO::ImageSpec::tile_depth},
    {"alpha_channel", &OIIO::ImageSpec::alpha_channel},
    {"z_channel", &OIIO::ImageSpec::z_channel},
};

py::list packed_attributes(const OIIO::ImageSpec& spec) {
    py::list list;
    for (const OIIO::ParamValue& one : spec.extra_attribs) {
        const OIIO::TypeDesc type = one.type();
        const size_t count = size_t(one.nvalues()) * type.numelements();
        py::list values;
        if (type.basetype == OIIO::TypeDesc::STRING)
            for (size_t i = 0; i < count; ++i)
                values.append(py::bytes(static_cast<const OIIO::ustring*>(one.data())[i].string()));
        else
            values.append(py::bytes(static_cast<const char*>(one.data()), size_t(one.datasize())));
        list.append(py::make_tuple(py::bytes(one.name().string()), type.c_str(), values));
    }
    return list;
}

void unpack_attribute(OIIO::ImageSpec& spec, const py::tuple& packed) {
    const std::string name = packed[0].cast<py::bytes>();
    const OIIO::TypeDesc type(packed[1].cast<std::string>());
    std::vector<std::string> values;
    for (const py::object& value : to_items(packed[2], "ImageBuf: " + name, "list"))
        values.push_back(value.cast<py::bytes>());
    if (type.basetype != OIIO::TypeDesc::STRING)
        return spec.attribute(name, type, values.at(0).data());
    std::vector<const char*> texts;
    for (const std::string& value : values)
        texts.push_back(value.c_str());
    spec.attribute(name, type, texts.data());
}

py::dict packed_image(const OIIO::ImageBuf& image) {
    if (image.deep())
        throw py::type_error("a deep image cannot be pickled: write it to a file");
    check_read(image, "pickle");
    const OIIO::ImageBuf whole = read_here(image, "pickle");
    const OIIO::ImageSpec& spec = whole.spec();
    py::dict state;
    state["kind"] = kMark;
    for (const SpecField& one : kSpecFields)
        state[one.name] = spec.*one.member;
    py::list channels, formats;
    for (const std::string& channel : spec.channelnames)
        channels.append(py::bytes(channel));
    for (const OIIO::TypeDesc& type : spec.channelformats)
        formats.append(type.c_str());
    state["format"] = spec.format.c_str();
    state["channels"] = channels;
    state["formats"] = formats;
    state["attributes"] = packed_attributes(spec);
    std::string pixels(spec.image_bytes(), '\0');
    if (!whole.get_pixels(whole.roi(), spec.format, pixels.data()))
        throw Refused("pickle: " + whole.geterror());
    state["pixels"] = py::bytes(pixels);
    return state;
}

py::object unpacked_image(const py::dict& state) {
    OIIO::ImageSpec spec;
    for (const SpecField& one : kSpecFields)
        spec.*one.member = state[one.name].cast<int>();
    spec.format = OIIO::TypeDesc(state["format"].cast<std::string>());
    for (const py::object& one : to_items(state["channels"], "ImageBuf: channels", "list"))
        spec.channelnames.push_back(one.cast<py::bytes>());
    for (const py::object& one : to_items(state["formats"], "ImageBuf: formats", "list"))
        spec.channelformats.push_back(OIIO::TypeDesc(one.cast<std::string>()));
    spec.nchannels = int(spec.channelnames.size());
    for (const py::object& one : to_items(state["attributes"], "ImageBuf: attributes", "list"))
        unpack_attribute(spec, one);
    const std::string pixels = state["pixels"].cast<py::bytes>();
    if (pixels.size() != spec.image_bytes())
        throw py::value_error("ImageBuf: the pixels are not those of the header");
    OIIO::ImageBuf image(spec, OIIO::InitializePixels::No);
    if (!image.set_pixels(image.roi(), spec.format, pixels.data()))
        throw Refused("pickle: " + image.geterror());
    return to_python(std::move(image), {false, false});
}

bool is_packed_image(const py::object& value) {
    return py::isinstance<py::dict>(value) && value.contains("kind") &&
           py::object(value["kind"]).equal(py::str(kMark));
}

py::object each(const py::object& value, py::object (*change)(const py::object&)) {
    py::list list;
    for (const py::handle item : value)
        list.append(change(py::reinterpret_borrow<py::object>(item)));
    return py::object(std::move(list));
}

} // namespace

py::object packed_images(const py::object& value) {
    if (py::isinstance<OIIO::ImageBuf>(value))
        return packed_image(value.cast<const OIIO::ImageBuf&>());
    if (py::isinstance<OIIO::ROI>(value))
        return region_tuple(value.cast<OIIO::ROI>());
    return py::isinstance<py::list>(value) ? each(value, packed_images) : value;
}

py::object unpacked_images(const py::object& value) {
    if (is_packed_image(value))
        return unpacked_image(value);
    return py::isinstance<py::list>(value) ? each(value, unpacked_images) : value;
}

} // namespace tonetool::python
