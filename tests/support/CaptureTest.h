#pragma once
#include <gmock/gmock.h>
#include <hagen/mrpt/ObservationScan.h>
#include "recordings/SweepObservation.h"
#include "sensors/captures/LidarCapture.h"

#include "support/CaptureWriter.h"
#include "support/Program.h"

namespace hagen::test {

/// Tests that read captures with sensors::openCapture().
class CaptureTest : public testing::Test {
 protected:
    using Scans = std::vector<mrpt::obs::CObservation::Ptr>;

    Scans read(const ByteString& bytes) { return readFile(writeBytes(folder_ / "a.pcap", bytes)); }
    Scans readFile(const std::filesystem::path& file) {
        const auto capture = sensors::openCapture(file, json_);
        Scans scans;
        broken_ = messageOf([&] {
            while (const auto sweep = capture->nextSweep()) {
                scans.push_back(recordings::observationOf(*sweep));
            }
        });
        remarks_ = capture->remarks();
        return scans;
    }
    static observations::ObservedScan observedOf(const mrpt::obs::CObservation& observation) {
        observations::ObservedScan observed;
        observations::readObservation(observation, {}, observed);
        return observed;
    }

    TemporaryFolder folder_;
    std::filesystem::path json_;  ///< Ouster metadata
    std::string broken_;
    std::vector<std::string> remarks_;
};

}  // namespace hagen::test
