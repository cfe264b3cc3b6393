#pragma once
// Common parts of the fuzz targets for ROS recordings.
#include <filesystem>
#include <vector>

#include "fuzz/Target.h"
#include "support/BagWriter.h"

namespace hagen::fuzz {

/// Surveys and reads a bag as the programs do.
void readAnyBag(const std::filesystem::path& file);

/// One message of each supported type, with short scans.
std::vector<test::SentMessage> everyMessage();

}  // namespace hagen::fuzz
