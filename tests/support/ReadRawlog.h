#pragma once
#include <gmock/gmock.h>
#include <hagen/recordings/RawlogReader.h>

#include <filesystem>
#include <string>
#include <utility>

namespace hagen::test {

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
