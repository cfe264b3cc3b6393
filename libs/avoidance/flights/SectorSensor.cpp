#include "avoidance/flights/SectorSensor.h"
#include <hagen/scan/Angle.h>
#include "scan/AppendReturn.h"

#include <algorithm>
#include <map>

#include "avoidance/flights/TurnTransforms.h"

namespace hagen::avoidance {
namespace {

constexpr int kFiringsPerPacket = 24;
constexpr double kRounding_s = 1e-9;

Eigen::Isometry3d isometryOf(const simulation::SensorPose& pose) {
    Eigen::Isometry3d isometry = Eigen::Isometry3d::Identity();
    isometry.linear() = pose.attitude.toRotationMatrix();
    isometry.translation() = pose.position_m;
    return isometry;
}

}  // namespace

SectorSensor::SectorSensor(const Course& course, Air air, float zone_m)
    : sensor_(course, air, zone_m),
      pattern_(simulation::firingPattern(sensor_.sensor())),
      segmenter_(sensor_.sensor(), sensor_.options(), [this](const live::LabelledSector& sector) {
          labelled_.push_back({sector.returns, sector.label, *sector.sweep, sector.last_time_s});
      }) {}

simulation::FiringRange SectorSensor::firingsOf(int packet) const {
    const int first = kFiringsPerPacket * packet;
    return {first, std::min(first + kFiringsPerPacket, pattern_.firings_per_revolution)};
}

/// A turn is complete after kTurn_s, as for whole scans.
double SectorSensor::endOf_s(int turn, int packet) const {
    const double since_start_s = 1e-6 * pattern_.firing_period_us * firingsOf(packet).end;
    return TrialSensor::kTurn_s * turn + std::min(TrialSensor::kTurn_s, since_start_s);
}

std::vector<observations::MappedScan> SectorSensor::measureUntil(double time_s,
                                                                 const FlightTrace& trace,
                                                                 PoseBelief& belief) {
    const int packets =
        (pattern_.firings_per_revolution + kFiringsPerPacket - 1) / kFiringsPerPacket;
    while (endOf_s(turn_, packet_) <= time_s + kRounding_s) {
        const int first = packet_;
        while (packet_ < packets && endOf_s(turn_, packet_) <= time_s + kRounding_s) ++packet_;
        addPackets(turn_, first, packet_, trace, belief);
        if (packet_ == packets) {
            packet_ = 0;
            ++turn_;
        }
    }
    std::vector<observations::MappedScan> sectors;
    for (const Labelled& sector : labelled_) sectors.push_back(place(sector, trace, belief));
    labelled_.clear();
    return sectors;
}

/// Measures and labels packets [first, end) of a turn.
void SectorSensor::addPackets(int turn, int first, int end, const FlightTrace& trace,
                              PoseBelief& belief) {
    const simulation::SimulatedScan all =
        sensor_.measureFirings(turn, {firingsOf(first).first, firingsOf(end - 1).end}, trace);
    const double turn_s = TrialSensor::kTurn_s * turn, firing_s = 1e-6 * pattern_.firing_period_us;
    const double first_rad = kTurn_rad * turn + radians(simulation::kFirstAzimuth_deg);
    std::size_t i = 0;
    Scan returns;
    for (int packet = first; packet < end; ++packet) {
        const simulation::FiringRange firings = firingsOf(packet);
        returns.clear();
        returns.beams = all.scan.beams;
        for (; i < all.size() && all.firing[i] < firings.end; ++i) {
            appendReturn(all.scan, i, returns);
            measured_.push_back({turn, all.scan.time_s[i]});
        }
        const double middle_s = turn_s + 0.5 * firing_s * (firings.first + firings.end);
        const simulation::SensorPose pose = belief.at(trace, middle_s);
        segmenter_.setAttitude(tiltOf(pose.attitude));
        segmenter_.setPose(isometryOf(pose));
        const double step_rad = radians(pattern_.azimuthStep_deg());
        const double to_rad = std::min(kTurn_rad, step_rad * firings.end);
        segmenter_.add(returns, {first_rad + step_rad * firings.first, first_rad + to_rad},
                       endOf_s(turn, packet));
    }
}

observations::MappedScan SectorSensor::place(const Labelled& sector, const FlightTrace& trace,
                                             PoseBelief& belief) {
    observations::MappedScan placed;
    placed.time_s = sector.end_s;
    placed.turns = (sector.sweep.to_rad - sector.sweep.from_rad) / kTurn_rad;
    const double lasted_s = placed.turns * TrialSensor::kTurn_s;
    placed.origin_m = belief.at(trace, sector.end_s - 0.5 * lasted_s).position_m.cast<float>();
    std::map<int, TurnTransforms> transforms;  // a sector may begin in the previous turn
    for (std::size_t i = 0; i < sector.returns.size(); ++i) {
        const Measured measured = measured_.front();
        measured_.pop_front();
        if (sector.label[i] == Label::Unclassified) continue;
        const double start_s = TrialSensor::kTurn_s * measured.turn;
        const TurnTransforms& turn =
            transforms.try_emplace(measured.turn, start_s, trace, belief).first->second;
        const Scan& returns = sector.returns;
        placed.points_m.push_back(
            turn.place({returns.x_m[i], returns.y_m[i], returns.z_m[i]}, measured.since_start_s));
        placed.labels.push_back(sector.label[i]);
        placed.age_s.push_back(static_cast<float>(sector.end_s - start_s -
                                                  static_cast<double>(measured.since_start_s)));
    }
    return placed;
}

observations::MappedScan joined(const std::vector<observations::MappedScan>& sectors) {
    observations::MappedScan all;
    all.time_s = sectors.back().time_s;
    all.turns = 0;
    for (const observations::MappedScan& sector : sectors) {
        all.turns += sector.turns;
        all.origin_m += static_cast<float>(sector.turns) * sector.origin_m;
        all.points_m.insert(all.points_m.end(), sector.points_m.begin(), sector.points_m.end());
        all.labels.insert(all.labels.end(), sector.labels.begin(), sector.labels.end());
        const auto later_s = static_cast<float>(all.time_s - sector.time_s);
        for (const float age_s : sector.age_s) all.age_s.push_back(age_s + later_s);
    }
    all.origin_m /= static_cast<float>(all.turns);
    return all;
}

}  // namespace hagen::avoidance
