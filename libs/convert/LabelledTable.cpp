#include "convert/LabelledTable.h"

#include <hagen/mrpt/LocatedCloud.h>
#include <hagen/mrpt/NewerClouds.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include "convert/UniqueNames.h"
#include "mrpt/PointFields.h"
#include "mrpt/Results.h"
#include "mrpt/TableCloud.h"

#include <algorithm>
#include <iterator>
#include <limits>
#include <numeric>
#include <optional>

namespace hagen::convert {
namespace {

using observations::NumberType;
using observations::PointTable;

constexpr const char *kLabel = "label", *kObstacle = "obstacle";

/// All fields except the labels, and the point of each return.
struct Unlabelled {
    PointTable table;
    std::vector<std::uint32_t> point_of_return;
};

/// Fields that a scan does not contain: those of a rawlog of MRPT 3, and the tags of a Livox.
std::optional<PointTable> otherFieldsOf(const mrpt::maps::CPointsMap& cloud) {
    const auto* const located = dynamic_cast<const observations::LocatedCloud*>(&cloud);
    return located != nullptr ? located->otherFields() : observations::otherFieldsOf(cloud);
}

/// Combines the fields of a scan, including times, with the observation's other fields.
PointTable withOtherFields(const Scan& scan, const mrpt::obs::CObservation& observation) {
    const auto* const cloud = dynamic_cast<const mrpt::obs::CObservationPointCloud*>(&observation);
    const std::optional<PointTable> others =
        cloud != nullptr && cloud->pointcloud ? otherFieldsOf(*cloud->pointcloud) : std::nullopt;
    if (!others || others->points != scan.size()) return observations::tableOf(scan);
    const bool has_times = timeFieldOf(*others) != nullptr;
    PointTable table = has_times ? observations::untimedTableOf(scan) : observations::tableOf(scan);
    for (const observations::PointField& field : others->fields) {
        if (findExactly(table, field.name) != nullptr) continue;
        addColumn(field.name, field.type, columnOf(*others, field), table);
    }
    return table;
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
    points.table = withOtherFields(scan, observation);
    points.point_of_return.resize(scan.size());
    std::iota(points.point_of_return.begin(), points.point_of_return.end(), 0u);
    if (!observations::isCloud(observation) && segmented.sensor->has_rings) {
        addColumn("ring", NumberType::UInt16, {scan.row.begin(), scan.row.end()}, points.table);
    }
    return points;
}

/// Renames input fields whose names are `taken` to unique names; returns the new names.
std::vector<std::string> renameTaken(const std::vector<std::string>& taken, PointTable& table) {
    const auto isTaken = [&](const observations::PointField& field) {
        return std::find(taken.begin(), taken.end(), field.name) != taken.end();
    };
    recordings::UniqueNames names;
    for (const observations::PointField& field : table.fields) {
        if (!isTaken(field)) names.of(field.name);
    }
    std::vector<std::string> renamed;
    for (observations::PointField& field : table.fields) {
        if (!isTaken(field)) continue;
        field.name = names.of("input_" + field.name);
        renamed.push_back(field.name);
    }
    return renamed;
}

/// Adds label and obstacle; renames fields of the input with the same names.
LabelledTable labelled(const observations::ObservationSegmenter::Output& segmented,
                       Unlabelled points, NumberType obstacle_type) {
    LabelledTable labelled;
    labelled.renamed = renameTaken({kLabel, kObstacle}, points.table);
    const LabelledReturns& returns = segmented.result->returns;
    const std::int32_t max = obstacle_type == NumberType::UInt16
                                 ? recordings::kMaxFileComponent
                                 : std::numeric_limits<std::int32_t>::max();
    std::vector<double> labels(points.table.points, 0), obstacles(points.table.points, 0);
    for (std::size_t k = 0; k < points.point_of_return.size(); ++k) {
        const std::uint32_t i = points.point_of_return[k];
        labels[i] = static_cast<double>(returns.label[k]);
        obstacles[i] = std::clamp(returns.component[k], 0, max);
    }
    addColumn(kLabel, NumberType::UInt8, labels, points.table);
    addColumn(kObstacle, obstacle_type, obstacles, points.table);
    labelled.table = std::move(points.table);
    return labelled;
}

/// A cloud of these points, all in the same colour.
mrpt::maps::CPointsMap::Ptr coloredCloudOf(const PointTable& table,
                                           const std::vector<std::uint32_t>& points,
                                           const mrpt::img::TColor& color) {
    PointTable some = pointsOf(table, points);
    const std::array<std::uint8_t, 3> values{color.R, color.G, color.B};
    for (std::size_t i = 0; i < values.size(); ++i) {
        addColumn(observations::kColorFields[i], NumberType::UInt8,
                  std::vector<double>(some.points, values[i]), some);
    }
    return observations::genericCloudOf(some);
}

}  // namespace

LabelledTable labelledTable(const observations::ObservationSegmenter::Output& segmented,
                            const mrpt::obs::CObservation& observation) {
    return labelled(segmented, unlabelled(segmented, observation), NumberType::UInt32);
}

std::vector<std::string> LabelledTable::remarks() const {
    std::vector<std::string> remarks;
    for (const std::string& name : renamed) {
        remarks.push_back("an input field conflicts with a label field and is renamed to '" + name +
                          "'");
    }
    return remarks;
}

void useCloudsWithFields(const mrpt::obs::CObservation& observation,
                         observations::ObservationSegmenter::Output& segmented) {
    Unlabelled points = unlabelled(segmented, observation);
    renameTaken({std::begin(observations::kColorFields), std::end(observations::kColorFields)},
                points.table);
    if (observations::tableCloudOf(observation) == nullptr &&
        findField(points.table, {"t"}) == nullptr) {
        for (auto& field : points.table.fields) {
            if (field.name == "time") field.name = "t";
        }
    }
    const std::vector<std::uint32_t> point_of_return = points.point_of_return;
    // CGenericPointsMap does not support uint32 before MRPT 3.
    const PointTable table = labelled(segmented, std::move(points), NumberType::UInt16).table;
    const auto pointsOfReturns = [&](const std::vector<std::uint32_t>& returns) {
        std::vector<std::uint32_t> of_returns;
        for (const std::uint32_t k : returns) of_returns.push_back(point_of_return[k]);
        return of_returns;
    };
    const LabelledReturns& returns = segmented.result->returns;
    segmented.roi->pointcloud =
        coloredCloudOf(table, pointsOfReturns(returns.roi), observations::kRoiColor);
    segmented.non_roi->pointcloud =
        coloredCloudOf(table, pointsOfReturns(returns.rou), observations::kNonRoiColor);
}

}  // namespace hagen::convert
