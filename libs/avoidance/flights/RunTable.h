#pragma once
#include <hagen/avoidance/Trial.h>
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

/// The columns: scenario,seed,model,guidance,speed,outcome,min_clearance_m,path_m,time_s,planner,
/// pose_error,latency_scale,unknown,oracle_path_m,first_reaction_m,rms_jerk_m_s3,scans,
/// dropped_scans,emergency_stops,latency_p50_ms,latency_p95_ms,latency_max_ms,settings,version,
/// air,distance,updates. unknown: optimistic, brake_known; conditions as in
/// FlightConditions.h; NaN is an empty field. Fixed decimals, '.' in every locale, \n.
std::string runHeader();
std::string rowOf(const Run& run);

/// A run's key identifies it: the fields of its course and setup, in the order of the columns:
/// scenario,seed,model,guidance,speed,planner,pose_error,latency_scale,unknown,air,distance,
/// updates.
std::string keyOf(const Run& run);

/// A run with this course and setup, without results. Throws std::runtime_error, naming the column.
Run runOfKey(const std::string& key);

/// Throws std::runtime_error naming file, line and column.
std::vector<Run> readRuns(const std::filesystem::path& file);

/// Orders runs by scenario, speed, planner, guidance, model, ..., seed.
void sortRuns(std::vector<Run>& runs);

}  // namespace hagen::avoidance
