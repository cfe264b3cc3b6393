#include "DroneSection.h"

#include <set>

#include "Rows.h"
#include "Sums.h"
#include "support/Tables.h"

namespace hagen {
namespace {

std::string obstaclesCell(const evaluation::Missed& obstacles) {
    if (obstacles.all == 0) return "-";
    return std::to_string(obstacles.missed) + " of " + std::to_string(obstacles.all);
}

std::string percentOf(const evaluation::Missed& missed) {
    return missed.all == 0 ? "-" : cell(100 * missed.share(), 2);
}

using Data = std::vector<std::pair<std::string, Sets>>;

std::vector<std::string> headsOf(const std::string& first, const Data& data) {
    std::vector<std::string> heads{first};
    for (const auto& [name, sets] : data) heads.push_back(name);
    return heads;
}

Table rangeTable(const Data& data) {
    Table table(headsOf("range", data));
    std::size_t count = 0;
    for (const auto& [name, sets] : data)
        count = std::max(count, droneSumOf(sets, kDefault).tall_by_range.size());
    for (std::size_t band = 0; band < count; ++band) {
        std::vector<std::string> line{evaluation::RangeBands{1000}.nameOf(band)};
        for (const auto& [name, sets] : data) {
            const auto by_range = droneSumOf(sets, kDefault).tall_by_range;
            line.push_back(
                missedCell(band < by_range.size() ? by_range[band] : evaluation::Missed{}));
        }
        table.add(line);
    }
    return table;
}

Table kindTable(const Data& data) {
    std::set<std::string> kinds;
    for (const auto& [name, sets] : data) {
        for (const auto& [kind, missed] : droneSumOf(sets, kDefault).tall_by_kind)
            kinds.insert(kind);
    }
    Table table(headsOf("class", data));
    for (const std::string& kind : kinds) {
        std::vector<std::string> line{kind};
        for (const auto& [name, sets] : data) {
            const auto by_kind = droneSumOf(sets, kDefault).tall_by_kind;
            const auto found = by_kind.find(kind);
            line.push_back(found == by_kind.end() ? "-" : missedCell(found->second));
        }
        table.add(line);
    }
    return table;
}

/// One row per method, with "missed / nothing found / RoI on bare ground" for each data set.
std::string shareTable(const Data& data, const std::vector<std::string>& methods) {
    Table table(headsOf("", data));
    for (const std::string& method : methods) {
        std::vector<std::string> line{method};
        for (const auto& [name, sets] : data) {
            const evaluation::DroneScores drone = droneSumOf(sets, method);
            line.push_back(percentOf(drone.tall) + " / " + percentOf(drone.obstacles) + " / " +
                           cell(drone.falseOnBareGroundPerScan(), 1));
        }
        table.add(line);
    }
    return table.text();
}

Table countTable(const Data& data, const std::vector<std::string>& methods) {
    Table table({"data", "method", "F1 of RoI / ROU", "missed above 0.5 m", "nothing found",
                 "RoI on bare ground"});
    for (const auto& [name, sets] : data) {
        for (const std::string& method : methods) {
            const evaluation::Scores scores = sumOf(sets, method);
            const evaluation::DroneScores drone = droneSumOf(sets, method);
            table.add({name, method, pairCell(scores.roi.f1(), scores.rou.f1()),
                       missedCell(drone.tall), obstaclesCell(drone.obstacles),
                       cell(drone.falseOnBareGroundPerScan(), 1)});
        }
    }
    return table;
}

}  // namespace

std::string droneSection(const std::vector<Measured>& all) {
    return "## Missed obstacles and false alarms\n\n"
           "Cells ([definitions](evaluation.md#what-matters-to-a-drone)): missed obstacle returns "
           "more than 0.5 m above the ground [%] / undetected obstacles [%] / "
           "returns per scan labelled RoI on bare ground. On real scans, `default` and the "
           "`tuned` methods are in-sample.\n\n" +
           shareTable(mainData(all), headlineNames(all)) +
           "Tables: [counts](results/drone.csv), returns that `default` misses "
           "[by range](results/missed_by_range.csv) and [by "
           "class](results/missed_by_class.csv).\n\n";
}

CsvTables droneTables(const std::vector<Measured>& all) {
    const Data data = mainData(all);
    return {{"drone.csv", countTable(data, headlineNames(all)).csv()},
            {"missed_by_range.csv", rangeTable(data).csv()},
            {"missed_by_class.csv", kindTable(data).csv()}};
}

}  // namespace hagen
