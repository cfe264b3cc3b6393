#include <hagen/scan/Angle.h>
#include <hagen/scan/MostReturns.h>
#include <hagen/sensors/VelodyneDecoder.h>
#include <hagen/sensors/VelodyneModel.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>

#include "sensors/LittleEndian.h"
#include "sensors/velodyne/VelodyneReturns.h"

namespace hagen::sensors {
namespace {

constexpr int kTurn = kReadingsOfTurn;   // 0.01 degrees
constexpr double kMaxAzimuth_deg = 1e6;  // larger angles make the remainder inexact

class Packet {
 public:
    explicit Packet(const std::uint8_t* bytes) : bytes_(bytes) {}

    /// Bank of a block; -1 if the block is invalid.
    int bank(int block) const { return azimuth(block) < kTurn ? bankOf(bytes_, block) : -1; }
    bool isValid(int block) const { return bank(block) == 0; }
    int azimuth(int block) const { return little<std::uint16_t>(at(block) + 2); }
    const std::uint8_t* returns(int block) const { return at(block) + kVelodyneHeaderBytes; }
    std::uint32_t time_us() const { return little<std::uint32_t>(bytes_ + kVelodyneTimeAt); }
    bool isDual() const { return !isOfHdl64(bytes_) && bytes_[kVelodyneModeAt] == kDualReturn; }
    std::uint8_t modelId() const { return bytes_[kVelodyneModelAt]; }

 private:
    const std::uint8_t* at(int block) const { return bytes_ + block * kVelodyneBlockBytes; }

    const std::uint8_t* bytes_;
};

struct SineCosine {
    double sine, cosine;

    explicit SineCosine(double angle_rad)
        : sine(std::sin(angle_rad)), cosine(std::cos(angle_rad)) {}
};

/// Directions of all azimuth readings, from tables of whole and hundredths of degrees that fit into
/// the L1 cache.
class ReadingDirections {
 public:
    ReadingDirections() {
        for (int i = 0; i < 360; ++i) degrees_.emplace_back(100 * i * kRadiansPerReading - kPi);
        for (int i = 0; i < 100; ++i) hundredths_.emplace_back(i * kRadiansPerReading);
    }

    void setDirection(int reading, VelodyneBlock& block) const {
        const int from_behind = reading < kTurn / 2 ? reading + kTurn / 2 : reading - kTurn / 2;
        const SineCosine& a = degrees_[from_behind / 100];
        const SineCosine& b = hundredths_[from_behind % 100];
        block.sine = static_cast<float>(a.sine * b.cosine + a.cosine * b.sine);
        block.cosine = static_cast<float>(a.cosine * b.cosine - a.sine * b.sine);
        block.azimuth_rad = static_cast<float>(kPi - from_behind * kRadiansPerReading);
        block.reading_from_behind = static_cast<float>(from_behind);
    }

