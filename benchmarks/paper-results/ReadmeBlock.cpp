#include "ReadmeBlock.h"

#include <stdexcept>

#include "Sums.h"
#include "selection/SelectionTables.h"
#include "support/Tables.h"

namespace hagen {
namespace {

std::string leftOutText(const std::optional<selection::Record>& record) {
    if (!record) return "";
    return "Held-out real drives (settings chosen without them), means over drives:\n\n" +
           selection::meanTable(*record);
}

std::string shareCell(const evaluation::Missed& missed) {
    return missed.all == 0 ? "-" : cell(100 * missed.share(), 2) + " %";
}

}  // namespace

std::string readmeBlock(const std::vector<Measured>& all,
                        const std::optional<selection::Record>& record) {
    std::vector<std::pair<std::string, Sets>> data;
    for (const auto& item : mainData(all)) {
        if (item.first == "real, 16 beams" || item.second.front()->set.is_altitude)
            data.push_back(item);
    }
    std::vector<std::string> heads{"method"};
    for (const auto& [name, sets] : data) {
        heads.insert(heads.end(),
                     {name + ": F1 of RoI / ROU", "missed", "nothing found", "false RoI"});
    }
    Table table(heads);
    for (const std::string& method : headlineNames(all)) {
        std::vector<std::string> line{method};
        for (const auto& [name, sets] : data) {
            const evaluation::Scores scores = sumOf(sets, method);
            const evaluation::DroneScores drone = droneSumOf(sets, method);
            line.insert(line.end(),
                        {pairCell(scores.roi.f1(), scores.rou.f1()), shareCell(drone.tall),
                         shareCell(drone.obstacles), cell(drone.falseOnBareGroundPerScan(), 1)});
        }
        table.add(line);
    }
    return table.text() +
           "Missed: obstacle returns more than 0.5 m above the ground that are not RoI. Nothing "
           "found: obstacles without a single RoI return. False RoI: RoI returns per scan on bare "
           "ground. `default` and the `tuned` methods were tuned on these real scans.\n\n" +
           leftOutText(record);
}

std::string withBlock(const std::string& text, const std::string& block) {
    const std::string first = "<!-- results:", last = "<!-- end of results -->";
    const std::size_t begin = text.find(first);
    const std::size_t line_end = text.find('\n', begin);
    const std::size_t end = text.find(last);
    const bool is_marked = begin != std::string::npos && line_end != std::string::npos &&
                           end != std::string::npos && line_end < end &&
                           text.find(first, begin + 1) == std::string::npos &&
                           text.find(last, end + 1) == std::string::npos;
    if (!is_marked) {
        throw std::runtime_error("needs one line '" + first + " ... -->' and, below it, one '" +
                                 last + "'");
    }
    return text.substr(0, line_end + 1) + "\n" + block + text.substr(end);
}

}  // namespace hagen
