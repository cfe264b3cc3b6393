#pragma once
#include <string>
#include <vector>

#include <hagen/pages/Table.h>
#include <hagen/reports/Report.h>
#include <hagen/reports/SharedCourses.h>

namespace hagen::reports {

/// Scenarios by contenders, of a condition: share in percent, its interval, and of how many runs.
pages::Table successTable(const Summary& summary, const trials::Condition& condition);
pages::Table collisionTable(const Summary& summary, const trials::Condition& condition);
pages::Table outcomeTable(const Summary& summary,
                          const trials::Condition& condition);  ///< a row a cell

pages::Table pairingTable(const std::vector<Pairing>& pairings);
pages::Table speedTable(const Summary& summary);
pages::Table squareTable(const Summary& summary,
                         const trials::Condition& condition);  ///< model x guidance
pages::Table flightTable(const SharedCourses& shared);         ///< clearance, path, ...
pages::Table wiresTable(const Summary& summary,
                        const trials::Condition& condition);  ///< a row a contender
pages::Table shortfallTable(const trials::FlownRuns& flown);
pages::Table effortTable(const Summary& summary,
                         const trials::Condition& condition);  ///< latency, drops, ...
/// p50, p95 and max of each stage of the models that flew.
pages::Table stageTable(const Summary& summary, const trials::LatencyProfile& profile);
/// CPU time and heap of each model, as measured while flying.
pages::Table measuredTable(const trials::MeasuredByModel& measured);
pages::Table memoryTable(const std::vector<trials::HeapCurve>& memory);

/// Stages that a contender's scans go through, in order, by the profile's names; those alone that
/// the profile has.
std::vector<std::string> stageNamesOf(const trials::Contender& contender,
                                      const std::string& planner,
                                      const trials::LatencyProfile& profile);

}  // namespace hagen::reports
