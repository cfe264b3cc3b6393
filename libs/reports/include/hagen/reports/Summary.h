#pragma once
#include <hagen/trials/Condition.h>
#include <hagen/trials/RunTable.h>
#include <hagen/trials/Statistics.h>
#include <cmath>
#include <string>
#include <vector>

namespace hagen::reports {

/// Of several values: NaN where there is none.
struct Spread {
    int count = 0;
    double p05 = NAN, median = NAN, p95 = NAN;
    trials::Bounds median_interval{NAN, NAN};  ///< bootstrap, 95 %
};

/// The runs of one contender in one scenario, or in all, under one condition.
struct Cell {
    std::string scenario;  ///< empty: all scenarios
    trials::Condition condition;
    trials::Contender contender;
    int runs = 0, successes = 0, collisions = 0, timeouts = 0;
    Spread min_clearance_m{};  ///< of all runs; the others below of successful ones
    Spread path_ratio{};       ///< way flown over the oracle's way to the goal's sphere
    Spread time_s{}, first_reaction_m{}, rms_jerk_m_s3{};
    Spread latency_p50_ms{}, latency_p95_ms{};  ///< sensor to command, of all runs
    double latency_max_ms = NAN;
    double dropped_percent = NAN;  ///< of scans
    double stops_per_km = NAN;     ///< emergency stops
};

enum class Verdict { NotInferior, Inferior, Open };

/// What is this thin a filter may lose: wires are told of apart.
constexpr const char* kWires = "wires";
constexpr const char* kAllButWires = "all but wires";

/// Two contenders that flew the same courses under the same condition.
struct Pairing {
    std::string scenario;  ///< empty: all scenarios that both flew; kAllButWires
    trials::Condition condition;
    trials::Contender first, second;
    int both = 0, only_first = 0, only_second = 0, neither = 0;  ///< succeeded
    int only_first_collided = 0, only_second_collided = 0;
    double p = 1, p_holm = 1;  ///< McNemar; Holm's correction over all pairings of the same kind
    double difference = 0;     ///< of success, first - second
    trials::Bounds interval{-1, 1};   ///< Newcombe, 95 %
    Verdict verdict = Verdict::Open;  ///< with a margin of kMargin

    int pairs() const { return both + only_first + only_second + neither; }
};

/// Less success than this is not inferior: 3 points.
constexpr double kMargin = 0.03;

/// The success of a contender at several speeds, all else being the same.
struct SpeedLimit {
    std::string scenario;
    trials::Condition lowest;  ///< of the conditions, by speed
    trials::Contender contender;
    double flown_m_s;    ///< highest there is
    double highest_m_s;  ///< with success >= 95 %, and at all lower speeds; NaN: none
    double sure_m_s;     ///< the same of the interval's lower bound
};

struct Summary {
    std::vector<std::string> scenarios;         ///< as they come in the table
    std::vector<trials::Condition> conditions;  ///< the one with most runs first
    std::vector<trials::Contender> contenders;  ///< A* first, W-RoI first among its models
    std::vector<Cell> cells;        ///< by condition, scenario (all scenarios last), contender
    std::vector<Pairing> overall;   ///< of all scenarios together
    std::vector<Pairing> pairings;  ///< of each scenario
    /// W-RoI against W-Full in all scenarios but wires, under one guidance; none where wires were
    /// not flown, for then `overall` tells it.
    std::vector<Pairing> without_wires;
    std::vector<SpeedLimit> speed_limits;
    std::vector<std::string> settings, versions;  ///< of the runs; one of each if all is well
    int runs = 0;
};

/// Counts, spreads, paired tests. Under one condition W-RoI is compared with every other model of
/// the same guidance; with itself under the other guidance; and, straight, with maps under A*.
Summary summarize(const std::vector<trials::Run>& runs);

/// Counts and spreads of one contender's runs, one at least, under one condition.
Cell cellOf(const std::string& scenario, const std::vector<const trials::Run*>& runs);

/// Nothing where there is no such cell.
const Cell* find(const Summary& summary, const std::string& scenario,
                 const trials::Condition& condition, const trials::Contender& contender);

/// Contenders with runs under a condition, in the summary's order.
std::vector<trials::Contender> contendersUnder(const Summary& summary,
                                               const trials::Condition& condition);

std::string nameOf(Verdict verdict);

}  // namespace hagen::reports
