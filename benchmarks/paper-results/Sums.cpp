#include "Sums.h"

#include <cmath>
#include "evaluation/Breakdown.h"

namespace hagen {

std::vector<evaluation::ScanScores> scansOf(const Sets& sets, const std::string& row,
                                            ScoreList list) {
    std::vector<evaluation::ScanScores> scans;
    for (const Measured* set : sets) {
        const evaluation::MethodScores* method = set->row(row);
        if (method == nullptr) return {};
        scans.insert(scans.end(), (method->*list).begin(), (method->*list).end());
    }
    return scans;
}

evaluation::Scores sumOf(const Sets& sets, const std::string& row, ScoreList list) {
    return evaluation::overallScores(scansOf(sets, row, list)).sum();
}

std::vector<evaluation::Scores> folderSums(const Measured& measured, const std::string& row) {
    std::vector<evaluation::Scores> sums;
    for (const evaluation::Group& folder :
         evaluation::byFolder(scansOf({&measured}, row), measured.folders))
        sums.push_back(folder.sum());
    return sums;
}

evaluation::DroneScores droneSumOf(const Sets& sets, const std::string& row) {
    evaluation::DroneScores sum;
    for (const Measured* set : sets) {
        const evaluation::MethodScores* method = set->row(row);
        if (method == nullptr) return {};
        for (const evaluation::DroneScores& scan : method->drone) sum += scan;
    }
    return sum;
}

double recallOfKind(const Measured& set, const std::string& row, const std::string& kind) {
    for (const evaluation::Group& group : evaluation::byKind(scansOf({&set}, row))) {
        if (group.name == kind) return group.sum().correct();
    }
    return NAN;
}

Sets those(const std::vector<Measured>& all, bool (*choose)(const DataSet&)) {
    Sets sets;
    for (const Measured& measured : all) {
        if (choose(measured.set)) sets.push_back(&measured);
    }
    return sets;
}

std::vector<std::string> headlineNames(const std::vector<Measured>& all) {
    std::vector<std::string> names;
    for (const evaluation::MethodScores& method : all.front().methods) {
        if (method.name.find('=') == std::string::npos) names.push_back(method.name);
    }
    return names;
}

std::vector<std::pair<std::string, Sets>> mainData(const std::vector<Measured>& all) {
    std::vector<std::pair<std::string, Sets>> data;
    const Sets low = those(all, [](const DataSet& set) { return set.is_altitude; });
    for (const Measured& measured : all) {
        if (!measured.set.has_all_rows) continue;
        if (!measured.set.is_altitude) {
            data.push_back({measured.set.name, {&measured}});
        } else if (&measured == low.front()) {
            data.push_back({"simulated, 1.5 to 4 m", low});
        }
    }
    return data;
}

}  // namespace hagen
