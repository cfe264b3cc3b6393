#pragma once
#include <gmock/gmock.h>
#include <hagen/recordings/RawlogReader.h>
#include <mrpt/obs/CObservationComment.h>

#include <string>
#include <utility>

namespace hagen::test {

inline mrpt::obs::CObservationComment comment(const std::string& text) {
    mrpt::obs::CObservationComment observation;
    observation.text = text;
    observation.timestamp = mrpt::Clock::fromDouble(1.0);
    return observation;
}

/// Reads a log to its end or to an error. Returns the number of entries and the error message.
inline std::pair<std::size_t, std::string> readLog(const std::filesystem::path& file) {
    recordings::RawlogReader reader(file);
    try {
        while (reader.next()) {
        }
        EXPECT_EQ(reader.fractionRead(), 1.0);
    } catch (const recordings::BrokenRecording& e) {
        EXPECT_THAT(e.what(), testing::HasSubstr(file.string()));
        return {reader.entries(), e.what()};
    }
    return {reader.entries(), ""};
}

}  // namespace hagen::test
