#pragma once
#include <hagen/scan/RecoverBeams.h>
#include <hagen/scan/Scan.h>
#include <mrpt/obs/CObservation.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen::observations {

/// Null: not known.
using SharedBeams = std::shared_ptr<const RecoveredBeams>;

/// The sensors of clouds that nobody named, recovered from the first clouds of each sensor label.
///
/// The first five clouds of a label with enough returns (kFewestReturnsForBeams) are looked at; the
/// one with the most returns, of equal ones the first, shows the beams. A cloud that is mostly sky
/// may lack some of them. After these five, a label's beams do not change.
class CloudSensors {
 public:
    static constexpr int kClouds = 5;

    /// Looks at an observation, if it is a cloud: not at packets, which know their sensor, and not
    /// at a cloud that cannot be read. Does nothing once the label is settled.
    void see(const mrpt::obs::CObservation& observation);
    /// The same for the coordinates of a cloud; other members of `scan` are not used. If its
    /// returns are numbered by ring, these show the beams, provided that they agree with the
    /// elevations (ringBeams()).
    void see(const std::string& label, const Scan& scan,
             const std::vector<std::int32_t>& rings = {});

    /// Whether more clouds of this label would not change its beams.
    bool isSettled(const std::string& label) const;

    /// The beams of this label's sensor, so far; null before a cloud with enough returns. A sensor
    /// with two beams counts as none: the filter needs three rows.
    SharedBeams beamsOf(const std::string& label) const;

 private:
    struct Seen {
        int clouds = 0;           ///< with enough returns
        std::size_t returns = 0;  ///< of the cloud with the most
        SharedBeams beams;        ///< of that cloud
    };
    std::map<std::string, Seen> seen_;
    Scan scan_;
    std::vector<std::int32_t> rings_;
};

/// What is known about the sensor of such clouds, for the user: "16 beams recovered (VLP-16),
/// 99.8 % of the returns lie on them".
std::string textOf(const SharedBeams& beams);

}  // namespace hagen::observations
