// Light tables: JSON where the text begins with a bracket, else CSV.
#include "fuzz.h"
#include "imagebuf/lights/light_table.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace tonetool;
    const bool json = size > 0 && (data[0] == '{' || data[0] == '[');
    const std::string file =
        fuzz::file_of(fuzz::text_of(data, size), json ? "lights.json" : "lights.csv");
    for (const char* unit : {"luminance", "power", "0.01"}) {
        LightTable table;
        std::string error;
        const bool read = table.read(file, unit, error);
        fuzz::require(read == error.empty(), "a refusal, and nothing else, has a reason");
        (void)table.list();
    }
    return 0;
}
