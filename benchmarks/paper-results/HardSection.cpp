#include "HardSection.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include "evaluation/labelled_folders/Summary.h"

#include "Rows.h"
#include "Sums.h"
#include "support/Tables.h"

namespace hagen {
namespace {

/// The scores of `default` with one degradation of one or more sets.
struct Degraded {
    std::string name;
    evaluation::Scores scores;
    evaluation::Missed missed;
    double roi_points = NAN, rou_points = NAN;  ///< change of F1
};

/// The degraded sets by name; the simulated sets are merged.
std::vector<std::pair<std::string, Sets>> degradedData(const std::vector<Measured>& all) {
    std::vector<std::pair<std::string, Sets>> data;
    for (const auto& [name, sets] : mainData(all)) {
        if (!sets.front()->hard_sets.empty()) data.push_back({name, sets});
    }
    return data;
}

std::vector<Degraded> degradedOf(const Sets& sets) {
    const evaluation::Scores clean = sumOf(sets, kDefault);
    std::vector<Degraded> all;
    for (std::size_t d = 0; d < sets.front()->hard_sets.size(); ++d) {
        Degraded one;
        one.name = sets.front()->hard_sets[d].name;
        for (const Measured* set : sets) {
            const evaluation::MethodScores& method = set->hard_sets.at(d).methods.front();
            for (const evaluation::ScanScores& scan : method.returns) one.scores += scan.all;
            for (const evaluation::DroneScores& scan : method.drone) one.missed += scan.tall;
        }
        one.roi_points = evaluation::changeInPoints(one.scores.roi.f1(), clean.roi.f1());
        one.rou_points = evaluation::changeInPoints(one.scores.rou.f1(), clean.rou.f1());
        all.push_back(one);
    }
    const auto order = [](const Degraded& one) {
        return std::isnan(one.roi_points) ? INFINITY : one.roi_points;
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const Degraded& a, const Degraded& b) { return order(a) < order(b); });
    return all;
}

bool isCostly(double points) { return points < -kCostly_points; }  // false for NaN

std::string points(double value) {
    if (std::isnan(value)) return "-";
    char text[32];
    std::snprintf(text, sizeof text, "%+.2f", value);
    return text;
}

std::string marked(double value) {
    return isCostly(value) ? "**" + points(value) + "**" : points(value);
}

constexpr std::size_t kShown = 5;

void addRows(Table& table, const std::string& name, const Sets& sets, std::size_t count) {
    const evaluation::Scores clean = sumOf(sets, kDefault);
    table.add({name, "as recorded", pairCell(clean.roi.f1(), clean.rou.f1()), "", "",
               missedCell(droneSumOf(sets, kDefault).tall)});
    for (const Degraded& one : degradedOf(sets)) {
        if (count-- == 0) return;
        const std::string mark = isCostly(one.roi_points) ? "**" : "";
        table.add({name, mark + "`" + one.name + "`" + mark,
                   pairCell(one.scores.roi.f1(), one.scores.rou.f1()), marked(one.roi_points),
                   marked(one.rou_points), missedCell(one.missed)});
    }
}

/// The costliest degradations of each set.
Table hardTable(const std::vector<std::pair<std::string, Sets>>& data, std::size_t count) {
    Table table({"data", "degradation", "F1 of RoI / ROU", "change of RoI", "change of ROU",
                 "missed above 0.5 m"});
    for (const auto& [name, sets] : data) addRows(table, name, sets, count);
    return table;
}

/// The degradations of one class, such as "- `rain=3`: real, 16 beams (-2.10); ...".
std::string costlyList(const std::vector<std::pair<std::string, Sets>>& data,
                       double Degraded::*change) {
    std::vector<std::string> order;
    std::map<std::string, std::string> where;
    for (const auto& [name, sets] : data) {
        for (const Degraded& one : degradedOf(sets)) {
            if (!isCostly(one.*change)) continue;
            std::string& list = where[one.name];
            if (list.empty()) order.push_back(one.name);
            list += (list.empty() ? "" : "; ") + name + " (" + points(one.*change) + ")";
        }
    }
    std::string text;
    for (const std::string& name : order) text += "- `" + name + "`: " + where[name] + "\n";
    return (text.empty() ? "- none\n" : text) + "\n";
}

}  // namespace

std::string hardSection(const std::vector<Measured>& all) {
    const auto data = degradedData(all);
    if (data.empty()) return "";
    return "## Hard sets\n\n"
           "Scores of `default` on degraded copies of the scans "
           "([degradations](evaluation.md#hard-sets)). Changes in F1 are in units of 0.01.\n\n"
           "Degradations that reduce the F1 of RoI by more than " +
           cell(kCostly_points, 1) + " points:\n\n" + costlyList(data, &Degraded::roi_points) +
           "The F1 of ROU:\n\n" + costlyList(data, &Degraded::rou_points) + "The " +
           std::to_string(kShown) +
           " that reduce the F1 of RoI most ([all](results/hard.csv)):\n\n" +
           hardTable(data, kShown).text();
}

CsvTables hardTables(const std::vector<Measured>& all) {
    const auto data = degradedData(all);
    if (data.empty()) return {};
    return {{"hard.csv", hardTable(data, std::string::npos).csv()}};
}

}  // namespace hagen
