#include "FilterHagen.h"

#include <hagen/mrpt/MrptCompat.h>
#include <hagen/scan/Label.h>
#include <hagen/settings/Presets.h>
#include <hagen/settings/Settings.h>
#include <mrpt/core/initializer.h>
#include <mrpt/math/TPose3D.h>

#include <stdexcept>

IMPLEMENTS_MRPT_OBJECT(FilterHagen, mp2p_icp_filters::FilterBase, hagen)

MRPT_INITIALIZER(registerFilterHagen) { mrpt::rtti::registerClass(CLASS_ID(hagen::FilterHagen)); }

namespace hagen {

namespace {

using mrpt::maps::CPointsMap;

mrpt::poses::CPose3D poseOf(const mrpt::containers::yaml& numbers) {
    if (!numbers.isSequence() || numbers.asSequence().size() != 6) {
        throw std::runtime_error(
            "FilterHagen: sensor_pose: expected [x, y, z, yaw, pitch, roll], in metres and "
            "degrees");
    }
    const auto at = [&numbers](int i) { return numbers(i).as<double>(); };
    return mrpt::poses::CPose3D(mrpt::math::TPose3D(at(0), at(1), at(2), mrpt::DEG2RAD(at(3)),
                                                    mrpt::DEG2RAD(at(4)), mrpt::DEG2RAD(at(5))));
}

/// Returns null if there is no layer of this name.
CPointsMap::Ptr findLayer(const mp2p_icp::metric_map_t& map, const std::string& name) {
    const auto layer = map.layers.find(name);
    if (layer == map.layers.end()) return nullptr;
    if (auto cloud = std::dynamic_pointer_cast<CPointsMap>(layer->second)) return cloud;
    throw std::runtime_error("FilterHagen: layer '" + name + "' is not a point cloud");
}

/// Appends the points whose flag is set to a layer, which is created if missing.
void appendTo(const std::string& name, const CPointsMap& from, const std::vector<bool>& is_chosen,
              Label label, mp2p_icp::metric_map_t& map) {
    if (name.empty()) return;
    CPointsMap::Ptr to = findLayer(map, name);
#if MRPT_VERSION < 0x020f00
    static_cast<void>(label);
    if (!to) to = std::dynamic_pointer_cast<CPointsMap>(from.GetRuntimeClass()->createObject());
    for (std::size_t i = 0; i < from.size(); ++i) {
        if (is_chosen[i]) to->insertPointFrom(from, i);
    }
#else
    if (!to) to = mrpt::maps::CGenericPointsMap::Create();
    const std::size_t before = to->size();
    observations::appendPoints(from, is_chosen, *to);
    to->registerField_uint8("label");
    to->resizeField_uint8("label", to->size());
    for (std::size_t i = before; i < to->size(); ++i) {
        to->setPointField_uint8(i, "label", static_cast<std::uint8_t>(label));
    }
#endif
    map.layers[name] = to;
}

}  // namespace

FilterHagen::FilterHagen() { setLoggerName("FilterHagen"); }

void FilterHagen::initialize(const mrpt::containers::yaml& parameters) {
    initialize_filter(parameters);
}

void FilterHagen::initialize_filter(const mrpt::containers::yaml& parameters) {
    const auto text = [&parameters](const char* key, const char* standard) {
        return parameters.getOrDefault<std::string>(key, standard);
    };
    input_layer_ = text("input_pointcloud_layer", mp2p_icp::metric_map_t::PT_LAYER_RAW);
    roi_layer_ = text("output_layer_roi", "");
    rou_layer_ = text("output_layer_rou", "");
    if (roi_layer_.empty() && rou_layer_.empty()) {
        throw std::runtime_error(
            "FilterHagen: output_layer_roi and output_layer_rou are missing; pass at least one");
    }
    if (input_layer_ == roi_layer_ || input_layer_ == rou_layer_) {
        throw std::runtime_error("FilterHagen: input and output are the same layer, '" +
                                 input_layer_ + "'");
    }
    Settings settings;
    const std::string file = text("settings", "");
    if (!file.empty()) mergeSettings(presetFile(file), settings);
    filter_.emplace(settings, parameters.has("sensor_pose") ? poseOf(parameters["sensor_pose"])
                                                            : mrpt::poses::CPose3D());
}

void FilterHagen::filter(mp2p_icp::metric_map_t& map) const {
    const CPointsMap::Ptr input = findLayer(map, input_layer_);
    if (!input) {
        throw std::runtime_error("FilterHagen: there is no layer '" + input_layer_ + "'");
    }
    if (!filter_) throw std::runtime_error("FilterHagen: initialize() was not called");
    std::vector<bool> is_rou;
    mrpt::maps::CPointCloudFilterBase::TExtraFilterParams keep_all;
    keep_all.do_not_delete = true;
    keep_all.out_deletion_mask = &is_rou;
    {
        const std::lock_guard lock(segmenting_);
        filter_->filter(input.get(), {}, {}, &keep_all);
    }
    appendTo(rou_layer_, *input, is_rou, Label::Rou, map);
    is_rou.flip();
    appendTo(roi_layer_, *input, is_rou, Label::Roi, map);
}

}  // namespace hagen
