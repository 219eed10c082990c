// SPDX-License-Identifier: BSD-3-Clause
// The hash that tells whether two files hold the same values.
#include <OpenImageIO/deepdata.h>
#include <OpenImageIO/hash.h>
#include <OpenImageIO/imageio.h>

#include "chain/images/inspect.h"
#include "imagebuf/pixels/oiio_compat.h"
#include "text/error.h"

namespace tonetool::chain {

std::string stored_hash(const std::string& file, int subimage) {
    auto input = oiio::open_input(file);
    if (!input)
        throw ReadError(file, OIIO::geterror());
    OIIO::SHA1 sum;
    bool done = false;
    const OIIO::ImageSpec spec = input->spec(subimage, 0);
    if (spec.deep) {
        OIIO::DeepData samples;
        done = oiio::read_deep_pixels(*input, subimage, 0, samples);
        const auto counts = samples.all_samples();
        sum.append(counts.data(), size_t(counts.size()) * sizeof(counts[0]));
        sum.append(samples.all_data().data(), size_t(samples.all_data().size()));
    } else {
        std::vector<char> values(spec.image_bytes(true));
        done = input->read_image(subimage, 0, 0, spec.nchannels, OIIO::TypeUnknown, values.data());
        sum.append(values.data(), values.size());
    }
    if (!done || input->has_error())
        throw ReadError(file, input->geterror());
    return sum.digest();
}

} // namespace tonetool::chain
