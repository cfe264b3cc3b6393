#pragma once
#include <hagen/avoidance/TrialResult.h>
#include <hagen/avoidance/TrialSetup.h>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// One row of runs.csv: one flight.
struct Run {
    std::string scenario;
    std::uint64_t seed;
    TrialSetup setup;
    TrialResult result;
    double oracle_path_m;
    std::string settings_hash, version;
};

/// Columns: scenario,seed,model,guidance,speed,outcome,min_clearance_m,path_m,time_s,planner,
/// pose_error,latency_scale,unknown,oracle_path_m,first_reaction_m,rms_jerk_m_s3,scans,
/// dropped_scans,emergency_stops,latency_p50_ms,latency_p95_ms,latency_max_ms,settings,version,air,distance
/// outcome: success, collision, timeout; pose_error: none, noise, drift; unknown: optimistic,
/// brake_known; air: dusty, clear; distance: unbiased,
/// as-stored; NaN is an empty field. Fixed decimals, '.' in every locale, \n.
/// The row of a run with sectors has one more: `updates` (scans, sectors).
std::string runHeader();
std::string rowOf(const Run& run);

/// Whether a table with this run needs the column `updates`; then all of its rows have it.
bool needsAllColumns(const Run& run);
/// What the header and a row are with it.
std::string fullRunHeader();
std::string fullRowOf(const Run& run);

/// A run's key identifies it: the fields of its course and setup, as in its row. The header's
/// columns:
/// scenario,seed,model,guidance,speed,planner,pose_error,latency_scale,unknown,air,distance
/// and, of a run with sectors, updates.
std::string keyOf(const Run& run);

/// A run of this course and setup that was not flown yet. Throws std::runtime_error, naming the
/// column.
Run runOfKey(const std::string& key);

/// Tables of older versions have neither column `air` nor `distance`: clear air, as-stored. Without
/// `updates`, all are of whole scans. Throws std::runtime_error, naming file, line and column.
std::vector<Run> readRuns(const std::filesystem::path& file);

/// Orders runs by scenario, speed, planner, guidance, model, ..., seed.
void sortRuns(std::vector<Run>& runs);

}  // namespace hagen::avoidance
