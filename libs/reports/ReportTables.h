#pragma once
#include <string>
#include <vector>

#include <hagen/pages/Table.h>
#include <hagen/reports/Report.h>
#include <hagen/reports/SharedCourses.h>

namespace hagen::reports {

/// Scenarios by contenders under one condition: rate in percent, its interval, number of runs.
pages::Table successTable(const Summary& summary, const trials::Condition& condition);
pages::Table collisionTable(const Summary& summary, const trials::Condition& condition);
pages::Table outcomeTable(const Summary& summary,
                          const trials::Condition& condition);  ///< one row per cell

pages::Table pairingTable(const std::vector<Pairing>& pairings);
/// The same for totals, with the number of scenarios without a difference.
pages::Table pooledTable(const std::vector<Pairing>& pairings);
/// Which scenarios tell the contenders of the condition from other models, and at which speed.
pages::Table saturationTable(const Summary& summary, const trials::Condition& condition);
pages::Table speedTable(const Summary& summary);
pages::Table squareTable(const Summary& summary,
                         const trials::Condition& condition);  ///< model x guidance
pages::Table flightTable(const SharedCourses& shared);         ///< clearance, path, time, ...
pages::Table wiresTable(const Summary& summary,
                        const trials::Condition& condition);  ///< one row per contender
pages::Table shortfallTable(const trials::FlownRuns& flown);
pages::Table effortTable(const SharedCourses& shared);  ///< latency, drops, ...
/// p50, p95 and maximum of each stage of the models that flew.
pages::Table stageTable(const Summary& summary, const trials::LatencyProfile& profile);
/// CPU time and heap of each contender, measured during its flights under this condition.
pages::Table measuredTable(const trials::MeasuredByContender& measured,
                           const trials::Condition& condition);
pages::Table memoryTable(const std::vector<trials::HeapCurve>& memory);

/// The stages of a contender's planning step, in order, by their names in the profile. Stages that
/// the profile lacks are left out.
std::vector<std::string> stageNamesOf(const trials::Contender& contender,
                                      const std::string& planner,
                                      const trials::LatencyProfile& profile);

/// A stage for people: "W-RoI/astar+primitives" as "RoI window: primitives after A*". Without
/// `after_model` (here ": ") the model is left out.
std::string stageText(const std::string& stage, const std::string& after_model);

}  // namespace hagen::reports
