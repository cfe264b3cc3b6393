#include "CloudOutput.h"

#include <hagen/observations/LocatedCloud.h>
#include <hagen/observations/NewerClouds.h>
#include <hagen/observations/ObservationScan.h>
#include <hagen/observations/TableCloud.h>
#include <mrpt/obs/CObservationPointCloud.h>

#include <algorithm>
#include <numeric>

namespace hagen::logs {
namespace {

namespace fs = std::filesystem;
using observations::NumberType;
using observations::PointTable;

constexpr const char *kLabel = "label", *kObstacle = "obstacle";

/// The fields without labels, and the point of each return.
struct Unlabelled {
    PointTable table;
    std::vector<std::uint32_t> point_of_return;
};

/// Fields that a scan does not have: those of a rawlog of MRPT 3, and the tags of a Livox.
const PointTable* otherFieldsOf(const mrpt::maps::CPointsMap& cloud) {
    const auto* const located = dynamic_cast<const observations::LocatedCloud*>(&cloud);
    return located != nullptr ? &located->otherFields() : observations::otherFieldsOf(cloud);
}

void addOtherFields(const mrpt::obs::CObservation& observation, PointTable& table) {
    const auto* const cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
    if (cloud == nullptr || !cloud->pointcloud) return;
    const PointTable* const others = otherFieldsOf(*cloud->pointcloud);
    if (others == nullptr || others->points != table.points) return;
    for (const observations::PointField& field : others->fields) {
        if (findField(table, {field.name}) != nullptr) continue;
        addColumn(field.name, field.type, columnOf(*others, field), table);
    }
}

Unlabelled unlabelled(const observations::ObservationSegmenter::Output& segmented,
                      const mrpt::obs::CObservation& observation) {
    Unlabelled points;
    if (const auto* const cloud = observations::tableCloudOf(observation)) {
        points.table = inNativeOrder(cloud->table());
        points.point_of_return = cloud->pointOfReturn();
        return points;
    }
    const Scan& scan = *segmented.scan;
    points.table = observations::tableOf(scan);
    points.point_of_return.resize(scan.size());
    std::iota(points.point_of_return.begin(), points.point_of_return.end(), 0u);
    addOtherFields(observation, points.table);
    if (!observations::isCloud(observation) && segmented.sensor->has_rings) {
        addColumn("ring", NumberType::UInt16, {scan.row.begin(), scan.row.end()}, points.table);
    }
    return points;
}

}  // namespace

// Clouds of the user have such names, too: only the marker tells.
const base::OutputKind kClouds{"a folder of labelled clouds",
                               [](const fs::path& within) {
                                   return within.extension() == ".ply" ||
                                          within.extension() == ".pcd" || within == kCloudsMarker;
                               },
                               kCloudsMarker};

PointTable labelledTable(const observations::ObservationSegmenter::Output& segmented,
                         const mrpt::obs::CObservation& observation) {
    Unlabelled points = unlabelled(segmented, observation);
    for (observations::PointField& field : points.table.fields) {
        if (field.name == kLabel || field.name == kObstacle) field.name = "input_" + field.name;
    }
    const LabelledReturns& returns = segmented.result->returns;
    std::vector<double> labels(points.table.points, 0), obstacles(points.table.points, 0);
    for (std::size_t k = 0; k < points.point_of_return.size(); ++k) {
        const std::uint32_t i = points.point_of_return[k];
        labels[i] = static_cast<double>(returns.label[k]);
        obstacles[i] = std::max(returns.component[k], 0);
    }
    addColumn(kLabel, NumberType::UInt8, labels, points.table);
    addColumn(kObstacle, NumberType::UInt32, obstacles, points.table);
    return std::move(points.table);
}

std::vector<std::string> renamedFields(const PointTable& labelled) {
    std::vector<std::string> renamed;
    for (const char* const name : {"input_label", "input_obstacle"}) {
        if (findField(labelled, {name}) == nullptr) continue;
        renamed.push_back("a field of the input has the name of a field of labels: it is '" +
                          std::string(name) + "'");
    }
    return renamed;
}

void CloudChanges::add(const std::vector<std::string>& changes) {
    for (const std::string& change : changes) ++clouds_[change];
}

std::vector<std::string> CloudChanges::texts(std::size_t all_clouds) const {
    std::vector<std::string> texts;
    for (const auto& [change, clouds] : clouds_) {
        texts.push_back(change + (clouds == all_clouds
                                      ? ""
                                      : " (" + std::to_string(clouds) + " of " +
                                            std::to_string(all_clouds) + " clouds)"));
    }
    return texts;
}

CloudOutput::CloudOutput(const fs::path& folder, clouds::OutputFormat format, bool overwrite)
    : format_(format), folders_(folder, kClouds, overwrite) {}

void CloudOutput::write(const std::string& name,
                        const observations::ObservationSegmenter::Output& segmented,
                        const mrpt::obs::CObservation& observation) {
    const PointTable table = labelledTable(segmented, observation);
    changes_.add(renamedFields(table));
    changes_.add(changesWhenWritten(format_, table));
    writeCloud(folders_.folderOf(observation.sensorLabel) / (name + extensionOf(format_)), format_,
               table);
    ++files_;
    points_ += table.points;
}

}  // namespace hagen::logs
