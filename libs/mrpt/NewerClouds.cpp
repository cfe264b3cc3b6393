#include <hagen/mrpt/MrptCompat.h>
#include <hagen/mrpt/NewerClouds.h>
#include <mrpt/core/aligned_std_vector.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/stl_serialization.h>
#include <mrpt/version.h>

#include <optional>
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

/// The type in which numbers are written: float64 for types that the class does not support.
NumberType writtenType(NumberType type) {
    const bool is_kept = type == NumberType::Float32 || type == NumberType::UInt16 ||
                         type == NumberType::UInt8 ||
                         (type == NumberType::UInt32 && MRPT_VERSION >= 0x030000);
    return is_kept ? type : NumberType::Float64;
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
constexpr const char* kIntensity = "intensity";

/// The content of a CGenericPointsMap: coordinates, then named fields by type.
struct GenericContent {
    Coordinates coordinates;
    PointTable fields;  ///< intensities are float
    std::vector<std::string> fields_refused;

    GenericContent(CArchive& in, std::uint8_t version) : coordinates(in) {
        fields.points = coordinates.x_m.size();
        readFields<float>(in, version);
        if (version >= 1) readFields<double>(in, version);
        readFields<std::uint16_t>(in, version);
        if (version >= 2) readFields<std::uint8_t>(in, version);
        if (version >= 4) readFields<std::uint32_t>(in, version);
    }

 private:
    /// Keeps a field, or returns why it cannot be kept.
    std::string keep(const std::string& name, NumberType type, const std::vector<double>& values) {
        if (name.empty()) return "no name";
        if (findExactly(fields, name) != nullptr) return "duplicate name";
        if (values.size() != fields.points) {
            return "expected one value per point (" + std::to_string(fields.points) + "), found " +
                   std::to_string(values.size());
        }
        addColumn(name, name == kIntensity ? NumberType::Float32 : type, values, fields);
        return "";
    }

    template <class Number>
    void readFields(CArchive& in, std::uint8_t version) {
        for (auto count = in.ReadAs<std::uint32_t>(); count > 0; --count) {
            const std::string name = readText(in);
            mrpt::aligned_std_vector<Number> values;
            if (version >= 3 || std::is_same_v<Number, float>) {
                readNumbers(in, in.ReadAs<std::uint32_t>(), values);
            } else {
                readVector(in, values);
            }
            if (fields.fields.size() + fields_refused.size() >= 256) {
                throw std::runtime_error("a cloud has too many fields");
            }
            const std::string why = keep(name, typeOf<Number>(), {values.begin(), values.end()});
            if (!why.empty()) fields_refused.push_back(name + " (not kept: " + why + ")");
        }
    }
};

#if MRPT_VERSION < 0x020f00
/// A CGenericPointsMap, which this MRPT cannot read. By default it is written as CPointsMapXYZI.
class GenericCloud : public IntensityCloud {
 public:
    std::vector<std::string> fields_refused;
    PointTable fields;
    bool is_written_as_generic = false;

    mrpt::rtti::CObject* clone() const override { return new GenericCloud(*this); }
    const mrpt::rtti::TRuntimeClassId* GetRuntimeClass() const override {
        return writesFields() ? &classAs<GenericCloud, CPointsMap>(kGenericName)
                              : IntensityCloud::GetRuntimeClass();
    }

    void setFields(const PointTable& table) {
        fields = table;
        const PointField* const field = findExactly(fields, kIntensity);
        if (field == nullptr) return;
        const std::vector<double> intensities = columnOf(fields, *field);
        for (std::size_t i = 0; i < size(); ++i) {
            setPointIntensity(i, static_cast<float>(intensities[i]));
        }
    }

 private:
    /// The first version with colour fields.
    static constexpr std::uint8_t kWrittenVersion = 3;

    /// Not if the number of points has changed since the fields were set.
    bool writesFields() const { return is_written_as_generic && fields.points == size(); }

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

    /// Writes all fields of one type; with double, those of types that the version lacks.
    template <class Number>
    void writeFields(CArchive& out) const {
        std::vector<const PointField*> written;
        for (const PointField& field : fields.fields) {
            if (writtenType(field.type) == typeOf<Number>()) written.push_back(&field);
        }
        out.WriteAs<std::uint32_t>(written.size());
        for (const PointField* const field : written) {
            std::vector<double> values = columnOf(fields, *field);
            const auto* const own = field->name == kIntensity ? intensitiesOf(*this) : nullptr;
            if (own != nullptr) values.assign(own->begin(), own->end());  // may have been changed
            std::vector<Number> numbers(values.size());
            std::transform(values.begin(), values.end(), numbers.begin(),
                           [](double value) { return static_cast<Number>(value); });
            out << field->name;
            out.WriteAs<std::uint32_t>(numbers.size());
            if (!numbers.empty()) out.WriteBufferFixEndianness(numbers.data(), numbers.size());
        }
    }

    void serializeFrom(CArchive& in, std::uint8_t version) override;
};

#else
/// MRPT's class, read by GenericContent: all versions, and without trust in the file.
class GenericCloud : public mrpt::maps::CGenericPointsMap {
 public:
    std::vector<std::string> fields_refused;

    void setFields(const PointTable& table) {
        for (const PointField& field : table.fields) {
            const auto set = [&](auto& values_of_names) {
                using Values = decltype(values_of_names.begin()->second);
                const std::vector<double> values = columnOf(table, field);
                values_of_names[field.name] = Values(values.begin(), values.end());
            };
            const NumberType type = writtenType(field.type);
            if (type == NumberType::Float32) set(m_float_fields);
            if (type == NumberType::Float64) set(m_double_fields);
            if (type == NumberType::UInt16) set(m_uint16_fields);
            if (type == NumberType::UInt8) set(m_uint8_fields);
#if MRPT_VERSION >= 0x030000
            if (type == NumberType::UInt32) set(m_uint32_fields);
#endif
        }
    }

 private:
    void serializeFrom(CArchive& in, std::uint8_t version) override;
};
#endif

/// Copies the colour of the first point to renderOptions, from which colour fields are written.
void takeColor(const PointTable& fields, CPointsMap& cloud) {
    std::array<float, 3> color{};
    for (std::size_t i = 0; i < color.size(); ++i) {
        const PointField* const field = findField(fields, {kColorFields[i]});
        if (field == nullptr || cloud.empty()) return;
        color[i] = static_cast<float>(columnOf(fields, *field)[0]) / 255.0f;
    }
    cloud.renderOptions.color = {color[0], color[1], color[2]};
}

void GenericCloud::serializeFrom(CArchive& in, std::uint8_t version) {
    if (version > 4) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
    GenericContent content(in, version);
    clear();
    content.coordinates.copyTo(*this);
    setFields(content.fields);
    fields_refused = std::move(content.fields_refused);
    readInsertionOptions(in, insertionOptions);
    likelihoodOptions.readFromStream(in);
    takeColor(content.fields, *this);
}

}  // namespace

