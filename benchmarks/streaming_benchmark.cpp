// Measures the cost and accuracy of labelling sectors, for the table in docs/live.md.
#include <hagen/live/LidarStream.h>
#include <hagen/mrpt/ObservationScan.h>
#include <hagen/recordings/ScanFolder.h>
#include <hagen/recordings/ScanSource.h>
#include <hagen/scan/Angle.h>
#include <hagen/sensors/VelodyneModel.h>
#include <mrpt/math/CQuaternion.h>
#include "base/NumberText.h"
#include "base/ProcessCost.h"
#include "base/Quantile.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace {

using namespace hagen;
using mrpt::obs::CObservationVelodyneScan;

constexpr float kNear_m = 5;

/// A turn of a recording and its whole-scan labels.
struct Turn {
    CObservationVelodyneScan::ConstPtr packets;
    std::optional<Attitude> attitude;
    std::optional<Eigen::Isometry3d> pose;
    std::vector<Label> whole, truth;
    Scan scan;
    std::vector<std::uint16_t> place;  ///< degree and row of each return
};

/// Height of a return above the nearest ground return (ground truth); infinite if none is within 2
/// m.
double heightAboveGround(const Turn& turn, std::size_t i) {
    constexpr double kNearest_m = 2;
    const Eigen::Matrix3d level = turn.pose.value_or(Eigen::Isometry3d::Identity()).linear();
    const auto at = [&](std::size_t k) -> Eigen::Vector3d {
        return level * Eigen::Vector3d(turn.scan.x_m[k], turn.scan.y_m[k], turn.scan.z_m[k]);
    };
    const Eigen::Vector3d own = at(i);
    double nearest_m = kNearest_m, height_m = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < turn.truth.size(); ++k) {
        if (turn.truth[k] != Label::Rou) continue;
        const Eigen::Vector3d way = own - at(k);
        if (way.head<2>().norm() >= nearest_m) continue;
        nearest_m = way.head<2>().norm();
        height_m = way.z();
    }
    return height_m;
}

struct Recording {
    std::vector<Turn> turns;
    Settings settings;
    double whole_us = 0;  ///< median CPU time of the filter on a whole scan
};

struct Confusion {
    std::size_t hits = 0, missed = 0, false_alarms = 0;
    void add(Label label, Label truth) {
        if (truth == Label::Unclassified || label == Label::Unclassified) return;
        hits += label == Label::Roi && truth == Label::Roi;
        missed += label != Label::Roi && truth == Label::Roi;
        false_alarms += label == Label::Roi && truth != Label::Roi;
    }
    Confusion without(const Confusion& other) const {
        return {hits - other.hits, missed - other.missed, false_alarms - other.false_alarms};
    }
    double f1() const {
        const std::size_t all = 2 * hits + missed + false_alarms;
        return all == 0 ? std::nan("")
                        : 200.0 * static_cast<double>(hits) / static_cast<double>(all);
    }
};

Eigen::Isometry3d isometryOf(const mrpt::poses::CPose3D& pose) {
    return Eigen::Isometry3d(pose.getHomogeneousMatrixVal<mrpt::math::CMatrixDouble44>().asEigen());
}

