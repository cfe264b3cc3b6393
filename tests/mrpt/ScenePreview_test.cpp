#include "mrpt/ScenePreview.h"
#include <gmock/gmock.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>
#include "filter/RoiBoxes.h"
#include "mrpt/MrptScene.h"
#include "mrpt/Results.h"

#include <algorithm>

#include "support/SimpleFirings.h"

namespace hagen::observations {
namespace {

using testing::HasSubstr;
using testing::Not;

mrpt::obs::CObservation3DScene::Ptr afterARawlog(const mrpt::obs::CObservation3DScene& preview,
                                                 std::string& bytes) {
    mrpt::io::CMemoryStream stream;
    auto archive = mrpt::serialization::archiveFrom(stream);
    archive << preview;
    bytes.assign(static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount());
    stream.Seek(0);
    return archive.ReadObject<mrpt::obs::CObservation3DScene>();
}

class ScenePreview : public testing::Test {
 protected:
    ScenePreview() {
        Settings settings;
        settings.options.number_obstacles = true;
        segmenter_.initialize(settings);
        const auto scan = test::poleScanFrom(0, "front");
        EXPECT_TRUE(segmenter_.process(*scan, segmented_));
        preview_ = previewOf(*scan, segmented_, 20);
    }

    ObservationSegmenter segmenter_;
    ObservationSegmenter::Output segmented_;
    mrpt::obs::CObservation3DScene::Ptr preview_;
};

TEST_F(ScenePreview, IsIdentifiedAfterSerialization) {
    std::string bytes;
    const auto read = afterARawlog(*preview_, bytes);
    EXPECT_TRUE(isResult(*preview_));
    EXPECT_TRUE(isResult(*read));
    EXPECT_EQ(scanLabelOf(*read), "front");
    mrpt::obs::CObservation3DScene other;
    EXPECT_FALSE(isResult(other));
    other.scene = std::make_shared<observations::Scene>();
    EXPECT_FALSE(isResult(other));
}

TEST_F(ScenePreview, UsesClassesOfBothMrptVersions) {
    std::string bytes;
    afterARawlog(*preview_, bytes);
    EXPECT_THAT(bytes, HasSubstr("CSetOfLines"));
    EXPECT_THAT(bytes, Not(HasSubstr("CBox")));
    EXPECT_THAT(bytes, Not(HasSubstr("CAxis")));
}

TEST_F(ScenePreview, FramesLargeOuterObstacles) {
    const auto boxes = boxRoiComponents(*segmented_.scan, segmented_.result->returns);
    std::size_t expected = 0;
    for (const RoiBox& box : boxes) {
        const bool is_inside = std::any_of(boxes.begin(), boxes.end(), [&](const RoiBox& other) {
            return other.component != box.component && other.returns >= 30 &&
                   other.extents_m.contains(box.extents_m);
        });
        expected += box.returns >= 30 && !is_inside;
    }
    ASSERT_GT(expected, 0u);
    const auto object = preview_->scene->getByName("obstacles");
    const auto lines = std::dynamic_pointer_cast<observations::viz::CSetOfLines>(object);
    ASSERT_TRUE(lines);
    EXPECT_EQ(lines->size(), 12 * expected);
    // Each edge is parallel to an axis.
    for (const auto& line : *lines) {
        const auto along = line.point2 - line.point1;
        EXPECT_EQ((along.x != 0) + (along.y != 0) + (along.z != 0), 1);
    }
}

TEST(Results, KeepMarkAfterSerialization) {
    for (const bool is_roi : {true, false}) {
        const auto scan = test::poleScanFrom(0, "a_roi");
        const auto result = resultOf(*scan, is_roi, mrpt::maps::CSimplePointsMap::Create());
        mrpt::io::CMemoryStream stream;
        auto archive = mrpt::serialization::archiveFrom(stream);
        archive << *result;
        stream.Seek(0);
        const auto read = archive.ReadObject<mrpt::obs::CObservationPointCloud>();
        EXPECT_TRUE(isResult(*read));
        EXPECT_EQ(scanLabelOf(*read), "a_roi");
    }
}

TEST(Results, NeedLabelAndColour) {
    const auto scan = test::poleScanFrom(0, "a");
    const auto cloud = resultOf(*scan, true, mrpt::maps::CSimplePointsMap::Create());
    cloud->sensorLabel = "a";
    EXPECT_FALSE(isResult(*cloud));
    cloud->sensorLabel = "a_roi";
    cloud->pointcloud->renderOptions.color = mrpt::img::TColorf(0, 0, 1);
    EXPECT_FALSE(isResult(*cloud));
    cloud->pointcloud = nullptr;
    EXPECT_FALSE(isResult(*cloud));
    EXPECT_FALSE(isResult(*scan));
}

}  // namespace
}  // namespace hagen::observations
