// SPDX-License-Identifier: BSD-3-Clause
// Modifiers of the commands that take curves, views and tables, on a picture of 8 x 8 pixels. The
// first byte chooses the command.
#include <OpenImageIO/imagebufalgo.h>
#include <iterator>
#include <sstream>

#include "fuzz.h"
#include "runs/runs.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace tonetool;
    static const char* const commands[] = {"tonemap",  "calibrate", "hdrflip", "cgtmo",
                                           "exposure", "exportlut", "ccmatrix"};
    if (size == 0)
        return 0;
    const std::string command = commands[data[0] % std::size(commands)];
    const std::string word = "--" + command + ":" + fuzz::text_of(data + 1, size - 1);
    if (command == "exportlut") {
        const std::string file = fuzz::file_of("", data[0] & 128 ? "lut.cube" : "lut.spi1d");
        std::ostringstream out, err;
        (void)runs::run({word + ":size=5", file}, out, err);
        return 0;
    }
    std::vector<OIIO::ImageBuf> images(2);
    for (size_t i = 0; i < images.size(); ++i) {
        images[i] = OIIO::ImageBuf(OIIO::ImageSpec(8, 8, 3, OIIO::TypeFloat));
        OIIO::ImageBufAlgo::fill(images[i], {0.1f, 0.5f + float(i), 2.0f});
    }
    Strings words{word};
    if (command == "exposure" || command == "ccmatrix")
        words.emplace_back(command == "exposure" ? "1" : "1,0,0,0,1,0,0,0,1");
    const runs::Evaluation found =
        runs::evaluate(words, std::move(images), {true, "/nonexistent", 100});
    fuzz::require(found.status != 1 || !found.err.empty(), "an error has a reason");
    return 0;
}
