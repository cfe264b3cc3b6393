#pragma once
#include <hagen/trials/LatencyProfile.h>
#include <string>
#include <vector>

#include "Report.h"
#include "SharedCourses.h"
#include "Table.h"

namespace hagen {

/// Scenarios by contenders, of a condition: share in percent, its interval, and of how many runs.
Table successTable(const Summary& summary, const Condition& condition);
Table collisionTable(const Summary& summary, const Condition& condition);
Table outcomeTable(const Summary& summary, const Condition& condition);  ///< a row a cell

Table pairingTable(const std::vector<Pairing>& pairings);
Table speedTable(const Summary& summary);
Table squareTable(const Summary& summary, const Condition& condition);  ///< model x guidance
Table flightTable(const SharedCourses& shared);                         ///< clearance, path, ...
Table wiresTable(const Summary& summary, const Condition& condition);   ///< a row a contender
Table shortfallTable(const FlownRuns& flown);
Table effortTable(const Summary& summary, const Condition& condition);  ///< latency, drops, ...
/// p50, p95 and max of each stage of the models that flew.
Table stageTable(const Summary& summary, const LatencyProfile& profile);
/// CPU time and heap of each model, as measured while flying.
Table measuredTable(const MeasuredByModel& measured);
Table memoryTable(const std::vector<MemoryCurve>& memory);

/// Stages that a contender's scans go through, in order, by the profile's names; those alone that
/// the profile has.
std::vector<std::string> stageNamesOf(const Contender& contender, const std::string& planner,
                                      const LatencyProfile& profile);

}  // namespace hagen
