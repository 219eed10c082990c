// SPDX-License-Identifier: BSD-3-Clause
// Light tables: JSON where the text begins with a bracket, else CSV.
#include "fuzz.h"
#include "imagebuf/lights/light_table.h"
#include "metrics/refusal.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace tonetool;
    const bool json = size > 0 && (data[0] == '{' || data[0] == '[');
    const std::string file =
        fuzz::file_of(fuzz::text_of(data, size), json ? "lights.json" : "lights.csv");
    for (const char* unit : {"luminance", "power", "0.01"}) {
        LightTable table;
        try {
            table.read(file, unit);
        } catch (const Refusal& refusal) {
            fuzz::require(*refusal.what() != 0, "a refusal has a reason");
        }
        (void)table.list();
    }
    return 0;
}
