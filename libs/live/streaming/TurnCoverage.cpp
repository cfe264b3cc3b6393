#include <hagen/live/TurnCoverage.h>
#include <hagen/scan/Angle.h>

#include <algorithm>
#include <cmath>

namespace hagen::live {
namespace {

// 0.06 degrees: less than a firing interval (0.083 degrees for an HDL-32E at 5 Hz), but more than
// the gaps of 0.025 degrees that azimuth rounding causes between packets.
constexpr double kGap_rad = 0.001;
constexpr double kRounding_rad = 1e-5;  // rounding error of float matrices
// Covers gaps of up to 3 degrees between sectors if the vehicle yaws.
constexpr double kBeside_rad = 0.05;

}  // namespace

TurnCoverage::Arc TurnCoverage::between(double a_rad, double b_rad) {
    const double turned_rad = std::remainder(b_rad - a_rad, kTurn_rad);
    return {a_rad + std::min(turned_rad, 0.0), std::abs(turned_rad)};
}

void TurnCoverage::clear() {
    stretches_.clear();
    head_rad_ = before_rad_ = kNone;
    added_rad_ = 0;
}

const std::vector<TurnCoverage::Swept>& TurnCoverage::add(const LabelledSector& sector) {
    swept_.clear();
    const double to_rad = sector.sweep->to_rad + added_rad_;
    if (to_rad < head_rad_) {
        // The sensor has restarted. Leaves a gap of at least a full turn after the previous angles.
        added_rad_ += kTurn_rad * (std::ceil((head_rad_ - to_rad) / kTurn_rad) + 1);
        stretches_.clear();
    }
    before_rad_ = std::max(head_rad_, sector.sweep->from_rad + added_rad_);
    if (stretches_.empty()) before_rad_ = sector.sweep->from_rad + added_rad_;
    head_rad_ = sector.sweep->to_rad + added_rad_;
    if (sector.packets == nullptr) {
        add(*sector.sweep, sector.offsets);
    } else {
        for (const Sweep& packet : *sector.packets) add(packet, sector.offsets);
    }
    return swept_;
}

void TurnCoverage::add(const Sweep& sweep, const BeamOffsets& offsets) {
    const Sweep added{sweep.from_rad + added_rad_, sweep.to_rad + added_rad_};
    Sweep stretch = added;
    const auto isJoined = [&](const Sweep& other) {
        if (other.to_rad < head_rad_ - kTurn_rad) return true;  // removes obsolete stretches
        const bool is_near =
            other.from_rad <= added.to_rad + kGap_rad && other.to_rad >= added.from_rad - kGap_rad;
        if (!is_near) return false;
        stretch.from_rad = std::min(stretch.from_rad, other.from_rad);
        stretch.to_rad = std::max(stretch.to_rad, other.to_rad);
        return true;
    };
    stretches_.erase(std::remove_if(stretches_.begin(), stretches_.end(), isJoined),
                     stretches_.end());
    stretches_.push_back(stretch);
    // After a gap, the leading beams are the last to sweep a direction completely.
    const double since_rad = stretch.from_rad + offsets.ahead_rad;
    const double looked_from_rad = added.from_rad - offsets.behind_rad;
    const double looked_to_rad = added.to_rad + offsets.ahead_rad;
    swept_.push_back({std::max(since_rad, looked_from_rad - kBeside_rad),
                      std::min(stretch.to_rad - offsets.behind_rad, looked_to_rad + kBeside_rad),
                      since_rad});
}

std::optional<double> endOfArc(const TurnCoverage::Swept& swept, const TurnCoverage::Arc& arc) {
    const double max_rad = swept.to_rad + kRounding_rad;
    const double turns = std::floor((max_rad - arc.begin_rad - arc.width_rad) / kTurn_rad);
    const double begin_rad = arc.begin_rad + kTurn_rad * turns;
    const double end_rad = begin_rad + arc.width_rad;
    const bool is_swept =
        end_rad >= swept.from_rad - kRounding_rad && begin_rad >= swept.since_rad - kRounding_rad;
    return is_swept ? std::optional(end_rad) : std::nullopt;
}

}  // namespace hagen::live
