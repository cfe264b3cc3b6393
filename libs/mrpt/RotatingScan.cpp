#include <hagen/mrpt/RotatingScan.h>
#include <hagen/scan/Angle.h>
#include <hagen/scan/MostReturns.h>
#include <hagen/sensors/VelodyneCalibration.h>
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/serialization/stl_serialization.h>
#include <mrpt/version.h>

#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <optional>

#include "mrpt/ArchiveParts.h"

namespace hagen::observations {
namespace {

using mrpt::obs::CObservationRotatingScan;
using mrpt::serialization::CArchive;

/// A scan with the points that newer MRPTs store. It is written as the older class.
class NewerRotatingScan : public CObservationRotatingScan {
 public:
    OrganizedPoints points;

 private:
    void serializeFrom(CArchive& in, std::uint8_t version) override;
};

template <class Matrix>
void readMatrix(CArchive& in, std::uint16_t rows, std::uint16_t columns, Matrix& matrix) {
    std::vector<typename Matrix::Scalar> numbers;
    readNumbers(in, std::size_t{rows} * columns, numbers);
    matrix.resize(rows, columns);
    for (int r = 0; r < rows; ++r) {
        for (int c = 0; c < columns; ++c) {
            matrix(r, c) = numbers[static_cast<std::size_t>(r) * columns + c];
        }
    }
}

template <class Matrix>
void readMatrix(CArchive& in, Matrix& matrix) {
    const auto columns = in.ReadAs<std::uint16_t>();
    const auto rows = in.ReadAs<std::uint16_t>();
    readMatrix(in, rows, columns, matrix);
}

std::uint16_t number(std::uint8_t low, std::uint8_t high) {
    return static_cast<std::uint16_t>(low | high << 8);
}

void NewerRotatingScan::serializeFrom(CArchive& in, std::uint8_t version) {
    if (version != 0) MRPT_THROW_UNKNOWN_SERIALIZATION_VERSION(version);
    points = {};
    in >> timestamp;
    sensorLabel = readText(in);
    in >> rowCount >> columnCount >> rangeResolution >> startAzimuth >> azimuthSpan >>
        sweepDuration;
    lidarModel = readText(in);
    in >> minRange >> maxRange >> sensorPose >> originalReceivedTimestamp >>
        has_satellite_timestamp;

    // In the older layout, columns and rows follow. In the newer layout, the storage type follows:
    // 0 (in the log), then columns and rows; 1 or 2 (in a file), then the file name length.
    std::array<std::uint8_t, 4> next{};
    in.ReadBuffer(next.data(), next.size());
    const std::uint16_t older_columns = number(next[0], next[1]);
    const std::uint16_t older_rows = number(next[2], next[3]);
    const bool has_no_pixels = older_columns == 0 && older_rows == 0;
    const bool is_older =
        has_no_pixels ? MRPT_VERSION < 0x020b04
                      : (older_columns == columnCount && older_rows == rowCount) || next[0] > 2;
    if (is_older) {
        readMatrix(in, older_rows, older_columns, rangeImage);
    } else if (next[0] == 0) {
        const auto rows = number(next[3], in.ReadAs<std::uint8_t>());
        readMatrix(in, rows, number(next[1], next[2]), rangeImage);
    } else {
        const std::size_t letters = number(next[1], next[2]) + (std::size_t{next[3]} << 16) +
                                    (std::size_t{in.ReadAs<std::uint8_t>()} << 24);
        std::string file;
        readNumbers(in, letters, file);
        throw std::runtime_error(
            "the scan is stored outside the log, in the file '" + file +
            "'; include it with 'rawlog-edit --de-externalize' of the MRPT version that wrote it");
    }
    readMatrix(in, intensityImage);
    rangeOtherLayers.clear();
    for (auto layers = in.ReadAs<std::uint16_t>(); layers > 0; --layers) {
        const std::string name = readText(in);
        readMatrix(in, static_cast<std::uint16_t>(rangeImage.rows()),
                   static_cast<std::uint16_t>(rangeImage.cols()), rangeOtherLayers[name]);
    }
    if (is_older) return;
    const auto columns = in.ReadAs<std::uint16_t>();
    const auto rows = in.ReadAs<std::uint16_t>();
    std::vector<float> coordinates;
    readNumbers(in, std::size_t{3} * rows * columns, coordinates);
    points.rows = rows;
    points.columns = columns;
    for (std::size_t i = 0; i < coordinates.size(); i += 3) {
        points.x_m.push_back(coordinates[i]);
        points.y_m.push_back(coordinates[i + 1]);
        points.z_m.push_back(coordinates[i + 2]);
    }
}

int rowsOf(const CObservationRotatingScan& scan) {
    return static_cast<int>(scan.rangeImage.rows());
}
int columnsOf(const CObservationRotatingScan& scan) {
    return static_cast<int>(scan.rangeImage.cols());
}

std::string sizeText(std::ptrdiff_t rows, std::ptrdiff_t columns) {
    return std::to_string(rows) + " x " + std::to_string(columns);
}

/// Throws unless all non-empty images of a scan have the same size.
void checkSizes(const CObservationRotatingScan& scan, const OrganizedPoints* points) {
    const int rows = rowsOf(scan), columns = columnsOf(scan);
    if (rows == 0 || columns == 0) throw std::runtime_error("no range image");
    checkReturns(std::size_t(rows) * std::size_t(columns));
    const auto check = [&](const std::string& what, std::ptrdiff_t its_rows,
                           std::ptrdiff_t its_columns) {
        if (its_rows == rows && its_columns == columns) return;
        throw std::runtime_error(what + " has " + sizeText(its_rows, its_columns) +
                                 " pixels, but the range image has " + sizeText(rows, columns));
    };
    if (scan.intensityImage.size() > 0) {
        check("the intensity image", scan.intensityImage.rows(), scan.intensityImage.cols());
    }
    for (const auto& [name, layer] : scan.rangeOtherLayers) {
        check("the layer '" + name + "'", layer.rows(), layer.cols());
    }
    if (points != nullptr) check("the point image", points->rows, points->columns);
}

double resolutionOf(const CObservationRotatingScan& scan) {
    const double resolution_m = scan.rangeResolution;
    if (resolution_m > 0 && std::isfinite(resolution_m)) return resolution_m;
    throw std::runtime_error("invalid range resolution: " + std::to_string(resolution_m) + " m");
}

float intensityAt(const CObservationRotatingScan& scan, int row, int column) {
    if (scan.intensityImage.size() == 0) return 0.0f;
    return static_cast<float>(scan.intensityImage(row, column)) / 255.0f;
}

bool hasDuration(const CObservationRotatingScan& scan) {
    constexpr double kMaxTurn_s = 2.0;
    return scan.sweepDuration > 0 && scan.sweepDuration <= kMaxTurn_s;
}

struct Point {
    double x_m, y_m, z_m;
};

void add(const Point& point, float intensity, int row, Scan& scan, RotatingReturns& returns) {
    scan.x_m.push_back(static_cast<float>(point.x_m));
    scan.y_m.push_back(static_cast<float>(point.y_m));
    scan.z_m.push_back(static_cast<float>(point.z_m));
    scan.intensity.push_back(intensity);
    returns.image_row.push_back(row);
}

/// The letters and digits of a sensor's name, in upper case and without a final E.
std::string plainName(const std::string& name) {
    std::string plain;
    for (const char c : name) {
        const auto letter = static_cast<unsigned char>(c);
        if (std::isalnum(letter) != 0) plain += static_cast<char>(std::toupper(letter));
    }
    if (!plain.empty() && plain.back() == 'E') plain.pop_back();
    return plain;
}

/// The named sensor if it is known and has rings.
std::optional<SensorModel> namedSensor(const std::string& lidar_model) {
    for (const std::string& name : knownSensorModels()) {
        if (plainName(name) != plainName(lidar_model)) continue;
        SensorModel sensor = sensorModel(name);
        if (sensor.has_rings) return sensor;
    }
    return std::nullopt;
}

SensorModel sensorOfRows(const CObservationRotatingScan& observation, const Settings& settings) {
    const int rows = rowsOf(observation);
    const auto own = namedSensor(observation.lidarModel);
    const std::optional<std::string>& wanted = settings.sensor.model;
    if (own && own->rows() == rows && wanted != "custom") return *own;
    const std::string what = "the " + std::to_string(rows) +
                             " rows have no elevations (lidarModel '" + observation.lidarModel +
                             "', and no points)";
    const std::string todo =
        "; name a sensor with these rows in a settings file: -c FILE.yaml with 'sensor: {model: "
        "custom, elevations_deg: [...]}', the beam of row 0 first";
    if (!wanted) throw std::runtime_error(what + todo);
    SensorModel sensor = settings.sensorModel();
    if (sensor.rows() != rows || !sensor.has_rings) {
        throw std::runtime_error(what + ", and the settings' sensor.model " + *wanted + " has " +
                                 std::to_string(sensor.rows()) +
                                 (sensor.has_rings ? "" : " virtual rows") + todo);
    }
    return sensor;
}

/// The direction of an image row, and its beam.
struct Row {
    double sine, cosine;  ///< of the row's elevation
    std::uint8_t beam;
    double delay = 0;        ///< delay of the laser, in columns
    double azimuth_rad = 0;  ///< azimuth of the laser, added to the column's azimuth
};

/// The directions of the pixels of an image without points.
struct Geometry {
    std::vector<Row> rows;
    int columns = 0;             ///< number of used columns
    double first_rad = 0;        ///< azimuth of the first column, counter-clockwise
    double step_rad = 0;         ///< angle to the next column
    double columns_of_turn = 0;  ///< number of columns in a full turn
    double resolution_m = 0;
    bool is_dual_by_blocks = false;  ///< two columns have the same azimuth
};

/// The number of used columns of an image made by fromVelodyne(), one per firing; nullopt for other
/// images. The image has one column per packet block and return; those after the firings are empty.
std::optional<int> columnsFromVelodyne(const CObservationRotatingScan& scan) {
    const int rows = rowsOf(scan), columns = columnsOf(scan);
    if (columns % (12 * 32) != 0 || (rows != 16 && rows != 32 && rows != 64)) return std::nullopt;
    const int used = columns / rows;
    for (int r = 0; r < rows; ++r) {
        for (int c = used; c < columns; ++c) {
            if (scan.rangeImage(r, c) != 0) return std::nullopt;
        }
    }
    return used;
}

/// The Velodyne model named by the scan or otherwise by the settings; null if unknown.
const sensors::VelodyneModel* velodyneOf(const CObservationRotatingScan& scan,
                                         const Settings& settings) {
    for (const std::string& name : {scan.lidarModel, settings.sensor.model.value_or("")}) {
        try {
            const sensors::VelodyneModel& model = sensors::velodyneModel(name);
            if (model.lasers == rowsOf(scan)) return &model;
        } catch (const std::invalid_argument&) {
        }
    }
    return nullptr;
}

Geometry geometryOfVelodyne(const CObservationRotatingScan& scan,
                            const sensors::VelodyneModel& model, int columns) {
    const bool is_dual = !scan.rangeOtherLayers.empty();
    Geometry geometry;
    geometry.columns = columns;
    geometry.is_dual_by_blocks = is_dual && model.firings_per_block == 2;
    geometry.columns_of_turn = is_dual ? 0.5 * columns : columns;
    geometry.first_rad = radians(-sensors::azimuthOfReadingDeg(100.0 * degrees(scan.startAzimuth)));
    geometry.step_rad = -scan.azimuthSpan / geometry.columns_of_turn;
    geometry.resolution_m = static_cast<double>(model.distance_unit_m);  // MRPT always writes 2 mm
    const auto& calibration = sensors::defaultCalibration(model);
    for (int laser = 0; laser < model.lasers; ++laser) {
        const auto& correction = calibration.lasers[laser];
        Row row{correction.elevation_sine, correction.elevation_cosine,
                sensors::rowOfLaser(calibration, laser)};
        row.delay = model.delayUs(laser) / model.firing_period_us;
        row.azimuth_rad = radians(correction.azimuth_deg);  // subtracted, because it is clockwise
        geometry.rows.push_back(row);
    }
    return geometry;
}

Geometry geometryOf(const CObservationRotatingScan& scan, const SensorModel& sensor) {
    Geometry geometry;
    geometry.columns = columnsOf(scan);
    geometry.columns_of_turn = std::max(geometry.columns - 1, 1);
    geometry.first_rad = scan.startAzimuth;
    geometry.step_rad = scan.azimuthSpan / geometry.columns_of_turn;
    geometry.resolution_m = resolutionOf(scan);
    const bool is_highest_first = sensor.name.rfind("OS", 0) == 0;
    for (int r = 0; r < sensor.rows(); ++r) {
        const int beam = is_highest_first ? sensor.rows() - 1 - r : r;
        const auto elevation_rad = static_cast<double>(sensor.elevations_rad[beam]);
        geometry.rows.push_back(
            {std::sin(elevation_rad), std::cos(elevation_rad), static_cast<std::uint8_t>(beam)});
    }
    return geometry;
}

void readPixels(const CObservationRotatingScan& observation, const Geometry& geometry, Scan& scan,
                std::vector<std::uint8_t>& beams, RotatingReturns& returns) {
    const bool has_duration = hasDuration(observation);
    for (int c = 0; c < geometry.columns; ++c) {
        const int firing = geometry.is_dual_by_blocks ? c / 2 * 2 : c;
        for (int r = 0; r < rowsOf(observation); ++r) {
            const Row& row = geometry.rows[r];
            const double place = firing + row.delay;
            const double azimuth_rad =
                geometry.first_rad + place * geometry.step_rad + row.azimuth_rad;
            const auto addRange = [&](std::uint16_t range) {
                if (range == 0) return;
                const double range_m = range * geometry.resolution_m;
                const double level_m = range_m * row.cosine;
                add({level_m * std::cos(azimuth_rad), level_m * std::sin(azimuth_rad),
                     range_m * row.sine},
                    intensityAt(observation, r, c), r, scan, returns);
                beams.push_back(row.beam);
                if (has_duration) {
                    scan.time_s.push_back(static_cast<float>(place / geometry.columns_of_turn *
                                                             observation.sweepDuration));
                }
            };
            addRange(observation.rangeImage(r, c));
            for (const auto& [name, layer] : observation.rangeOtherLayers) addRange(layer(r, c));
        }
    }
}

}  // namespace

void registerNewerScans() {
    registerAs<NewerRotatingScan, CObservationRotatingScan>("mrpt::obs::CObservationRotatingScan");
}

const CObservationRotatingScan* rotatingScanOf(const mrpt::obs::CObservation& observation) {
    const auto* scan = dynamic_cast<const CObservationRotatingScan*>(&observation);
    return scan == nullptr || scan->rowCount == 1 ? nullptr : scan;
}

const OrganizedPoints* organizedPointsOf(const CObservationRotatingScan& observation) {
    const auto* newer = dynamic_cast<const NewerRotatingScan*>(&observation);
    return newer == nullptr || newer->points.x_m.empty() ? nullptr : &newer->points;
}

void readOrganizedPoints(const CObservationRotatingScan& observation, Scan& scan,
                         RotatingReturns& returns) {
    const OrganizedPoints& points = *organizedPointsOf(observation);
    checkSizes(observation, &points);
    scan.clear();
    returns.image_row.clear();
    std::size_t without_point = 0;
    const bool has_duration = hasDuration(observation);
    for (int c = 0; c < points.columns; ++c) {
        const auto time_s =
            static_cast<float>(observation.sweepDuration * c / std::max(points.columns - 1, 1));
        for (int r = 0; r < points.rows; ++r) {
            const std::size_t at = static_cast<std::size_t>(r) * points.columns + c;
            const auto x_m = static_cast<double>(points.x_m[at]);
            const auto y_m = static_cast<double>(points.y_m[at]);
            const auto z_m = static_cast<double>(points.z_m[at]);
            const double range_m = std::sqrt(x_m * x_m + y_m * y_m + z_m * z_m);
            const bool has_point = range_m > 0 && std::isfinite(range_m);
            const auto addPoint = [&](double scale) {
                add({scale * x_m, scale * y_m, scale * z_m}, intensityAt(observation, r, c), r,
                    scan, returns);
                if (has_duration) scan.time_s.push_back(time_s);
            };
            if (has_point)
                addPoint(1.0);
            else
                without_point += observation.rangeImage(r, c) != 0;
            for (const auto& [name, layer] : observation.rangeOtherLayers) {
                if (layer(r, c) == 0) continue;
                if (has_point)
                    addPoint(layer(r, c) * resolutionOf(observation) / range_m);
                else
                    ++without_point;
            }
        }
    }
    returns.remark = "output rawlogs contain the ranges of this scan, not the points";
    if (without_point > 0) {
        returns.remark += "; ranges without a point (dropped): " + std::to_string(without_point);
    }
}

void readRangeImage(const CObservationRotatingScan& observation, const Settings& settings,
                    Scan& scan, SensorModel& sensor, RotatingReturns& returns) {
    checkSizes(observation, nullptr);
    if (!std::isfinite(observation.startAzimuth) || !std::isfinite(observation.azimuthSpan)) {
        throw std::runtime_error("the azimuths are not finite");
    }
    scan.clear();
    returns.image_row.clear();
    returns.remark.clear();
    Geometry geometry;
    const std::optional<int> used = columnsFromVelodyne(observation);
    const sensors::VelodyneModel* const model = used ? velodyneOf(observation, settings) : nullptr;
    if (model != nullptr) {
        geometry = geometryOfVelodyne(observation, *model, *used);
        sensor = sensorOf(sensors::defaultCalibration(*model), model->name);
        returns.remark =
            "MRPT converted this scan from Velodyne packets and kept only half of the returns; "
            "use the log with the packets if available";
    } else {
        sensor = sensorOfRows(observation, settings);
        geometry = geometryOf(observation, sensor);
    }
    takeLimits(observation, sensor);
    std::vector<std::uint8_t> beams;
    readPixels(observation, geometry, scan, beams, returns);
    locateBeams(sensor, scan);
    scan.row = beams;  // replaces the rows of locateBeams(), which are estimates
}

void takeLimits(const CObservationRotatingScan& observation, SensorModel& sensor) {
    const bool are_valid = observation.minRange >= 0 &&
                           observation.maxRange > observation.minRange &&
                           std::isfinite(observation.maxRange);
    if (!are_valid) return;
    sensor.min_range_m = static_cast<float>(observation.minRange);
    sensor.max_range_m = static_cast<float>(observation.maxRange);
}

}  // namespace hagen::observations
