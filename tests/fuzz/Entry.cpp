// Runs this program's target in libFuzzer. `PROGRAM write-seeds FOLDER` writes its seeds to
// FOLDER/seeds, its dictionary to FOLDER/words and the maximum input size to FOLDER/longest.
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <fstream>

#include "fuzz/Target.h"

namespace {

void writeSeeds(const hagen::fuzz::Target& target, const std::filesystem::path& folder) {
    std::filesystem::create_directories(folder / "seeds");
    std::size_t number = 0;
    for (const std::string& seed : target.seeds()) {
        std::ofstream(folder / "seeds" / std::to_string(number++), std::ios::binary) << seed;
    }
    std::ofstream words(folder / "words");
    for (const std::string& word : target.words) {
        words << '"';
        for (const char c : word) {
            char text[8];
            std::snprintf(text, sizeof text, "\\x%02x", static_cast<unsigned char>(c));
            words << text;
        }
        words << "\"\n";
    }
    std::ofstream(folder / "longest") << target.longest << '\n';
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
    if (*argc == 3 && std::string((*argv)[1]) == "write-seeds") {
        writeSeeds(hagen::fuzz::targets().front(), (*argv)[2]);
        std::exit(EXIT_SUCCESS);
    }
    return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    hagen::fuzz::targets().front().run({reinterpret_cast<const char*>(data), size});
    return 0;
}
