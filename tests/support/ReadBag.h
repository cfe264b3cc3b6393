#pragma once
// Common parts of the tests of bag readers.
#include <gtest/gtest.h>
#include "recordings/bags/BagScans.h"

#include "support/BagWriter.h"
#include "support/Program.h"

namespace hagen::test {

constexpr double kBagStart_s = 1700000000;

struct ReadBag {
    recordings::BagSurvey survey;
    std::unique_ptr<recordings::BagScans> scans;
    std::vector<mrpt::obs::CObservation::Ptr> observations;
    std::string failed_because;

    std::vector<mrpt::obs::CObservation::Ptr> of(const std::string& label) const {
        std::vector<mrpt::obs::CObservation::Ptr> found;
        for (const auto& one : observations) {
            if (one->sensorLabel == label) found.push_back(one);
        }
        return found;
    }
    std::vector<std::string> labels() const {
        std::vector<std::string> all;
        for (const auto& [topic, sensor] : scans->plan().sensors) all.push_back(sensor.label);
        return all;
    }
};

inline ReadBag readBag(const std::filesystem::path& file,
                       const recordings::BagOptions& options = {}) {
    ReadBag read;
    read.survey = recordings::surveyBag(file);
    try {
        read.scans = std::make_unique<recordings::BagScans>(file, read.survey, options);
        while (const auto one = read.scans->next()) read.observations.push_back(one);
    } catch (const std::runtime_error& e) {
        read.failed_because = e.what();
    }
    return read;
}

class BagTest : public testing::Test {
 protected:
    ReadBag read(const std::vector<SentMessage>& messages,
                 const recordings::BagOptions& options = {}) const {
        return readBag(writeBytes(folder_ / "flight.bag", ros1BagOf(messages)), options);
    }
    static SentMessage cloud(const std::string& topic, double since_s = 0,
                             const std::string& frame = "lidar") {
        return cloudMessage(topic, kBagStart_s + since_s, frame, {1, 2, 3, 4, 5, 6, 7, 8});
    }
    static SentMessage odometry(double since_s, double x, const std::string& child = "base_link") {
        return odometryMessage("/odom", kBagStart_s + since_s, "odom", child, x, 0, 0);
    }
    static SentMessage transform(const std::string& topic, const std::string& parent,
                                 const std::string& child, double x, double since_s = 0) {
        return transformMessage(topic, kBagStart_s + since_s, parent, child, x, 0, 0);
    }
    TemporaryFolder folder_;
};

}  // namespace hagen::test