Recording read(const std::string& file, const std::string& preset, bool levels) {
    Recording recording;
    if (!preset.empty()) mergeSettings(preset, recording.settings);
    const auto source = recordings::openRecording(file);
    source->usePoses({});
    observations::ObservedScan observed;
    std::optional<HagenFilter> filter;
    const std::string truth_folder = file.substr(0, file.rfind('.')) + ".truth";
    std::optional<recordings::ScanFolder> folder;
    if (std::filesystem::exists(truth_folder)) folder.emplace(truth_folder);
    std::vector<double> whole_us;
    while (const auto scan = source->nextScan()) {
        Turn turn;
        turn.packets = std::dynamic_pointer_cast<const CObservationVelodyneScan>(scan->observation);
        if (!turn.packets) continue;
        if (levels) turn.attitude = scan->pose.attitude;
        if (scan->pose.sensor_pose) turn.pose = isometryOf(*scan->pose.sensor_pose);
        observations::readObservation(*turn.packets, recording.settings, observed);
        if (!filter) filter.emplace(observed.sensor, recording.settings.options);
        const auto start = base::threadCpuTime();
        turn.whole = filter->segment(observed.scan, turn.attitude).returns.label;
        whole_us.push_back(
            std::chrono::duration<double, std::micro>(base::threadCpuTime() - start).count());
        turn.scan = observed.scan;
        for (std::size_t i = 0; i < observed.scan.size(); ++i) {
            const double azimuth_deg = degrees(observed.scan.azimuth_rad[i]);
            const int degree = std::min(359, static_cast<int>(azimuth_deg + 180));
            turn.place.push_back(static_cast<std::uint16_t>(degree * 128 + observed.scan.row[i]));
        }
        if (folder && recording.turns.size() < folder->size()) {
            for (const auto word :
                 recordings::readLabels(folder->labelFile(recording.turns.size()))) {
                turn.truth.push_back(static_cast<Label>(word & 0xffff));
            }
            if (turn.truth.size() != turn.whole.size()) turn.truth.clear();
        }
        recording.turns.push_back(std::move(turn));
    }
    recording.whole_us = base::quantile(whole_us, 0.5);
    return recording;
}

/// Near RoI returns of whole scans that sectors miss.
struct Misses {
    std::size_t all = 0, missed = 0, missed_long = 0;  ///< long: in two consecutive turns
    std::vector<bool> now, before;                     ///< by degree and row

    void nextTurn() {
        before = now;
        now.assign(360 * 128, false);
        before.resize(now.size());
    }
    /// Whether the return is missed here and in the previous turn.
    bool add(std::uint16_t place, bool is_missed) {
        ++all;
        if (!is_missed) return false;
        ++missed;
        missed_long += before[place];
        now[place] = true;
        return before[place];
    }
};

struct Figures {
    std::size_t same = 0, different = 0;
    std::size_t judged = 0, right = 0;            ///< different labels: with truth, correct
    std::size_t whole_right = 0, both_right = 0;  ///< correct in whole scans; correct in both
    Misses near, obstacles;                       ///< obstacles are those of the ground truth
    Misses by_whole;              ///< obstacles found by sectors, missed by whole scans
    double highest_missed_m = 0;  ///< maximum height of obstacles missed in two turns
    Confusion whole, streamed;
    std::vector<double> sector_us;
    double turn_us = 0;
};

/// The known part of the sensor's motion.
enum class Known { Nothing, Attitude, Pose };

Attitude attitudeOf(const Eigen::Isometry3d& pose) {
    const Eigen::Vector3d up = pose.linear().transpose() * Eigen::Vector3d::UnitZ();
    return {static_cast<float>(std::atan2(up.y(), up.z())),
            static_cast<float>(std::asin(std::clamp(-up.x(), -1.0, 1.0)))};
}

void setMotion(const Recording& recording, std::size_t k, double part, Known known,
               live::LidarStream& packets) {
    const Turn& turn = recording.turns[k];
    const bool has_next = k + 1 < recording.turns.size() && recording.turns[k + 1].pose;
    if (known == Known::Nothing || !turn.pose || !has_next) return;
    const Eigen::Isometry3d& a = *turn.pose;
    const Eigen::Isometry3d& b = *recording.turns[k + 1].pose;
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
    pose.translation() = (1 - part) * a.translation() + part * b.translation();
    pose.linear() = Eigen::Quaterniond(a.linear())
                        .slerp(part, Eigen::Quaterniond(b.linear()))
                        .toRotationMatrix();
    live::SensorMotion motion{attitudeOf(pose), {}};
    if (known == Known::Pose) motion.map_from_sensor = pose;
    packets.move(motion);
}

