#include <gmock/gmock.h>
#include <hagen/mrpt/MapFile.h>
#include <hagen/mrpt/ScanMap.h>
#include <hagen/simulation/Random.h>
#include "mrpt/MrptScene.h"

#include <fstream>
#include <iterator>

#include "support/Program.h"

namespace hagen::observations {
namespace {

using testing::HasSubstr;

namespace fs = std::filesystem;

class MapFile : public testing::Test {
 protected:
    MapFile() {
        simulation::Random random(4);
        MappedScan scan;
        for (int i = 0; i < 400; ++i) {
            const double x = random.uniform(-4, 4);
            const double y = random.uniform(-4, 4);
            const double z = random.uniform(-2, 2);
            scan.points_m.push_back(Eigen::Vector3d(x, y, z).cast<float>());
            scan.labels.push_back(Label::Roi);
        }
        for (int i = 0; i < 8; ++i) map_.insert(scan);
    }

    static std::string bytesOf(const fs::path& file) {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }

    /// Expects every voxel to have the same state in both maps: unknown, free or occupied.
    void expectSameVoxels(const octomap::OcTree& read) const {
        const octomap::OcTree& tree = map_.tree();
        EXPECT_EQ(tree.getResolution(), read.getResolution());
        for (double x = -4.1; x < 4.2; x += 0.2) {
            for (double y = -4.1; y < 4.2; y += 0.2) {
                for (double z = -2.1; z < 2.2; z += 0.2) {
                    const auto *a = tree.search(x, y, z), *b = read.search(x, y, z);
                    ASSERT_EQ(a == nullptr, b == nullptr);
                    if (a) {
                        ASSERT_EQ(tree.isNodeOccupied(a), read.isNodeOccupied(b));
                    }
                }
            }
        }
    }

    std::size_t occupied() const {
        std::size_t count = 0;
        for (auto leaf = map_.tree().begin_leafs(); leaf != map_.tree().end_leafs(); ++leaf) {
            count += map_.tree().isNodeOccupied(*leaf);
        }
        return count;
    }

    test::TemporaryFolder folder_;  // unique, as tests run in parallel
    ScanMap map_{{MapContent::Full, 0.2, 20}};
};

TEST_F(MapFile, WritesBinaryOctomap) {
    saveMap(map_.tree(), folder_ / "map.bt");
    octomap::OcTree read(0.1);
    ASSERT_TRUE(read.readBinary((folder_ / "map.bt").string()));
    expectSameVoxels(read);
    EXPECT_LT(read.size(), map_.tree().size()) << "not pruned";
}

TEST_F(MapFile, WritesOctomapProbabilities) {
    saveMap(map_.tree(), folder_ / "map.ot");
    const std::unique_ptr<octomap::AbstractOcTree> read(
        octomap::AbstractOcTree::read((folder_ / "map.ot").string()));
    const auto* tree = dynamic_cast<octomap::OcTree*>(read.get());
    ASSERT_TRUE(tree);
    expectSameVoxels(*tree);
    EXPECT_EQ(map_.tree().search(0, 0, 0)->getLogOdds(), tree->search(0, 0, 0)->getLogOdds());
}

TEST_F(MapFile, WritesMrptScene) {
    saveMap(map_.tree(), folder_ / "map.3Dscene");
    Scene scene;
    ASSERT_TRUE(scene.loadFromFile((folder_ / "map.3Dscene").string()));
    const auto voxels = scene.getByClass<viz::COctoMapVoxels>();
    ASSERT_TRUE(voxels);
    EXPECT_EQ(occupied(), voxels->getVoxelCount(0));
}

TEST_F(MapFile, IsReproducible) {
    for (const std::string ending : {".bt", ".ot", ".3Dscene"}) {
        saveMap(map_.tree(), folder_ / ("first" + ending));
        saveMap(map_.tree(), folder_ / ("second" + ending));
        EXPECT_EQ(bytesOf(folder_ / ("first" + ending)), bytesOf(folder_ / ("second" + ending)));
    }
}

/// Like converters, saves the .bt file last.
TEST_F(MapFile, InPlaceMatchesCopy) {
    for (const std::string ending : {".bt", ".ot", ".3Dscene"}) {
        saveMap(map_.tree(), folder_ / ("copied" + ending));
    }
    for (const std::string ending : {".3Dscene", ".3Dscene", ".ot", ".ot", ".bt", ".bt"}) {
        const fs::path file = folder_ / ("in_place" + ending);
        saveMapInPlace(map_.tree(), file, file);
        EXPECT_EQ(bytesOf(file), bytesOf(folder_ / ("copied" + ending))) << ending;
    }
}

TEST_F(MapFile, AcceptsEmptyMaps) {
    const ScanMap empty({});
    for (const std::string name : {"map.bt", "map.ot", "map.3Dscene"}) {
        saveMap(empty.tree(), folder_ / name);
        EXPECT_TRUE(fs::exists(folder_ / name));
    }
}

TEST_F(MapFile, RejectsOtherExtensions) {
    for (const std::string name : {"map", "map.pcd", "map.BT", "map.bt.gz"}) {
        const std::string error = test::messageOf([&] { saveMap(map_.tree(), folder_ / name); });
        EXPECT_THAT(error, testing::AllOf(HasSubstr(name + ": "), HasSubstr(".3Dscene")));
        EXPECT_FALSE(fs::exists(folder_ / name));
    }
}

TEST_F(MapFile, ReportsWriteErrors) {
    for (const std::string name : {"none/map.bt", "none/map.ot", "none/map.3Dscene"}) {
        EXPECT_THROW(saveMap(map_.tree(), folder_ / name), std::runtime_error) << name;
    }
    EXPECT_THROW(saveMapInPlace(map_.tree(), "/dev/full", "map.bt"), std::runtime_error);
    EXPECT_THROW(saveMapInPlace(map_.tree(), "/dev/full", "map.ot"), std::runtime_error);
}

}  // namespace
}  // namespace hagen::observations
