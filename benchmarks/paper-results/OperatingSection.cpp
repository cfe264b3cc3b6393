#include "OperatingSection.h"

#include <cmath>

#include "Rows.h"
#include "Sums.h"

namespace hagen {
namespace {

Sets realSets(const std::vector<Measured>& all) {
    return those(all, [](const DataSet& set) { return set.flights.empty(); });
}

/// One row per tolerance: the scores of each set, then the ground labelled ROU by class.
std::string toleranceTable(const Sets& sets) {
    std::vector<std::string> heads{"`ground_tolerance_m`"};
    for (const Measured* set : sets) heads.push_back(set->set.name);
    for (const Measured* set : sets) {
        if (set->set.has_vegetation) heads.push_back("ground, " + set->set.name);
    }
    Table table(heads);
    for (const std::string value : {"0.1", "0.17", "0.25", "0.4"}) {
        const std::string row = nameOf(kDefault, {"", toleranceSweep().front().key, value});
        std::vector<std::string> line{value};
        for (const Measured* set : sets) {
            const evaluation::ClassScore roi = sumOf({set}, row).roi;
            line.push_back(cell(roi.precision()) + "/" + cell(roi.recall()) + "/" +
                           cell(100 * droneSumOf({set}, row).tall.share(), 2));
        }
        for (const Measured* set : sets) {
            if (!set->set.has_vegetation) continue;
            line.push_back(cell(recallOfKind(*set, row, "road")) + "/" +
                           cell(recallOfKind(*set, row, "sidewalk")) + "/" +
                           cell(recallOfKind(*set, row, "terrain")));
        }
        table.add(line);
    }
    return table.text();
}

}  // namespace

std::vector<OperatingPoint> operatingCurve(const Measured& set, const std::string& method) {
    const std::string start = method == kDefault
                                  ? nameOf(kDefault, {"", toleranceSweep().front().key, ""})
                                  : method + ", ";
    std::vector<OperatingPoint> curve;
    for (const evaluation::MethodScores& row : set.methods) {
        if (row.name.rfind(start, 0) != 0) continue;
        const evaluation::ClassScore roi = sumOf({&set}, row.name).roi;
        curve.push_back({row.name.substr(row.name.find(", ") + 2), roi.precision(), roi.recall(),
                         droneSumOf({&set}, row.name).tall});
    }
    return curve;
}

std::vector<std::string> operatingMethods(const Measured& set) {
    std::vector<std::string> methods;
    for (const evaluation::MethodScores& row : set.methods) {
        if (row.name != kPaper && row.name.find('=') == std::string::npos)
            methods.push_back(row.name);
    }
    return methods;
}

double recallAt(double precision, const std::vector<OperatingPoint>& curve) {
    double highest = NAN;
    for (std::size_t i = 0; i < curve.size(); ++i) {
        const OperatingPoint& a = curve[i];
        if (a.precision >= precision) highest = std::fmax(highest, a.recall);
        if (i == 0) continue;
        const OperatingPoint& b = curve[i - 1];
        const double part = (precision - a.precision) / (b.precision - a.precision);
        if (part > 0 && part < 1) {
            highest = std::fmax(highest, a.recall + part * (b.recall - a.recall));
        }
    }
    return highest;
}

std::string operatingSection(const std::vector<Measured>& all) {
    const Sets sets = realSets(all);
    if (sets.empty()) return "";
    std::vector<std::string> heads{"recall: method/`default`"};
    for (const Measured* set : sets) heads.push_back(set->set.name);
    Table table(heads);
    std::string better;
    for (const std::string& method : operatingMethods(*sets.front())) {
        if (method == kDefault) continue;
        std::vector<std::string> line{method};
        int losses = 0;
        for (const Measured* set : sets) {
            const evaluation::ClassScore roi = sumOf({set}, method).roi;
            const double own = recallAt(roi.precision(), operatingCurve(*set, kDefault));
            line.push_back(boldAbove(roi.recall(), own) + "/" + boldAbove(own, roi.recall()));
            if (!(own >= roi.recall())) ++losses;
        }
        table.add(line);
        if (losses == 0) continue;
        better += (better.empty() ? ", except that of `" : ", `") + method + "` (" +
                  std::to_string(losses) + " of " + std::to_string(sets.size()) + " data sets)";
    }
    return "## Operating curve\n\n"
           "At the precision of each other method or above, `default` reaches its recall" +
           better +
           ". Choose a tolerance of 0.1 m for smooth floors (road), 0.17 m where kerbs (sidewalk) "
           "and 0.25 m where short grass (terrain) should be ground. `default` and `tuned` are "
           "in-sample.\n\n"
           "Cells: precision/recall of RoI/missed above 0.5 m [%]; ground: "
           "road/sidewalk/terrain labelled ROU.\n\n" +
           toleranceTable(sets) + table.text() +
           "![Precision over recall of RoI](results/operating_curve.svg)\n\n"
           "Circles mark the values of the other tables ([all "
           "points](results/operating_curve.csv)).\n\n";
}

CsvTables operatingTables(const std::vector<Measured>& all) {
    const Sets sets = realSets(all);
    if (sets.empty()) return {};
    Table table(
        {"data", "method", "setting", "precision of RoI", "recall of RoI", "missed above 0.5 m"});
    for (const Measured* set : sets) {
        for (const std::string& method : operatingMethods(*set)) {
            for (const OperatingPoint& point : operatingCurve(*set, method))
                table.add({set->set.name, method, point.setting, cell(point.precision),
                           cell(point.recall), missedCell(point.tall)});
        }
    }
    return {{"operating_curve.csv", table.csv()}};
}

}  // namespace hagen