void stream(const Recording& recording, const live::StreamingOptions& options, Known known,
            Figures& figures) {
    std::vector<Label> labels;
    std::vector<bool> is_doubtful;
    double label_us = 0;
    const auto take = [&](const live::LabelledSector& sector) {
        labels.insert(labels.end(), sector.label.begin(), sector.label.end());
        is_doubtful.resize(labels.size(), sector.is_doubtful);
    };
    const auto& model =
        sensors::velodyneModel(observations::sensorOf(*recording.turns.front().packets).name);
    live::LidarStream packets(sensors::makeDriver(model.name), recording.settings, take, options);
    double time_s = 0;
    std::size_t count = 0;
    for (std::size_t k = 0; k < recording.turns.size(); ++k) {
        const Turn& turn = recording.turns[k];
        const auto& raw = turn.packets->scan_packets;
        for (std::size_t p = 0; p < raw.size(); ++p) {
            const double part = static_cast<double>(p) / static_cast<double>(raw.size());
            setMotion(recording, k, part, known, packets);
            time_s += 1e-6 * model.packetPeriodUs(false);
            const std::size_t before = packets.segmenter().sectors();
            const auto start = base::threadCpuTime();
            sensors::Datagram datagram;
            datagram.bytes = reinterpret_cast<const std::uint8_t*>(&raw[p]);
            datagram.size = sizeof raw[p];
            packets.add(datagram, time_s);
            const double us =
                std::chrono::duration<double, std::micro>(base::threadCpuTime() - start).count();
            label_us += us;
            if (k > 0 && packets.segmenter().sectors() > before) figures.sector_us.push_back(us);
        }
        count += 1;
    }
    packets.flush();
    figures.turn_us += label_us / static_cast<double>(count);
    std::size_t at = 0;
    figures.near.now.clear();
    figures.obstacles.now.clear();
    figures.by_whole.now.clear();
    for (std::size_t k = 0; k < recording.turns.size(); ++k) {
        const Turn& turn = recording.turns[k];
        figures.near.nextTurn();
        figures.obstacles.nextTurn();
        figures.by_whole.nextTurn();
        for (std::size_t i = 0; i < turn.whole.size(); ++i, ++at) {
            if (is_doubtful[at]) continue;
            const Label label = labels.at(at);
            const bool is_same = label == turn.whole[i];
            figures.same += is_same;
            figures.different += !is_same;
            if (turn.whole[i] == Label::Roi && turn.scan.range_m[i] < kNear_m) {
                figures.near.add(turn.place[i], label != Label::Roi);
                if (!turn.truth.empty() && turn.truth[i] == Label::Roi) {
                    if (figures.obstacles.add(turn.place[i], label != Label::Roi)) {
                        figures.highest_missed_m =
                            std::max(figures.highest_missed_m, heightAboveGround(turn, i));
                    }
                }
            }
            if (label == Label::Roi && turn.scan.range_m[i] < kNear_m && !turn.truth.empty() &&
                turn.truth[i] == Label::Roi) {
                figures.by_whole.add(turn.place[i], turn.whole[i] != Label::Roi);
            }
            if (!turn.truth.empty() && turn.scan.range_m[i] <= recording.settings.options.zone_m) {
                figures.whole.add(turn.whole[i], turn.truth[i]);
                figures.streamed.add(label, turn.truth[i]);
                const bool is_judged = !is_same && turn.truth[i] != Label::Unclassified;
                figures.judged += is_judged;
                figures.right += is_judged && label == turn.truth[i];
                const bool is_right =
                    turn.whole[i] == turn.truth[i] && label != Label::Unclassified;
                figures.whole_right += is_right;
                figures.both_right += is_right && is_same;
            }
        }
    }
}

