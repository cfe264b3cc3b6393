#include <hagen/mapping/ScanMap.h>

#include <mrpt/opengl/COctoMapVoxels.h>

#include <mrpt/serialization/CArchive.h>

#include <fstream>
#include <stdexcept>

namespace hagen {

void saveMap(const octomap::OcTree&, const std::filesystem::path&) {
    throw std::logic_error("not yet");
}

}  // namespace hagen
