# SPDX-License-Identifier: BSD-3-Clause
"""How two image files differ: every subimage and MIP level, pixels by their bits, metadata."""

import numpy as np
import OpenImageIO as oiio

# The program's name and the time stand in these (FITS cuts names short); that both have them or both lack them counts.
NAMES_THE_PROGRAM = ("Software", "DateTime", "Exif:ImageHistory", "Exif:ima",
                     "ImageHistory",
                     "IPTC:OriginatingProgram")
FACTS = ("width", "height", "depth", "x", "y", "z", "full_x", "full_y", "full_z", "full_width",
         "full_height", "full_depth", "tile_width", "tile_height", "tile_depth", "nchannels",
         "channelnames", "alpha_channel", "z_channel", "deep")


def attributes(spec):
    return {one.name: "present" if one.name in NAMES_THE_PROGRAM
            else f"{one.type} {one.value!r}" for one in spec.extra_attribs}


def facts(spec):
    found = {name: getattr(spec, name) for name in FACTS}
    found["channel types"] = [str(one) for one in channel_types(spec)]
    return found


def channel_types(spec):
    return list(spec.channelformats) or [spec.format] * spec.nchannels


def parts(source):
    """(subimage, MIP level) of everything in the file."""
    subimage = 0
    while source.seek_subimage(subimage, 0):
        level = 0
        while source.seek_subimage(subimage, level):
            yield subimage, level
            level += 1
        subimage += 1


def deep_values(source, spec, subimage, level):
    data = source.read_native_deep_image(subimage, level)
    values = []
    for pixel in range(data.pixels):
        count = data.samples(pixel)
        values.append((count, [data.deep_value(pixel, channel, sample)
                               for sample in range(count) for channel in range(spec.nchannels)]))
    return values


def channel_values(source, spec, subimage, level):
    """One array a channel, in the type that the file holds."""
    types = channel_types(spec)
    if len({str(one) for one in types}) == 1:
        pixels = source.read_image(subimage, level, 0, spec.nchannels, types[0])
        return [pixels] if pixels is not None else None
    pixels = [source.read_image(subimage, level, channel, channel + 1, one)
              for channel, one in enumerate(types)]
    return None if any(one is None for one in pixels) else pixels


def value_difference(stock, own, within):
    if stock is None or own is None:
        return "" if stock is own else "pixels of one can not be read"
    for first, second in zip(stock, own):
        if first.tobytes() == second.tobytes():
            continue
        a, b = first.astype(np.float64), second.astype(np.float64)
        apart = np.where((a == b) | (np.isnan(a) & np.isnan(b)), 0, np.abs(a - b))
        apart = np.nan_to_num(apart, nan=np.inf)
        if not within or apart.max() > within:
            place = [int(i) for i in np.unravel_index(np.argmax(apart), apart.shape)]
            return (f"{np.count_nonzero(apart)} of {apart.size} values differ, the most at "
                    f"[y, x, channel] {place}: {b[tuple(place)]}, oiiotool's is "
                    f"{a[tuple(place)]}")
    return ""


def spec_differences(stock, own):
    first, second = {**facts(stock), **attributes(stock)}, {**facts(own), **attributes(own)}
    return [f"{name} is {second.get(name, 'absent')}, oiiotool's is {first.get(name, 'absent')}"
            for name in sorted(set(first) | set(second)) if first.get(name) != second.get(name)]


def part_differences(stock, own, part, within):
    first, second = stock.spec(*part), own.spec(*part)
    found = spec_differences(first, second)
    if facts(first) != facts(second):
        return found
    if first.deep:
        if deep_values(stock, first, *part) != deep_values(own, second, *part):
            found.append("deep samples differ")
        return found
    unequal = value_difference(channel_values(stock, first, *part),
                               channel_values(own, second, *part), within)
    return found + ([unequal] if unequal else [])


def image_differences(stock_path, own_path, within=0.0):
    """Texts that say how the file at own_path differs from the one at stock_path."""
    if stock_path.read_bytes() == own_path.read_bytes():
        return []
    stock, own = oiio.ImageInput.open(str(stock_path)), oiio.ImageInput.open(str(own_path))
    oiio.geterror()
    if not stock or not own:
        return ["the bytes differ, and not both are images"]
    if stock.format_name() != own.format_name():
        return [f"is a {own.format_name()} file, oiiotool's is {stock.format_name()}"]
    first, second = list(parts(stock)), list(parts(own))
    if first != second:
        return [f"has the parts {second}, oiiotool's are {first}"]
    return [f"part {part}: {one}" for part in first
            for one in part_differences(stock, own, part, within)]