 private:
    std::vector<SineCosine> degrees_, hundredths_;
};

std::string hex(unsigned value) {
    char text[8];
    std::snprintf(text, sizeof text, "0x%02x", value);
    return text;
}

bool areOfHdl64(const VelodynePackets& packets) { return isOfHdl64(packets.at(0)); }

/// Returns the calibration of a scan. Throws std::runtime_error if a laser has no direction or
/// implausible offsets.
const VelodyneCalibration& checked(const VelodyneCalibration& calibration) {
    const auto& lasers = calibration.lasers;
    for (std::size_t i = 0; i < lasers.size(); ++i) {
        const auto& laser = lasers[i];
        const double length = std::hypot(laser.elevation_sine, laser.elevation_cosine);
        const auto isOffset = [](double offset_m) {
            return std::abs(offset_m) <= kMaxCorrection_m;
        };
        if (std::abs(length - 1) < 0.01 && std::abs(laser.azimuth_deg) <= kMaxAzimuth_deg &&
            isOffset(laser.distance_m) && isOffset(laser.vertical_offset_m) &&
            isOffset(laser.horizontal_offset_m)) {
            continue;
        }
        throw std::runtime_error("the scan's own calibration is corrupt: laser " +
                                 std::to_string(i) +
                                 " has an invalid direction, or offsets beyond " +
                                 std::to_string(std::lround(kMaxCorrection_m)) + " m");
    }
    return calibration;
}

const VelodyneCalibration& checkedOfHdl64(const VelodyneCalibration& calibration) {
    const auto lasers = static_cast<std::size_t>(hdl64Model().lasers);
    if (calibration.lasers.size() == lasers) return checked(calibration);
    throw std::runtime_error(
        "HDL-64E packets require a calibration with 64 lasers, which the "
        "scan lacks");
}

const VelodyneModel& modelOf(const VelodynePackets& packets, std::size_t packet) {
    const std::uint8_t id = Packet(packets.at(packet)).modelId();
    const VelodyneModel* model = findVelodyneModel(id);
    if (model == nullptr) {
        throw std::runtime_error("packet " + std::to_string(packet) + ": unknown model id " +
                                 hex(id) + "; known:" + knownVelodynes());
    }
    if (id != Packet(packets.at(0)).modelId()) {
        throw std::runtime_error("packet " + std::to_string(packet) + ": model id " + hex(id) +
                                 " differs from that of the first packet");
    }
    return *model;
}

const VelodyneCalibration& calibrationOf(const VelodyneModel& model,
                                         const VelodyneCalibration& own) {
    const bool has_own = own.lasers.size() == static_cast<std::size_t>(model.lasers);
    return has_own ? checked(own) : defaultCalibration(model);
}

/// Returns the rotation between the blocks of consecutive firings, in 0.01 degrees: the median over
/// the scan, which ignores rounding and broken blocks. Never negative, although readings of a
/// nearly stationary motor may decrease.
int turnOfBlocks(const VelodynePackets& packets, const VelodyneModel& model,
                 std::vector<int>& turns, int turn_between_packets) {
    turns.clear();
    const auto compare = [&](const Packet& from, int a, const Packet& to, int b) {
        if (!from.isValid(a) || !to.isValid(b)) return;
        int turn = to.azimuth(b) - from.azimuth(a);
        if (turn <= -kTurn / 2) turn += kTurn;
        if (turn > kTurn / 2) turn -= kTurn;
        turns.push_back(turn);
    };
    for (std::size_t p = 0; p < packets.count; ++p) {
        const Packet packet(packets.at(p));
        const bool is_dual = packet.isDual();
        const int step = model.blocksAtOnce(is_dual), used = model.usedBlocks(is_dual);
        for (int b = 0; b + step < used; ++b) compare(packet, b, packet, b + step);
        if (p == 0 || step < used) continue;
        const Packet before(packets.at(p - 1));
        const double elapsed_us = elapsedUs(before.time_us(), packet.time_us());
        if (std::abs(elapsed_us / model.packetPeriodUs(is_dual) - 1) < 0.5) {
            compare(before, 0, packet, 0);
        }
    }
    if (turns.empty()) return turn_between_packets;
    const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
    std::nth_element(turns.begin(), middle, turns.end());
    return std::max(*middle, 0);
}

/// Sets the offsets of a laser. `turn_reading`: rotation since the block's first firing, in 0.01
/// degrees.
void setLaser(const VelodyneCalibration& calibration, std::size_t laser, double turn_reading,
              std::size_t i, BlockOffsets& places) {
    const VelodyneLaser& correction = calibration.lasers[laser];
    turn_reading = std::remainder(turn_reading - 100.0 * correction.azimuth_deg, kTurn);
    const SineCosine turn(turn_reading * kRadiansPerReading);
    places.turn_sine[i] = static_cast<float>(turn.sine);
    places.turn_cosine[i] = static_cast<float>(turn.cosine);
    places.turn_rad[i] = static_cast<float>(turn_reading * kRadiansPerReading);
    places.turn_reading[i] = static_cast<float>(turn_reading);
    places.elevation_sine[i] = static_cast<float>(correction.elevation_sine);
    places.elevation_cosine[i] = static_cast<float>(correction.elevation_cosine);
    places.distance_m[i] = static_cast<float>(correction.distance_m);
    places.sideways_m[i] = static_cast<float>(correction.horizontal_offset_m);
    places.row[i] = rowOfLaser(calibration, laser);
}

void setTurnLimits(BlockOffsets& places) {
    const auto [min, max] =
        std::minmax_element(std::begin(places.turn_reading), std::end(places.turn_reading));
    places.min_turn_reading = *min;
    places.max_turn_reading = *max;
}

BlockOffsets blockOffsetsOf(const VelodyneCalibration& calibration, const VelodyneModel& model,
                            int turn_of_blocks, int bank) {
    constexpr int kReturns = static_cast<int>(kReturnsOfBlock);
    BlockOffsets places;
    places.distance_unit_m = model.distance_unit_m;
    for (int i = 0; i < kReturns; ++i) {
        const int laser = (bank * kReturns + i) % model.lasers;
        const double turn_in_block = model.turnWithinBlock(i / model.lasers, laser);
        setLaser(calibration, laser, turn_of_blocks * turn_in_block, i, places);
        places.time_s[i] = static_cast<float>(1e-6 * turn_in_block * model.blockPeriodUs());
        places.up_m[i] = static_cast<float>(calibration.lasers[laser].vertical_offset_m);
        places.forward_m[i] = places.up_m[i] * places.elevation_sine[i];
    }
    setTurnLimits(places);
    return places;
}

/// Offsets of a bank of an HDL-64E. Treats its lasers as simultaneous.
BlockOffsets hdl64Offsets(const VelodyneCalibration& calibration, int bank) {
    BlockOffsets places{};
    places.distance_unit_m = hdl64Model().distance_unit_m;
    for (std::size_t i = 0; i < kReturnsOfBlock; ++i) {
        const std::size_t laser = i + bank * kReturnsOfBlock;
        setLaser(calibration, laser, 0, i, places);
        const VelodyneLaser& correction = calibration.lasers[laser];
        const double offset_m = correction.vertical_offset_m;
        places.up_m[i] = static_cast<float>(offset_m * correction.elevation_cosine);
        places.forward_m[i] = static_cast<float>(-offset_m * correction.elevation_sine);
    }
    setTurnLimits(places);
    return places;
}

/// Collects the valid blocks of a scan. Returns the number of invalid blocks.
std::size_t collectBlocks(const VelodynePackets& packets, const VelodyneModel& model,
                          std::vector<VelodyneBlock>& blocks) {
    static const ReadingDirections directions;
    const unsigned first_us = Packet(packets.at(0)).time_us();
    blocks.resize(packets.count * kVelodyneBlocks);
    VelodyneBlock* next = blocks.data();
    for (std::size_t p = 0; p < packets.count; ++p) {
        const Packet packet(packets.at(p));
        const double packet_us = elapsedUs(first_us, packet.time_us());
        const int at_once = model.blocksAtOnce(packet.isDual());
        for (int b = 0; b < kVelodyneBlocks; ++b) {
            if (!packet.isValid(b)) continue;
            const int firing = b / at_once;
            const double block_us = packet_us + firing * model.blockPeriodUs();
            VelodyneBlock& block = *next++;
            block.returns = packet.returns(b);
            block.time_s = static_cast<float>(1e-6 * block_us);
            directions.setDirection(packet.azimuth(b), block);
        }
    }
    blocks.resize(next - blocks.data());
    return packets.count * kVelodyneBlocks - blocks.size();
}

/// Like beamSpan() of the result of sensorOf(), but without allocations.
BeamSpan beamSpan(const VelodyneCalibration& calibration) {
    const auto isLower = [](const auto& a, const auto& b) {
        return a.elevation_sine < b.elevation_sine;
    };
    const auto& lasers = calibration.lasers;
    const auto [lowest, highest] = std::minmax_element(lasers.begin(), lasers.end(), isLower);
    const auto elevation = [](const auto& laser) {
        return static_cast<float>(std::atan2(laser.elevation_sine, laser.elevation_cosine));
    };
    return {static_cast<int>(lasers.size()), elevation(*lowest), elevation(*highest)};
}

void resize(std::size_t returns, Scan& scan) {
    for (auto* values : {&scan.x_m, &scan.y_m, &scan.z_m, &scan.intensity, &scan.range_m,
                         &scan.azimuth_rad, &scan.time_s}) {
        values->resize(returns);
    }
    scan.row.resize(returns);
}

ReturnArrays arraysFrom(std::size_t first, Scan& scan) {
    return {scan.x_m.data() + first,     scan.y_m.data() + first,
            scan.z_m.data() + first,     scan.intensity.data() + first,
            scan.range_m.data() + first, scan.azimuth_rad.data() + first,
            scan.time_s.data() + first,  scan.row.data() + first};
}

using BankOffsets = std::array<BlockOffsets, std::size(kBankHeaders)>;

/// Decodes packets of a model with several banks, block by block.
std::size_t decodeBanks(const VelodynePackets& packets, const VelodyneModel& model,
                        const VelodyneCalibration& calibration, const BankOffsets& places,
                        Scan& scan, DecoderWorkspace& work) {
    static const ReadingDirections directions;
    const unsigned first_us = Packet(packets.at(0)).time_us();
    std::size_t returns = 0, unsound_blocks = 0;
    resize(packets.count * kVelodyneBlocks * kReturnsOfBlock + kPaddingReturns, scan);
    work.blocks.resize(1);
    VelodyneBlock& block = work.blocks.front();
    for (std::size_t p = 0; p < packets.count; ++p) {
        const Packet packet(packets.at(p));
        const double packet_us = elapsedUs(first_us, packet.time_us());
        const bool is_dual = packet.isDual();
        for (int b = 0; b < model.usedBlocks(is_dual); ++b) {
            const int bank = packet.bank(b);
            if (bank < 0 || bank >= model.banks()) {
                ++unsound_blocks;
                continue;
            }
            block.returns = packet.returns(b);
            const int firing = b / model.blocksAtOnce(is_dual);
            block.time_s = static_cast<float>(1e-6 * (packet_us + firing * model.blockPeriodUs()));
            directions.setDirection(packet.azimuth(b), block);
            locateReturns(work.blocks, places[bank], arraysFrom(returns, scan));
            returns += countReturns(work.blocks);
        }
    }
    resize(returns, scan);
    scan.beams = beamSpan(calibration);
    return unsound_blocks;
}

}  // namespace

void beamsOf(const VelodynePackets& packets, const VelodyneCalibration& calibration,
             SensorModel& sensor) {
    if (packets.count == 0) throw std::runtime_error("the scan has no packets");
    if (areOfHdl64(packets)) {
        sensor.name = hdl64Model().name;
        beamsOf(checkedOfHdl64(calibration), sensor.elevations_rad);
    } else {
        const VelodyneModel& model = modelOf(packets, 0);
        sensor.name = model.name;
        beamsOf(calibrationOf(model, calibration), sensor.elevations_rad);
    }
}

// Blocks have the same firing pattern and differ only in their first direction. For each block,
// looks up this direction and rotates the pattern, one SIMD vector at a time (locateReturns).
std::size_t decodePackets(const VelodynePackets& packets, const VelodyneCalibration& own,
                          Scan& scan, DecoderWorkspace& work, int turn_between_packets) {
    if (packets.count == 0) {
        scan.clear();
        return 0;
    }
    checkReturns(packets.count * kVelodyneBlocks * kReturnsOfBlock);
    if (areOfHdl64(packets)) {
        const VelodyneCalibration& calibration = checkedOfHdl64(own);
        const BankOffsets banks{hdl64Offsets(calibration, 0), hdl64Offsets(calibration, 1)};
        return decodeBanks(packets, hdl64Model(), calibration, banks, scan, work);
    }
    const VelodyneModel& model = modelOf(packets, 0);
    for (std::size_t p = 1; p < packets.count; ++p) {
        modelOf(packets, p);  // throws if models differ
    }
    const VelodyneCalibration& calibration = calibrationOf(model, own);
    const int turn = turnOfBlocks(packets, model, work.turns, turn_between_packets);
    if (model.banks() > 1) {
        BankOffsets banks;
        for (int bank = 0; bank < model.banks(); ++bank) {
            banks[bank] = blockOffsetsOf(calibration, model, turn, bank);
        }
        return decodeBanks(packets, model, calibration, banks, scan, work);
    }
    std::vector<VelodyneBlock>& blocks = work.blocks;
    const std::size_t unsound_blocks = collectBlocks(packets, model, blocks);
    const BlockOffsets places = blockOffsetsOf(calibration, model, turn, 0);

    // Count returns first, because growing arrays would fill them with zeros.
    const std::size_t returns = countReturns(blocks);
    resize(returns + kPaddingReturns, scan);
    locateReturns(blocks, places, arraysFrom(0, scan));
    resize(returns, scan);
    scan.beams = beamSpan(calibration);
    return unsound_blocks;
}

}  // namespace hagen::sensors