void registerNewerClouds() {
#if MRPT_VERSION < 0x020f00
    registerAs<SimpleCloud, CSimplePointsMap>("mrpt::maps::CSimplePointsMap");
#endif
    registerAs<GenericCloud, CPointsMap>(kGenericName);
}

std::optional<PointTable> otherFieldsOf(const CPointsMap& cloud) {
#if MRPT_VERSION < 0x020f00
    const auto* const generic = dynamic_cast<const GenericCloud*>(&cloud);
    return generic == nullptr ? std::nullopt : std::optional<PointTable>(generic->fields);
#else
    const auto* const generic = dynamic_cast<const mrpt::maps::CGenericPointsMap*>(&cloud);
    if (generic == nullptr) return std::nullopt;
    PointTable fields;
    fields.points = cloud.size();
    const auto add = [&](NumberType type, const auto& values_of_names) {
        for (const auto& [name, values] : values_of_names) {
            if (values.size() != cloud.size()) continue;
            addColumn(name, type, {values.begin(), values.end()}, fields);
        }
    };
    add(NumberType::Float32, generic->float_fields());
    add(NumberType::Float64, generic->double_fields());
    add(NumberType::UInt16, generic->uint16_fields());
    add(NumberType::UInt8, generic->uint8_fields());
#if MRPT_VERSION >= 0x030000
    add(NumberType::UInt32, generic->uint32_fields());
#endif
    return fields;
#endif
}

std::vector<std::string> fieldsNotKept(const CPointsMap& cloud) {
    std::vector<std::string> names;
    if (const auto fields = otherFieldsOf(cloud)) {
        for (const PointField& field : fields->fields) {
            if (field.name != kIntensity) names.push_back(field.name);
        }
    }
    if (const auto* const generic = dynamic_cast<const GenericCloud*>(&cloud)) {
        names.insert(names.end(), generic->fields_refused.begin(), generic->fields_refused.end());
    }
    return names;
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
    PointTable fields;
    fields.points = table.points;
    for (const PointField& field : table.fields) {
        if (field.name == "x" || field.name == "y" || field.name == "z") continue;
        const bool is_intensity = field.name == kIntensity;
        for (std::size_t element = 0; element < field.count; ++element) {
            std::string name = field.name;
            if (field.count > 1) name += "_" + std::to_string(element);
            while (findExactly(fields, name) != nullptr) name += "_";
            addColumn(name, is_intensity ? NumberType::Float32 : writtenType(field.type),
                      columnOf(table, field, element), fields);
        }
    }
    const PointField* const intensity = findField(table, {kIntensity});
    if (intensity != nullptr && findExactly(fields, kIntensity) == nullptr) {
        addColumn(kIntensity, NumberType::Float32, columnOf(table, *intensity), fields);
    }
    const auto cloud = std::make_shared<GenericCloud>();
    cloud->setSize(table.points);
    for (std::size_t i = 0; i < table.points; ++i) {
        cloud->setPointFast(i, static_cast<float>(x_m[i]), static_cast<float>(y_m[i]),
                            static_cast<float>(z_m[i]));
    }
    cloud->setFields(fields);
    takeColor(fields, *cloud);
    writeAsGeneric(*cloud);
    cloud->mark_as_modified();
    return cloud;
}

void writeAsGeneric([[maybe_unused]] CPointsMap& cloud) {
#if MRPT_VERSION < 0x020f00
    auto* const generic = dynamic_cast<GenericCloud*>(&cloud);
    if (generic != nullptr) generic->is_written_as_generic = true;
#endif
}

}  // namespace hagen::observations
