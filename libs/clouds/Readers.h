#pragma once
#include "CloudBytes.h"

namespace hagen::clouds {

// One reader per format, of a file's bytes. They throw BrokenCloud; the table is not checked yet.
CloudFile readPcd(const std::filesystem::path& file, Bytes bytes);
CloudFile readPly(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readLas(const std::filesystem::path& file, const Bytes& bytes);
CloudFile readNpy(const std::filesystem::path& file, Bytes bytes);
CloudFile readBin(const std::filesystem::path& file, Bytes bytes);

}  // namespace hagen::clouds
