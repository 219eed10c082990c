#include <iostream>
#include <tonetool/tonetool.h>

int main(int argc, char** argv) {
    const OIIO::ImageBuf reference(argc > 2 ? argv[1] : ""), test(argc > 2 ? argv[2] : "");
    tonetool::FlipResult result;
    OIIO::ImageBuf map;
    const bool ok = tonetool::ToneAlgo::hdr_flip(map, reference, test, {}, &result);
    std::cout << (ok ? std::to_string(result.summary.pool.mean) : map.geterror()) << "\n";
    return ok ? 0 : 1;
}
