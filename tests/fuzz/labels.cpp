// Label files, label maps, and HDL-64E calibrations.
#include <hagen/evaluation/LabelMap.h>
#include <hagen/recordings/ScanFolder.h>
#include "sensors/velodyne/VelodyneCalibrationFile.h"

#include "fuzz/Target.h"
#include "support/Hdl64.h"

namespace hagen::fuzz {
namespace {

void readLabelFiles(std::string_view input) {
    const InputFile file(input);
    mayRefuse([&] {
        const auto entries = recordings::readLabelEntries(file.path());
        require(4 * entries.size() == input.size(), "as many labels as the file has");
    });
    mayRefuse([&] { sensors::readVelodyneCalibration(file.path()); });
    evaluation::LabelMap map;
    if (!mayRefuse([&] { map = evaluation::readLabelMap(file.path()); })) return;
    std::vector<std::uint16_t> numbers;
    for (const auto& each : map) numbers.push_back(each.first);
    require(labelsOfClasses(numbers, map).size() == numbers.size(), "a class has no label");
}

Seeds labelSeeds() {
    return {"70: {name: vegetation, label: 2}\n72: {name: terrain, label: 1}\n",
            bytesOf(std::uint32_t{1}, std::uint32_t{0x20002}), test::hdl64Xml()};
}

const bool kAdded =
    add({"labels",
         readLabelFiles,
         labelSeeds,
         {"name: ", "label: ", "<item>", "</item>", "<px>", "<id_>", "<rotCorrection_>",
          "<vertCorrection_>", "<points_>", "class_id", "count", "<!--", "&lt;"},
         40000});

}  // namespace
}  // namespace hagen::fuzz
