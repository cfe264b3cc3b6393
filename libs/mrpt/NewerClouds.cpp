#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/NewerClouds.h>
#include <mrpt/core/aligned_std_vector.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/aligned_serialization.h>
#include <mrpt/serialization/stl_serialization.h>
#include <mrpt/version.h>

#include <set>
#include <stdexcept>
#include <type_traits>

#include "mrpt/ArchiveParts.h"

namespace hagen::observations {
namespace {

using mrpt::maps::CPointsMap;
using mrpt::maps::CSimplePointsMap;
using mrpt::serialization::CArchive;

/// Reads a vector of numbers other than float: two type names, then the numbers. MRPT's reader
/// trusts the count in the file.
template <class Vector>
void readVector(CArchive& in, Vector& values) {
    const std::string container = readText(in), type = readText(in);
    const std::string wanted =
        mrpt::typemeta::TTypeName<typename Vector::value_type>::get().c_str();
    if (container != "std::vector" || type != wanted) {
        throw std::runtime_error("the values of a field are not a std::vector of " + wanted);
    }
    readNumbers(in, in.ReadAs<std::uint32_t>(), values);
}

template <class Number>
constexpr NumberType typeOf() {
    if (std::is_same_v<Number, float>) return NumberType::Float32;
    if (std::is_same_v<Number, double>) return NumberType::Float64;
    if (std::is_same_v<Number, std::uint16_t>) return NumberType::UInt16;
    return std::is_same_v<Number, std::uint8_t> ? NumberType::UInt8 : NumberType::UInt32;
}

/// The coordinates of a cloud, read after the point count.
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
#if MRPT_VERSION < 0x020f00
    if (version == 0) in >> options.disableDeletion;
#else
    if (version == 0) in.ReadAs<bool>();  // disableDeletion
#endif
    in >> options.fuseWithExisting >> options.isPlanarMap >> options.horizontalTolerance >>
        options.maxDistForInterpolatePoints >> options.insertInvalidPoints;
}

/// A CSimplePointsMap that reads older and newer insertion options and writes older ones.
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

constexpr const char* kGenericName = "mrpt::maps::CGenericPointsMap";
const mrpt::rtti::TRuntimeClassId& genericClass();

/// A CGenericPointsMap: coordinates, then named fields by type. MRPT before 2.15 cannot read it, so
/// that by default it is written as CPointsMapXYZI there.
class GenericCloud : public IntensityCloud {
 public:
    std::vector<std::string> fields_not_kept;
    PointTable other_fields;
    bool has_intensity = false;
    bool is_written_as_generic = MRPT_VERSION >= 0x020f00;

    mrpt::rtti::CObject* clone() const override { return new GenericCloud(*this); }
    const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override {
        return writesFields() ? &genericClass() : IntensityCloud::GetRuntimeClass();
    }

    /// Copies the colour of the first point to renderOptions, from which colour fields are written.
    void takeColor() {
        std::array<float, 3> color{};
        for (std::size_t i = 0; i < 3; ++i) {
            const PointField* const field = findField(other_fields, {kColorFields[i]});
            if (field == nullptr) return;
            if (!empty()) color[i] = static_cast<float>(columnOf(other_fields, *field)[0]) / 255.0f;
        }
        if (!empty()) renderOptions.color = {color[0], color[1], color[2]};
    }

 private:
    static constexpr std::uint8_t kNewestVersion = 4;
    /// The first version with colour fields.
    static constexpr std::uint8_t kWrittenVersion = 3;
    static constexpr std::size_t kMaxFields = 256;

    /// Not if the number of points has changed since the fields were set.
    bool writesFields() const { return is_written_as_generic && other_fields.points == size(); }

    std::uint8_t serializeGetVersion() const override {
        return writesFields() ? kWrittenVersion : IntensityCloud::serializeGetVersion();
    }

    void serializeTo(CArchive& out) const override {
        if (!writesFields()) {
            IntensityCloud::serializeTo(out);
            return;
        }
        out.WriteAs<std::uint32_t>(size());
        for (const auto* const axis :
             {&getPointsBufferRef_x(), &getPointsBufferRef_y(), &getPointsBufferRef_z()}) {
            if (!axis->empty()) out.WriteBufferFixEndianness(axis->data(), axis->size());
        }
        writeFields<float>(out);
        writeFields<double>(out);
        writeFields<std::uint16_t>(out);
        writeFields<std::uint8_t>(out);
        insertionOptions.writeToStream(out);
        likelihoodOptions.writeToStream(out);
    }

    /// The type in which numbers are written: float64 for types that the class does not support.
    static NumberType writtenType(NumberType type) {
        const bool is_kept =
            type == NumberType::Float32 || type == NumberType::UInt16 || type == NumberType::UInt8;
        return is_kept ? type : NumberType::Float64;
    }

    template <class Number>
    static void writeField(const std::string& name, const std::vector<double>& values,
                           CArchive& out) {
        std::vector<Number> numbers(values.size());
        std::transform(values.begin(), values.end(), numbers.begin(),
                       [](double value) { return static_cast<Number>(value); });
        out << name;
        out.WriteAs<std::uint32_t>(numbers.size());
        if (!numbers.empty()) out.WriteBufferFixEndianness(numbers.data(), numbers.size());
    }

