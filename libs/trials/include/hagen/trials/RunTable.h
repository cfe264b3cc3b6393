#pragma once
#include <hagen/trials/Trial.h>
#include <filesystem>
#include <string>
#include <vector>

namespace hagen::trials {

/// A row of runs.csv.
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
/// dropped_scans,emergency_stops,latency_p50_ms,latency_p95_ms,latency_max_ms,settings,version
/// outcome: success, collision, timeout; pose_error: none, noise, drift; unknown: optimistic,
/// brake_known; NaN is an empty field. Fixed decimals, '.' whatever the locale, \n.
std::string runHeader();
std::string rowOf(const Run& run);

/// The run that a row tells. Throws std::runtime_error, naming the column.
Run runOf(const std::string& row);

/// Names as in runs.csv. poseErrorFrom() throws std::invalid_argument, naming the known ones.
std::string nameOf(Outcome outcome);
std::string nameOf(PoseError error);
PoseError poseErrorFrom(const std::string& name);

/// Throws std::runtime_error, naming file, line and column.
std::vector<Run> readRuns(const std::filesystem::path& file);

/// By scenario, speed, planner, guidance, model, ..., seed: one order whatever order they ran in.
void sortRuns(std::vector<Run>& runs);

}  // namespace hagen::trials
