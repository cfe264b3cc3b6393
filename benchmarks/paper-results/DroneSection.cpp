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

std::string methodTable(const std::string& name, const Sets& sets,
                        const std::vector<std::string>& methods) {
    Table table({"`" + name + "`", "F1 of RoI / ROU", "missed above 0.5 m", "nothing found",
                 "RoI on bare ground"});
    for (const std::string& method : methods) {
        const evaluation::Scores scores = sumOf(sets, method);
        const evaluation::DroneScores drone = droneSumOf(sets, method);
        table.add({method, pairCell(scores.roi.f1(), scores.rou.f1()), missedCell(drone.tall),
                   obstaclesCell(drone.obstacles), cell(drone.falseOnBareGroundPerScan(), 1)});
    }
    return table.text();
}

using Data = std::vector<std::pair<std::string, Sets>>;

std::vector<std::string> headsOf(const std::string& first, const Data& data) {
    std::vector<std::string> heads{first};
    for (const auto& [name, sets] : data) heads.push_back(name);
    return heads;
}

std::string rangeTable(const Data& data) {
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
    return table.text();
}

std::string kindTable(const Data& data) {
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
    return table.text();
}

}  // namespace

std::string droneSection(const std::vector<Measured>& all) {
    const Data data = mainData(all);
    std::string text =
        "## What matters to a drone\n\n"
        "F1 counts every return alike. A drone rather asks "
        "([definitions](evaluation.md#what-matters-to-a-drone)): how many obstacle returns more "
        "than 0.5 m above the true ground are missed; of how many obstacles with at least five "
        "returns in a scan nothing is found; and how many returns per scan are labelled RoI on "
        "ground with no true obstacle within 2 m. On real scans, the figures of `default` and of "
        "`tuned` methods are in-sample.\n\n";
    for (const auto& [name, sets] : data) text += methodTable(name, sets, headlineNames(all));
    return text + "Obstacle returns above 0.5 m that `default` misses, by range:\n\n" +
           rangeTable(data) + "By object class:\n\n" + kindTable(data);
}

}  // namespace hagen
