#pragma once
#include <hagen/trials/Condition.h>
#include <hagen/trials/RunTable.h>
#include <hagen/trials/Statistics.h>
#include <cmath>
#include <string>
#include <vector>

namespace hagen::reports {

/// Quantiles of several values; NaN without values.
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
    Spread min_clearance_m{};  ///< of all runs; the next four of successful ones only
    Spread path_ratio{};       ///< path flown over the shortest path found in the true scene
    Spread time_s{}, first_reaction_m{}, rms_jerk_m_s3{};
    Spread latency_p50_ms{}, latency_p95_ms{};  ///< sensor to command, of all runs
    double latency_max_ms = NAN;
    double dropped_percent = NAN;  ///< of scans
    double stops_per_km = NAN;     ///< emergency stops
};

enum class Verdict { NotInferior, Inferior, Open };

/// A filter may lose objects this thin, so wires are reported separately.
constexpr const char* kWires = "wires";
constexpr const char* kThinWires = "wires-thin";
constexpr const char* kAllButWires = "all but wires";

/// Whether a scenario is reported as wires.
bool isWires(const std::string& scenario);

/// Two contenders on the courses that both flew, under one condition.
struct Pairing {
    std::string scenario;  ///< empty: all scenarios that both flew; or kAllButWires
    trials::Condition condition;
    trials::Contender first, second;
    int both = 0, only_first = 0, only_second = 0, neither = 0;  ///< succeeded
    int only_first_collided = 0, only_second_collided = 0;
    int scenarios = 1;               ///< counted here
    std::vector<std::string> of{};   ///< of several, their names
    int repeated = 0;                ///< thin wires not counted, of layouts that wires have
    int alike_scenarios = 0;         ///< of these, scenarios without a discordant pair
    std::string largest_scenario{};  ///< of several, that with the most courses
    int largest_pairs = 0;           ///< and their number
    double p = 1;                    ///< McNemar's test
    double least_p = 1;              ///< that the test can give for this many discordant pairs
    /// With Holm's correction over the pairings of a list that could be significant; NaN if this
    /// one could not: least_p is not below kLevel.
    double p_holm = NAN;
    double difference = 0;            ///< of success, first - second
    trials::Bounds interval{-1, 1};   ///< Newcombe's, 95 %
    Verdict verdict = Verdict::Open;  ///< with margin kMargin

    int pairs() const { return both + only_first + only_second + neither; }
    /// Courses on which only one of the two succeeded.
    int discordant() const { return only_first + only_second; }
};

/// Margin of non-inferiority: 3 percentage points of success.
constexpr double kMargin = 0.03;

/// Level of significance.
constexpr double kLevel = 0.05;

/// The model with the true scene. It is a ceiling, not a rival.
constexpr const char* kOracle = "oracle";
/// The same, which knows the future, too.
constexpr const char* kOracleWithMotion = "oracle+motion";
/// The mapping-free contender, and the one that follows what moves.
constexpr const char* kMappingFree = "W-RoI";
constexpr const char* kMappingFreeWithMotion = "W-RoI+motion";

/// The success of a contender at several speeds under otherwise equal conditions.
struct SpeedLimit {
    std::string scenario;
    trials::Condition lowest;  ///< the condition with the lowest speed
    trials::Contender contender;
    double flown_m_s;    ///< highest speed flown
    double highest_m_s;  ///< highest with success >= 95 % there and at all lower speeds; NaN: none
    double sure_m_s;     ///< the same for the lower bound of the interval
};

struct Summary {
    std::vector<std::string> scenarios;         ///< in the order of the table
    std::vector<trials::Condition> conditions;  ///< the one with the most runs first
    std::vector<trials::Contender> contenders;  ///< A* first, W-RoI first among its models
    std::vector<Cell> cells;  ///< by condition, scenario (all scenarios last), contender
    /// Of all scenarios together, of courses that differ: without thin wires where both flew the
    /// wires of the same layout.
    std::vector<Pairing> overall;
    std::vector<Pairing> pairings;  ///< of each scenario
    /// W-RoI against W-Full in all scenarios except wires. Empty if wires were not flown; `overall`
    /// says the same then.
    std::vector<Pairing> without_wires;
    /// Every model against the true scene with the same guidance, in each scenario.
    std::vector<Pairing> to_oracle;
    /// The true scene with motion against the one without, with the same guidance, in each
    /// scenario.
    std::vector<Pairing> motion_to_oracle;
    std::vector<SpeedLimit> speed_limits;
    std::vector<std::string> settings, versions;  ///< of the runs; normally one of each
    int runs = 0;
};

/// Counts, quantiles and paired tests. Under each condition, W-RoI is compared with every other
/// model with the same guidance, with itself with the other guidance, and W-RoI with straight
/// guidance with maps with A*. The true scene is apart, in `to_oracle`.
Summary summarize(const std::vector<trials::Run>& runs);

/// Counts and quantiles of the runs, at least one, of one contender under one condition.
Cell cellOf(const std::string& scenario, const std::vector<const trials::Run*>& runs);

/// nullptr if there is no such cell.
const Cell* find(const Summary& summary, const std::string& scenario,
                 const trials::Condition& condition, const trials::Contender& contender);

/// Contenders with runs under a condition, in the summary's order.
std::vector<trials::Contender> contendersUnder(const Summary& summary,
                                               const trials::Condition& condition);

std::string nameOf(Verdict verdict);

}  // namespace hagen::reports
