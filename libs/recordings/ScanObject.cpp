#include "recordings/ScanObject.h"

#include <hagen/mrpt/LocatedCloud.h>
#include <hagen/mrpt/MrptCompat.h>
#include <mrpt/obs/CObservationPointCloud.h>
#include <mrpt/obs/CSensoryFrame.h>
#include "mrpt/TableCloud.h"

#include <algorithm>
#include <iterator>

namespace hagen::recordings {
namespace {

using mrpt::obs::CObservation;
using mrpt::obs::CObservationPointCloud;
using observations::NumberType;
using observations::PointTable;

/// Converts a cloud's returns to a table with all of their fields.
PointTable tableOfReturns(const mrpt::maps::CPointsMap& cloud) {
    if (const auto* const table = dynamic_cast<const observations::TableCloud*>(&cloud)) {
        return pointsOf(inNativeOrder(table->table()), table->pointOfReturn());
    }
    PointTable table;
    table.points = cloud.size();
    const auto add = [&](const char* name, NumberType type, const auto& values) {
        addColumn(name, type, {values.begin(), values.end()}, table);
    };
    add("x", NumberType::Float32, cloud.getPointsBufferRef_x());
    add("y", NumberType::Float32, cloud.getPointsBufferRef_y());
    add("z", NumberType::Float32, cloud.getPointsBufferRef_z());
    if (const auto* const intensities = observations::intensitiesOf(cloud)) {
        add("intensity", NumberType::Float32, *intensities);
    }
    if (const auto* const located = dynamic_cast<const observations::LocatedCloud*>(&cloud)) {
        if (located->sensor().has_rings) add("ring", NumberType::UInt16, located->rows());
        if (!located->times_s().empty()) add("t", NumberType::Float32, located->times_s());
        const PointTable& others = located->otherFields();
        for (const observations::PointField& field : others.fields) {
            addColumn(field.name, field.type, columnOf(others, field), table);
        }
    }
    return table;
}

void writeAsGeneric(CObservation& observation) {
    const auto* const cloud = dynamic_cast<const CObservationPointCloud*>(&observation);
    if (cloud != nullptr && cloud->pointcloud) observations::writeAsGeneric(*cloud->pointcloud);
}

}  // namespace

std::vector<CObservation::Ptr> observationsOf(
    const mrpt::serialization::CSerializable::Ptr& entry) {
    std::vector<CObservation::Ptr> observations;
    if (const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry)) {
        std::copy_if(frame->begin(), frame->end(), std::back_inserter(observations),
                     [](const CObservation::Ptr& part) { return part != nullptr; });
    } else if (const auto observation = std::dynamic_pointer_cast<CObservation>(entry)) {
        observations.push_back(observation);
    }
    return observations;
}

std::size_t takeOutNulls(const mrpt::serialization::CSerializable::Ptr& entry) {
    const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(entry);
    if (!frame) return 0;
    std::size_t nulls = 0;
    for (auto part = frame->begin(); part != frame->end();) {
        const bool is_null = *part == nullptr;
        nulls += is_null;
        part = is_null ? frame->erase(part) : std::next(part);
    }
    return nulls;
}

mrpt::serialization::CSerializable::Ptr objectOf(
    const CObservation::Ptr& scan, const std::optional<observations::CloudClass>& cloud_class) {
    const auto cloud = std::dynamic_pointer_cast<CObservationPointCloud>(scan);
    if (!cloud) return scan;
    if (!cloud_class) return nullptr;
    auto copy = CObservationPointCloud::Create(*cloud);
    if (*cloud_class == observations::CloudClass::Simple) {
        const auto points = observations::PortableCloud::Create();
        const mrpt::maps::CPointsMap& all = *cloud->pointcloud;
        points->setSize(all.size());
        for (std::size_t i = 0; i < all.size(); ++i) {
            points->setPointFast(i, all.getPointsBufferRef_x()[i], all.getPointsBufferRef_y()[i],
                                 all.getPointsBufferRef_z()[i]);
        }
        points->mark_as_modified();
        copy->pointcloud = points;
    }
    if (*cloud_class == observations::CloudClass::Generic) {
        copy->pointcloud = observations::genericCloudOf(tableOfReturns(*cloud->pointcloud));
    }
    return copy;
}

void keepFields(const mrpt::serialization::CSerializable::Ptr& entry) {
    for (const CObservation::Ptr& observation : observationsOf(entry)) writeAsGeneric(*observation);
}

}  // namespace hagen::recordings
