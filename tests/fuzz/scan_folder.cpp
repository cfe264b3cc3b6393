// Scan folders. The input contains the files, separated by 0xff bytes.
#include <hagen/recordings/ScanSource.h>

#include <fstream>

#include "fuzz/Target.h"
#include "support/CloudFiles.h"

namespace hagen::fuzz {
namespace {

constexpr char kBetween = '\xff';

void readFolder(std::string_view input) {
    const std::filesystem::path folder = scratch() / "folder";
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "velodyne");
    Parts parts(input);
    for (const char* const name :
         {"times.txt", "poses.tum", "poses.txt", "calib.txt", "sensor.yaml"}) {
        const std::string_view bytes = parts.until(kBetween);
        if (!bytes.empty()) std::ofstream(folder / name, std::ios::binary) << bytes;
    }
    const std::string_view first = parts.rest().substr(0, parts.rest().size() / 2);
    std::ofstream(folder / "velodyne/000000.bin", std::ios::binary) << first;
    std::ofstream(folder / "velodyne/000001.bin", std::ios::binary)
        << parts.rest().substr(first.size());
    mayRefuse([&] {
        recordings::SourceOptions options;
        options.folder_objects = observations::CloudClass::WithIntensity;
        const auto source = recordings::openRecording(folder, options);
        source->usePoses({});
        source->useSettings({});
        std::size_t entries = 0;
        while (const auto entry = source->nextEntry()) ++entries;
        require(entries == 2, "an entry for each file");
        source->remarks();
    });
}

Seeds folders() {
    const std::string scan = test::bin(test::filePoints(2));
    const std::string between(1, kBetween);
    return {between + between + between + between + between + scan + scan,
            "0.1\n0.2\n" + between + "0.1 1 2 3 0 0 0 1\n0.2 1 2 3 0 0 0 1\n" + between +
                "1 0 0 1.5 0 1 0 2 0 0 1 3\n1 0 0 1.5 0 1 0 2 0 0 1 3\n" + between +
                "Tr: 0 -1 0 1 0 0 -1 2 1 0 0 3\n" + between + "sensor: {model: OS1-64}\n" +
                between + scan + scan};
}

const bool kAdded =
    add({"scan_folder", readFolder, folders, {"sensor:", "model: ", "Tr:", "include: "}, 2048});

}  // namespace
}  // namespace hagen::fuzz