    /// Writes all fields of one type. Fields with several numbers per point become several fields.
    template <class Number>
    void writeFields(CArchive& out) const {
        const auto* const intensities = intensitiesOf(*this);
        const bool with_intensity = std::is_same_v<Number, float> && has_intensity && intensities;
        std::uint32_t count = with_intensity ? 1 : 0;
        for (const PointField& field : other_fields.fields) {
            if (writtenType(field.type) == typeOf<Number>())
                count += static_cast<std::uint32_t>(field.count);
        }
        out << count;
        if (with_intensity) {
            writeField<Number>("intensity", {intensities->begin(), intensities->end()}, out);
        }
        for (const PointField& field : other_fields.fields) {
            if (writtenType(field.type) != typeOf<Number>()) continue;
            for (std::size_t element = 0; element < field.count; ++element) {
                const std::string number = field.count == 1 ? "" : "_" + std::to_string(element);
                writeField<Number>(field.name + number, columnOf(other_fields, field, element),
                                   out);
            }
        }
    }

    void serializeFrom(CArchive& in, std::uint8_t version) override {
        if (version > kNewestVersion) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
        fields_not_kept.clear();
        Coordinates(in).copyTo(*this);
        other_fields = {};
        other_fields.points = size();
        has_intensity = false;
        readFields<float>(in, version);
        if (version >= 1) readFields<double>(in, version);
        readFields<std::uint16_t>(in, version);
        if (version >= 2) readFields<std::uint8_t>(in, version);
        if (version >= 4) readFields<std::uint32_t>(in, version);
        readInsertionOptions(in, insertionOptions);
        likelihoodOptions.readFromStream(in);
        takeColor();
    }

    /// Keeps a field, or returns why it cannot be kept.
    template <class Number>
    std::string keep(const std::string& name, const std::vector<double>& values) {
        if (name.empty()) return "no name";
        if (findExactly(other_fields, name) != nullptr) return "duplicate name";
        if (values.size() != size()) {
            return "expected one value per point (" + std::to_string(size()) + "), found " +
                   std::to_string(values.size());
        }
        addColumn(name, typeOf<Number>(), values, other_fields);
        return "";
    }

    template <class Number>
    void readFields(CArchive& in, std::uint8_t version) {
        for (auto fields = in.ReadAs<std::uint32_t>(); fields > 0; --fields) {
            const std::string name = readText(in);
            mrpt::aligned_std_vector<Number> values;
            if (version >= 3 || std::is_same_v<Number, float>) {
                readNumbers(in, in.ReadAs<std::uint32_t>(), values);
            } else {
                readVector(in, values);
            }
            if (name != "intensity") {
                if (fields_not_kept.size() >= kMaxFields) {
                    throw std::runtime_error("a cloud has too many fields");
                }
                const std::string why = keep<Number>(name, {values.begin(), values.end()});
                const std::string unless = " (not kept: " + why + ")";
                fields_not_kept.push_back(why.empty() ? name : name + unless);
                continue;
            }
            has_intensity = true;
            for (std::size_t i = 0; i < std::min(values.size(), size()); ++i) {
                setPointIntensity(i, static_cast<float>(values[i]));
            }
        }
    }
};

const mrpt::rtti::TRuntimeClassId& genericClass() {
    static const mrpt::rtti::TRuntimeClassId id{
        kGenericName,
        [] {
            return std::static_pointer_cast<mrpt::rtti::CObject>(std::make_shared<GenericCloud>());
        },
        [] { return CLASS_ID(IntensityCloud); }};
    return id;
}

}  // namespace

void registerNewerClouds() {
#if MRPT_VERSION < 0x020f00
    registerAs<SimpleCloud, CSimplePointsMap>("mrpt::maps::CSimplePointsMap");
#endif
    registerAs<GenericCloud, IntensityCloud>(kGenericName);
}

std::vector<std::string> fieldsNotKept(const CPointsMap& cloud) {
    const auto* generic = dynamic_cast<const GenericCloud*>(&cloud);
    return generic == nullptr ? std::vector<std::string>() : generic->fields_not_kept;
}

const PointTable* otherFieldsOf(const CPointsMap& cloud) {
    const auto* generic = dynamic_cast<const GenericCloud*>(&cloud);
    return generic == nullptr ? nullptr : &generic->other_fields;
}

CPointsMap::Ptr genericCloudOf(const PointTable& table) {
    const auto column = [&](const char* name) {
        const PointField* const field = findField(table, {name});
        if (field == nullptr) {
            throw std::invalid_argument(std::string("a point table has no field ") + name);
        }
        return columnOf(table, *field);
    };
    const std::vector<double> x_m = column("x"), y_m = column("y"), z_m = column("z");
    const PointField* const intensity = findField(table, {"intensity"});
    const auto cloud = std::make_shared<GenericCloud>();
    cloud->is_written_as_generic = true;
    cloud->has_intensity = intensity != nullptr;
    cloud->other_fields = table;
    auto& others = cloud->other_fields.fields;
    const std::set<std::string> standard{"x", "y", "z", "intensity"};
    const auto isStandard = [&](const PointField& field) { return standard.count(field.name) > 0; };
    others.erase(std::remove_if(others.begin(), others.end(), isStandard), others.end());
    cloud->setSize(table.points);
    for (std::size_t i = 0; i < table.points; ++i) {
        cloud->setPointFast(i, static_cast<float>(x_m[i]), static_cast<float>(y_m[i]),
                            static_cast<float>(z_m[i]));
    }
    if (intensity != nullptr) {
        const std::vector<double> intensities = columnOf(table, *intensity);
        for (std::size_t i = 0; i < table.points; ++i) {
            cloud->setPointIntensity(i, static_cast<float>(intensities[i]));
        }
    }
    cloud->takeColor();
    cloud->mark_as_modified();
    return cloud;
}

void writeAsGeneric(CPointsMap& cloud) {
    if (auto* const generic = dynamic_cast<GenericCloud*>(&cloud)) {
        generic->is_written_as_generic = true;
    }
}

}  // namespace hagen::observations
