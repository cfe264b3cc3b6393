#include <gmock/gmock.h>
#include <hagen/mrpt/MrptCompat.h>
#include <mp2p_icp_filters/FilterBase.h>

#include "support/Program.h"
#include "support/SimpleScene.h"

namespace hagen {
namespace {

using testing::HasSubstr;

/// The pipeline of examples/mp2p_icp with the built plug-in, and other parameters.
mp2p_icp_filters::FilterPipeline pipelineWith(const std::map<std::string, std::string>& changes) {
    auto yaml =
        mrpt::containers::yaml::FromFile(HAGEN_SOURCE_DIR "/examples/mp2p_icp/pipeline.yaml");
    auto& entry = yaml["filters"].asSequence().at(0).asMap();
    entry["plugin"] = std::string(HAGEN_MP2P_ICP);
    for (const auto& [key, value] : changes) entry["params"].asMap()[key] = value;
    return mp2p_icp_filters::filter_pipeline_from_yaml(yaml["filters"]);
}

/// A pole on flat ground as the layer `raw`, and the result of HagenFilter.
class FilterHagenTest : public testing::Test {
 protected:
    FilterHagenTest() {
        const test::SimpleScene scene = test::sceneOf({}, {{12, 2, 0.15, 8}});
        Scan scan = test::scanScene(scene, sensorModel("VLP-16"), 870, {0, 0, 2}).scan;
        const auto cloud = mrpt::maps::CSimplePointsMap::Create();
        for (std::size_t i = 0; i < scan.size(); ++i) {
            cloud->insertPoint(scan.x_m[i], scan.y_m[i], scan.z_m[i]);
        }
        map_.layers["raw"] = cloud;
        HagenFilter filter(sensorModel("VLP-16"));
        expected_ = filter.segment(scan).returns;
    }
    const mrpt::maps::CPointsMap& layer(const char* name) const { return *map_.point_layer(name); }

    mp2p_icp::metric_map_t map_;
    LabelledReturns expected_;
};

TEST_F(FilterHagenTest, SplitsLayerLikeFilter) {
    mp2p_icp_filters::apply_filter_pipeline(pipelineWith({}), map_);
    EXPECT_GT(expected_.roi.size(), 40u);
    EXPECT_EQ(layer("roi").size(), expected_.roi.size());
    EXPECT_EQ(layer("rou").size(), expected_.label.size() - expected_.roi.size());
    for (const float x_m : layer("roi").getPointsBufferRef_x()) EXPECT_NEAR(x_m, 12.0f, 0.2f);
}

TEST_F(FilterHagenTest, LabelsPointsOfSharedLayer) {
    mp2p_icp_filters::apply_filter_pipeline(
        pipelineWith({{"output_layer_roi", "all"}, {"output_layer_rou", "all"}}), map_);
    const auto& all = layer("all");
    ASSERT_EQ(all.size(), expected_.label.size());
#if MRPT_VERSION >= 0x020f00
    for (std::size_t i = 0, roi = expected_.roi.size(); i < all.size(); ++i)
        EXPECT_EQ(all.getPointField_uint8(i, "label"), i < all.size() - roi ? 1 : 2);
#endif
}

TEST_F(FilterHagenTest, NamesWrongParameters) {
    const auto messageWith = [](const std::map<std::string, std::string>& changes) {
        return test::messageOf([&] { pipelineWith(changes); });
    };
    EXPECT_THAT(messageWith({{"output_layer_roi", "raw"}}), HasSubstr("same layer, 'raw'"));
    EXPECT_THAT(messageWith({{"output_layer_roi", ""}, {"output_layer_rou", ""}}),
                HasSubstr("pass at least one"));
    EXPECT_THAT(messageWith({{"settings", "vlp99"}}), HasSubstr("vlp99"));
    EXPECT_THAT(messageWith({{"sensor_pose", "0"}}), HasSubstr("sensor_pose"));
    const auto pipeline = pipelineWith({{"input_pointcloud_layer", "none"}});
    EXPECT_THAT(test::messageOf([&] { apply_filter_pipeline(pipeline, map_); }),
                HasSubstr("no layer 'none'"));
}

}  // namespace
}  // namespace hagen
