// Point cloud files of all formats, and scans made from them.
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/settings/CloudSensors.h>
#include "mrpt/TableCloud.h"
#include "recordings/clouds/CloudFile.h"

#include <memory>

#include "fuzz/Target.h"
#include "support/CloudFiles.h"

namespace hagen::fuzz {
namespace {

void readAnyCloud(std::string_view input) {
    const InputFile file(input, "input.bin");
    recordings::cloudFormatOf(file.path());
    recordings::CloudFile cloud;
    if (!mayRefuse([&] { cloud = recordings::readCloud(file.path()); })) return;
    // A compressed file may unpack to 256 times its size.
    require(cloud.table.bytes.size() <= 256 * (input.size() + 4096), "more points than bytes");
    mayRefuse([&] {
        const auto table = std::make_shared<const observations::PointTable>(cloud.table);
        const auto observation = observations::observationOf(table, "cloud", {});
        CloudSensors sensors;
        observations::showCloud(*observation, sensors);
        observations::ObservedScan scan;
        observations::readObservation(*observation, {}, scan, sensors.beamsOf("cloud"));
        require(scan.scan.row.size() == scan.scan.size(), "a return has no row");
    });
}

Seeds cloudSeeds() {
    Seeds seeds;
    for (const auto& [name, bytes] : test::cloudFiles(test::filePoints(6))) seeds.push_back(bytes);
    seeds.push_back(test::binWithRings(test::filePoints(20)));
    return seeds;
}

const bool kAdded =
    add({"clouds", readAnyCloud, cloudSeeds,
         wordsIn("FIELDS SIZE TYPE COUNT WIDTH HEIGHT POINTS VIEWPOINT DATA ascii binary "
                 "binary_compressed element vertex property list uchar int float double "
                 "end_header format 1.0 binary_big_endian LASF \x93NUMPY 'descr': "
                 "'fortran_order': True 'shape': ( '<f4' '>f8' '|V2' nan -inf 1e400 "
                 "18446744073709551615 4294967296")});

}  // namespace
}  // namespace hagen::fuzz
