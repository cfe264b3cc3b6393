#pragma once
#include <hagen/evaluation/ScanScores.h>
#include <string>
#include <vector>
#include "evaluation/Bootstrap.h"

namespace hagen::evaluation {

/// A part of the scored returns: a range band, an altitude band, an object class, a folder.
struct Group {
    std::string name;
    std::vector<Scores> scans;  ///< one entry per scan with returns in this part

    Scores sum() const;
};

/// All scans as one group.
Group overallScores(const std::vector<ScanScores>& scans);

/// Scans by folder, in the order of the folder names `folders`.
std::vector<Group> byFolder(const std::vector<ScanScores>& scans,
                            const std::vector<std::string>& folders);

/// Scans by the sensor's altitude: below 0, 0-2, 2-3, 3-5, 5-10 and 10+ m; bands are half-open, the
/// lower bound is inclusive. Scans of unknown altitude and empty bands are skipped.
std::vector<Group> byAltitude(const std::vector<ScanScores>& scans);

/// Parts of scans by range; skips bands without returns.
std::vector<Group> byRange(const std::vector<ScanScores>& scans, const RangeBands& bands);

/// Parts of scans by object class, sorted by name. A class is either RoI or ROU, so only its recall
/// (Scores::correct()) is meaningful, not its precision.
std::vector<Group> byKind(const std::vector<ScanScores>& scans);

}  // namespace hagen::evaluation
