#pragma once
#include <hagen/evaluation/Bootstrap.h>
#include <hagen/evaluation/ScanScores.h>
#include <string>
#include <vector>

namespace hagen::evaluation {

/// A part of what was scored: a range band, an altitude, a kind, a folder.
struct Group {
    std::string name;
    std::vector<Scores> scans;  ///< a part of each scan that has one

    Scores sum() const;
};

/// All scans as one group.
Group wholeOf(const std::vector<ScanScores>& scans);

/// Scans by folder, in the order of the folders; `folders` are their names.
std::vector<Group> byFolder(const std::vector<ScanScores>& scans,
                            const std::vector<std::string>& folders);

/// Scans by the sensor's altitude: 0-2, 2-3, 3-5, 5-10 and 10+ m, each from its lower bound on and
/// below its upper. Scans whose altitude is not known are left out, and bands without any.
std::vector<Group> byAltitude(const std::vector<ScanScores>& scans);

/// Parts of scans by range; bands without a return are left out.
std::vector<Group> byRange(const std::vector<ScanScores>& scans, const RangeBands& bands);

/// Parts of scans by kind, in the order of their names. A kind is RoI or ROU, not both: its recall
/// (Scores::correct()) says all, its precision nothing.
std::vector<Group> byKind(const std::vector<ScanScores>& scans);

}  // namespace hagen::evaluation
