#pragma once
#include <hagen/scan/RecoverBeams.h>
#include <hagen/scan/Scan.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace hagen {

/// Recovered beams; null if unknown.
using SharedBeams = std::shared_ptr<const RecoveredBeams>;

/// Recovers unnamed sensors, one per sensor label, from their clouds.
///
/// A label's beams come from the cloud with the most returns among its first five with at least
/// kMinReturnsForBeams returns (the first in case of a tie). After five clouds, the beams do not
/// change.
class CloudSensors {
 public:
    static constexpr int kClouds = 5;

    /// Uses the coordinates of a cloud if the label needs further clouds. Rings of its returns, if
    /// given, define the beams if they agree with the elevations (ringBeams()).
    void see(const std::string& label, const Scan& scan,
             const std::vector<std::int32_t>& rings = {});

    /// Whether further clouds with this label are ignored.
    bool isSettled(const std::string& label) const;

    /// The beams of this label so far; null until a cloud has enough returns and three beams.
    SharedBeams beamsOf(const std::string& label) const;

 private:
    struct Seen {
        int clouds = 0;           ///< number of clouds with enough returns
        std::size_t returns = 0;  ///< maximum number of returns of a cloud
        SharedBeams beams;        ///< from that cloud
    };
    std::map<std::string, Seen> seen_;
};

/// Describes recovered beams: "16 beams recovered (VLP-16), 99.8 % of the returns lie on them".
std::string textOf(const SharedBeams& beams);

}  // namespace hagen
