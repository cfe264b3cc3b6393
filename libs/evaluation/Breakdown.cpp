#include "evaluation/Breakdown.h"
#include <algorithm>
#include <array>
#include <limits>
#include <map>

namespace hagen::evaluation {
namespace {

struct Band {
    const char* name;
    double from_m, to_m;
};
constexpr double kInfinity = std::numeric_limits<double>::infinity();
// Altitudes are read from a file and may have any value.
constexpr std::array<Band, 6> kAltitudes{{{"below 0 m", -kInfinity, 0},
                                          {"0-2 m", 0, 2},
                                          {"2-3 m", 2, 3},
                                          {"3-5 m", 3, 5},
                                          {"5-10 m", 5, 10},
                                          {"10+ m", 10, kInfinity}}};

std::vector<Group> withoutEmpty(std::vector<Group> groups) {
    const auto is_empty = [](const Group& group) { return group.sum().returns() == 0; };
    groups.erase(std::remove_if(groups.begin(), groups.end(), is_empty), groups.end());
    return groups;
}

}  // namespace

Scores Group::sum() const {
    Scores sum;
    for (const Scores& scores : scans) sum += scores;
    return sum;
}

Group overallScores(const std::vector<ScanScores>& scans) {
    Group whole{"all", {}};
    for (const ScanScores& scan : scans) whole.scans.push_back(scan.all);
    return whole;
}

std::vector<Group> byFolder(const std::vector<ScanScores>& scans,
                            const std::vector<std::string>& folders) {
    std::vector<Group> groups;
    for (const std::string& folder : folders) groups.push_back({folder, {}});
    for (const ScanScores& scan : scans) groups.at(scan.folder).scans.push_back(scan.all);
    return groups;
}

std::vector<Group> byAltitude(const std::vector<ScanScores>& scans) {
    std::vector<Group> groups;
    for (const Band& band : kAltitudes) {
        groups.push_back({band.name, {}});
        for (const ScanScores& scan : scans) {
            if (scan.altitude_m >= band.from_m && scan.altitude_m < band.to_m) {
                groups.back().scans.push_back(scan.all);
            }
        }
    }
    return withoutEmpty(groups);
}

std::vector<Group> byRange(const std::vector<ScanScores>& scans, const RangeBands& bands) {
    std::vector<Group> groups;
    for (std::size_t band = 0; band < bands.count(); ++band) {
        groups.push_back({bands.nameOf(band), {}});
        for (const ScanScores& scan : scans) {
            if (scan.by_range[band].returns() > 0) {
                groups.back().scans.push_back(scan.by_range[band]);
            }
        }
    }
    return withoutEmpty(groups);
}

std::vector<Group> byKind(const std::vector<ScanScores>& scans) {
    std::map<std::string, Group> groups;
    for (const ScanScores& scan : scans) {
        for (const auto& [name, scores] : scan.by_kind) {
            Group& group = groups[name];
            group.name = name;
            group.scans.push_back(scores);
        }
    }
    std::vector<Group> ordered;
    for (const auto& [name, group] : groups) ordered.push_back(group);
    return ordered;
}

}  // namespace hagen::evaluation
