#include <hagen/mapping/ScanMap.h>
#include <stdexcept>

namespace hagen {

ScanMap::ScanMap(const ScanMapOptions& options)
    : options_(options), tree_(std::make_unique<octomap::OcTree>(options.resolution_m)) {}

void ScanMap::insert(const MappedScan&) { throw std::logic_error("not yet"); }

void saveMap(const octomap::OcTree&, const std::filesystem::path&) {
    throw std::logic_error("not yet");
}

}  // namespace hagen
