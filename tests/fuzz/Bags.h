#pragma once
// What the fuzz targets of ROS recordings share.
#include <filesystem>
#include <vector>

#include "fuzz/Target.h"
#include "support/BagWriter.h"

namespace hagen::fuzz {

/// Surveys and reads a bag, as a program does.
void readAnyBag(const std::filesystem::path& file);

/// One message of each type that is read; scans are short.
std::vector<test::SentMessage> everyMessage();

}  // namespace hagen::fuzz
