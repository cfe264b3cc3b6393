#include <hagen/mrpt/MapFile.h>
#include <mrpt/img/color_maps.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <zlib.h>
#include "base/WriteFile.h"
#include "mrpt/MrptScene.h"

#include <algorithm>

namespace hagen::observations {

namespace {

namespace fs = std::filesystem;

/// Returns the occupied voxels as an MRPT object, coloured by height from blue (lowest) to red.
observations::viz::COctoMapVoxels::Ptr voxelsOf(const octomap::OcTree& tree) {
    auto voxels = observations::viz::COctoMapVoxels::Create();
    voxels->resizeVoxelSets(1);
    voxels->enableLights(true);
    voxels->enableCubeTransparency(false);
    double min[3] = {0, 0, 0}, max[3] = {1, 1, 1};
    if (tree.size() > 0) {
        tree.getMetricMin(min[0], min[1], min[2]);
        tree.getMetricMax(max[0], max[1], max[2]);
    }
    voxels->setBoundingBox({min[0], min[1], min[2]}, {max[0], max[1], max[2]});
    for (auto leaf = tree.begin_leafs(), end = tree.end_leafs(); leaf != end; ++leaf) {
        if (!tree.isNodeOccupied(*leaf)) continue;
        const octomap::point3d at = leaf.getCoordinate();
        const double height = (static_cast<double>(at.z()) - min[2]) / (max[2] - min[2]);
        const mrpt::img::TColor color = observations::colorOf(mrpt::img::colormap(
            mrpt::img::cmJET, static_cast<float>(std::clamp(height, 0.0, 1.0))));
        voxels->push_back_Voxel(
            0, {mrpt::math::TPoint3Df(at.x(), at.y(), at.z()), leaf.getSize(), color});
    }
    voxels->setVisualizationMode(observations::viz::COctoMapVoxels::FIXED);
    return voxels;
}

void saveScene(const octomap::OcTree& tree, const fs::path& file, const fs::path& named) {
    observations::Scene scene;
    scene.insert(voxelsOf(tree));
    // MRPT's streams do not report a full disk.
    mrpt::io::CMemoryStream bytes;
    mrpt::serialization::archiveFrom(bytes) << scene;
    errno = 0;
    const gzFile out = gzopen(file.c_str(), "wb1");
    if (out == nullptr) base::throwWriteError(named, errno);
    const auto* const data = static_cast<const std::uint8_t*>(bytes.getRawBufferData());
    const std::size_t size = bytes.getTotalBytesCount();
    const bool is_written = gzfwrite(data, 1, size, out) == size;
    const int error = errno;
    const bool is_closed = gzclose(out) == Z_OK;
    if (!is_written) errno = error;
    if (!is_written || !is_closed) base::throwWriteError(named, errno);
}

/// Writes the header of OctoMap's files. OctoMap's writers print to standard error.
void writeHead(const std::string& kind, const octomap::OcTree& tree, std::ostream& out) {
    out << kind << "\nid " << tree.getTreeType() << "\nsize " << tree.size() << "\nres "
        << tree.getResolution() << "\ndata\n";
}

void writeOctree(octomap::OcTree& tree, bool is_binary, std::ostream& out) {
    if (is_binary) tree.toMaxLikelihood();
    tree.prune();
    writeHead(is_binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file", tree, out);
    if (tree.size() == 0) return;
    if (is_binary) {
        tree.writeBinaryNode(out, tree.getRoot());
    } else {
        tree.writeData(out);
    }
}

}  // namespace

void checkMapFile(const fs::path& file) {
    const std::string ending = file.extension().string();
    if (ending == ".bt" || ending == ".ot" || ending == ".3Dscene") return;
    throw std::runtime_error(
        file.string() +
        ": unknown map format; use .bt (occupied or free), .ot (probabilities) "
        "or .3Dscene (for SceneViewer3D)");
}

void saveMap(const octomap::OcTree& tree, const fs::path& file) {
    octomap::OcTree copy(tree);
    saveMapInPlace(copy, file, file);
}

void saveMapInPlace(octomap::OcTree& tree, const fs::path& file, const fs::path& named) {
    checkMapFile(named);
    if (named.extension() == ".3Dscene") return saveScene(tree, file, named);
    tree.updateInnerOccupancy();  // inner nodes are stale while a map is being built
    std::ofstream out = base::openToWrite(file, named);
    writeOctree(tree, named.extension() == ".bt", out);
    base::closeWritten(out, named);
}

}  // namespace hagen::observations
