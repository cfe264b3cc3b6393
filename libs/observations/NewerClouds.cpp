#include <hagen/observations/NewerClouds.h>

#include <mrpt/core/aligned_std_vector.h>
#include <mrpt/maps/CPointsMapXYZI.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/aligned_serialization.h>
#include <mrpt/serialization/stl_serialization.h>
#include <mrpt/version.h>

#include <algorithm>
#include <cstdint>
#include <stdexcept>
#include <type_traits>

#include "ArchiveParts.h"

namespace hagen::observations {
#if MRPT_VERSION < 0x020f00
namespace {

using mrpt::maps::CPointsMap;
using mrpt::maps::CPointsMapXYZI;
using mrpt::maps::CSimplePointsMap;
using mrpt::serialization::CArchive;

/// The coordinates, with their number.
struct Coordinates {
    std::vector<float> x_m, y_m, z_m;

    explicit Coordinates(CArchive& in) {
        const auto count = in.ReadAs<std::uint32_t>();
        readNumbers(in, count, x_m);
        readNumbers(in, count, y_m);
        readNumbers(in, count, z_m);
    }
    void copyTo(CPointsMap& cloud) const {
        cloud.setSize(x_m.size());
        for (std::size_t i = 0; i < x_m.size(); ++i) {
            cloud.setPointFast(i, x_m[i], y_m[i], z_m[i]);
        }
        cloud.mark_as_modified();
    }
};

/// Version 1 has no `disableDeletion`.
void readInsertionOptions(CArchive& in, CPointsMap::TInsertionOptions& options) {
    const auto version = in.ReadAs<std::int8_t>();
    if (version != 0 && version != 1) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
    in >> options.minDistBetweenLaserPoints >> options.addToExistingPointsMap >>
        options.also_interpolate;
    if (version == 0) in >> options.disableDeletion;
    in >> options.fuseWithExisting >> options.isPlanarMap >> options.horizontalTolerance >>
        options.maxDistForInterpolatePoints >> options.insertInvalidPoints;
}

/// A CSimplePointsMap whose insertion options may be newer. It is written as the older one, since
/// its class and writing are inherited.
class SimpleCloud : public CSimplePointsMap {
    static constexpr std::uint8_t kVersionWithOptions = 10;

    void serializeFrom(CArchive& in, std::uint8_t version) override {
        if (version != kVersionWithOptions) {
            CSimplePointsMap::serializeFrom(in, version);
            return;
        }
        Coordinates(in).copyTo(*this);
        in >> genericMapParams;
        readInsertionOptions(in, insertionOptions);
        likelihoodOptions.readFromStream(in);
        renderOptions.readFromStream(in);
    }
};

/// A CGenericPointsMap: coordinates, then named fields by type. It is written as CPointsMapXYZI.
class GenericCloud : public CPointsMapXYZI {
 public:
    std::vector<std::string> fields_not_kept;
    PointTable other_fields;

 private:
    static constexpr std::uint8_t kNewestVersion = 4;
    static constexpr std::size_t kMostFields = 256;

    void serializeFrom(CArchive& in, std::uint8_t version) override {
        if (version > kNewestVersion) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
        fields_not_kept.clear();
        Coordinates(in).copyTo(*this);
        other_fields = {};
        other_fields.points = size();
        readFields<float>(in, version);
        if (version >= 1) readFields<double>(in, version);
        readFields<std::uint16_t>(in, version);
        if (version >= 2) readFields<std::uint8_t>(in, version);
        if (version >= 4) readFields<std::uint32_t>(in, version);
        readInsertionOptions(in, insertionOptions);
        likelihoodOptions.readFromStream(in);
    }

    template <class Number>
    void keep(const std::string& name, const std::vector<double>& values) {
        if (values.size() != size() || name.empty() || findField(other_fields, {name}) != nullptr) {
            return;
        }
        const NumberType type = std::is_same_v<Number, float>           ? NumberType::Float32
                                : std::is_same_v<Number, double>        ? NumberType::Float64
                                : std::is_same_v<Number, std::uint16_t> ? NumberType::UInt16
                                : std::is_same_v<Number, std::uint8_t>  ? NumberType::UInt8
                                                                        : NumberType::UInt32;
        addColumn(name, type, values, other_fields);
    }

    /// The fields of one type.
    template <class Number>
    void readFields(CArchive& in, std::uint8_t version) {
        for (auto fields = in.ReadAs<std::uint32_t>(); fields > 0; --fields) {
            const std::string name = readName(in);
            mrpt::aligned_std_vector<Number> values;
            if (version >= 3 || std::is_same_v<Number, float>) {
                readNumbers(in, in.ReadAs<std::uint32_t>(), values);
            } else {
                in >> values;
            }
            if (name != "intensity") {
                if (fields_not_kept.size() >= kMostFields) {
                    throw std::runtime_error("a cloud has too many fields");
                }
                fields_not_kept.push_back(name);
                keep<Number>(name, {values.begin(), values.end()});
                continue;
            }
            for (std::size_t i = 0; i < std::min(values.size(), size()); ++i) {
                setPointIntensity(i, static_cast<float>(values[i]));
            }
        }
    }
};

}  // namespace

void registerNewerClouds() {
    registerAs<SimpleCloud, CSimplePointsMap>("mrpt::maps::CSimplePointsMap");
    registerAs<GenericCloud, CPointsMapXYZI>("mrpt::maps::CGenericPointsMap");
}

std::vector<std::string> fieldsNotKept(const CPointsMap& cloud) {
    const auto* generic = dynamic_cast<const GenericCloud*>(&cloud);
    return generic == nullptr ? std::vector<std::string>() : generic->fields_not_kept;
}

const PointTable* otherFieldsOf(const CPointsMap& cloud) {
    const auto* generic = dynamic_cast<const GenericCloud*>(&cloud);
    return generic == nullptr ? nullptr : &generic->other_fields;
}

#else

void registerNewerClouds() {}
std::vector<std::string> fieldsNotKept(const mrpt::maps::CPointsMap&) { return {}; }
const PointTable* otherFieldsOf(const mrpt::maps::CPointsMap&) { return nullptr; }

#endif
}  // namespace hagen::observations