int run(int argc, char** argv) {
    std::vector<std::string> files;
    std::string preset;
    std::vector<live::StreamingOptions> all;
    Known known = Known::Nothing;
    std::optional<double> skip_rad;
    bool motion_from_ground = true;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        if (word == "-c" && i + 1 < argc) {
            preset = argv[++i];
        } else if (word == "--attitude") {
            known = Known::Attitude;
        } else if (word == "--pose") {
            known = Known::Pose;
        } else if (word == "--ignore-ground") {
            motion_from_ground = false;
        } else if (word == "--skip-deg" && i + 1 < argc) {
            skip_rad = radians(std::atof(argv[++i]));
        } else if (word == "--try" && i + 3 < argc) {
            live::StreamingOptions options;
            options.sector_rad = radians(std::atof(argv[++i]));
            options.window_rad = radians(std::atof(argv[++i]));
            options.keep_every = std::atoi(argv[++i]);
            all.push_back(options);
        } else {
            files.push_back(word);
        }
    }
    if (files.empty()) {
        std::fprintf(stderr,
                     "Usage: streaming-benchmark [-c SETTINGS] [--skip-deg ANGLE] [--attitude | "
                     "--pose | --ignore-ground] [--try SECTOR_DEG "
                     "WINDOW_DEG EVERY]... RECORDING...\nGround truth: RECORDING.truth beside "
                     "RECORDING.rawlog (rawlog-simulate --kitti)\n");
        return 2;
    }
    if (all.empty()) all.emplace_back();
    for (auto& options : all) {
        options.estimate_motion_from_ground = motion_from_ground;
        if (skip_rad) options.skip_ahead_rad = options.skip_ahead_moved_rad = *skip_rad;
    }
    std::vector<Recording> recordings;
    for (const std::string& file : files) {
        recordings.push_back(read(file, preset, known != Known::Nothing));
        std::printf("%s: %zu turns, whole scan %.0f us\n", file.c_str(),
                    recordings.back().turns.size(), recordings.back().whole_us);
    }
    std::printf(
        "| sector | window | every | equal %% | worst %% | different labels correct %% | equal if "
        "whole scan correct %% | RoI < 5 m missed | in two turns | obstacles < 5 m "
        "missed | in two turns | maximum height of these [m] | missed only by whole scans | in "
        "two "
        "turns | F1 whole | F1 | of the worst "
        "flight: F1 whole | F1 | ms/turn | sector us p50 | p99 | p99.9 |\n"
        "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|"
        "\n");
    for (const auto& options : all) {
        Figures sum;
        double worst = 100;
        Confusion whole_of_worst, streamed_of_worst;  // for the flight with the largest F1 loss
        double max_lost = -100;
        for (const Recording& recording : recordings) {
            const std::size_t same = sum.same, different = sum.different;
            const Confusion whole = sum.whole, streamed = sum.streamed;
            stream(recording, options, known, sum);
            const auto n_same = static_cast<double>(sum.same - same);
            const auto n_all = n_same + static_cast<double>(sum.different - different);
            if (n_all > 0) worst = std::min(worst, 100 * n_same / n_all);
            const Confusion its_whole = sum.whole.without(whole);
            const Confusion its_streamed = sum.streamed.without(streamed);
            const double lost = its_whole.f1() - its_streamed.f1();
            if (lost > max_lost) {
                max_lost = lost;
                whole_of_worst = its_whole;
                streamed_of_worst = its_streamed;
            }
        }
        std::printf(
            "| %.1f | %.0f | %d | %.2f | %.2f | %.0f | %.2f | %zu of %zu | %zu | %zu of %zu | %zu "
            "| %.2f | %zu | %zu | %.2f | %.2f | %.2f | %.2f | %.2f | %.0f | %.0f | %.0f |\n",
            degrees(options.sector_rad), degrees(options.window_rad), options.keep_every,
            100.0 * static_cast<double>(sum.same) / static_cast<double>(sum.same + sum.different),
            worst, 100.0 * static_cast<double>(sum.right) / static_cast<double>(sum.judged),
            100.0 * static_cast<double>(sum.both_right) / static_cast<double>(sum.whole_right),
            sum.near.missed, sum.near.all, sum.near.missed_long, sum.obstacles.missed,
            sum.obstacles.all, sum.obstacles.missed_long, sum.highest_missed_m, sum.by_whole.missed,
            sum.by_whole.missed_long, sum.whole.f1(), sum.streamed.f1(), whole_of_worst.f1(),
            streamed_of_worst.f1(), 1e-3 * sum.turn_us / static_cast<double>(recordings.size()),
            base::quantile(sum.sector_us, 0.5), base::quantile(sum.sector_us, 0.99),
            base::quantile(sum.sector_us, 0.999));
        std::fflush(stdout);
    }
    return 0;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        return run(argc, argv);
    } catch (const std::exception& e) {
        std::fprintf(stderr, "streaming-benchmark: %s\n", e.what());
        return 1;
    }
}
