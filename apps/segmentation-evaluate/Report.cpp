#include "Report.h"

#include "filter/OptionKeys.h"

#include <algorithm>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <set>

namespace hagen {
namespace {

using namespace evaluation;

constexpr std::size_t kMaxColumns = 5;  // methods side by side within 100 columns

std::string format(const char* pattern, ...) {
    char text[512];
    va_list values;
    va_start(values, pattern);
    std::vsnprintf(text, sizeof text, pattern, values);
    va_end(values);
    return text;
}

/// Pads text on the right or left.
std::string left(const std::string& text, std::size_t width) {
    return text + std::string(width - std::min(width, text.size()), ' ');
}
std::string right(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string trimmed(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    return line + "\n";
}

/// A number, or a dash if it is undefined.
std::string figure(double value, int digits = 4) {
    return std::isnan(value) ? "-" : format("%.*f", digits, value);
}
std::string interval(const Interval& interval) {
    return std::isnan(interval.low) ? "-" : format("%.3f-%.3f", interval.low, interval.high);
}
std::string count(std::int64_t number) { return std::to_string(number); }

std::string figuresOf(const Scores& scores) {
    std::string text;
    for (const ClassScore& score : {scores.roi, scores.rou}) {
        text += right(figure(score.precision()), 11) + right(figure(score.recall()), 8) +
                right(figure(score.f1()), 8);
    }
    return text;
}

std::size_t widthOf(const std::string& heading, const std::vector<std::string>& names) {
    std::size_t width = heading.size();
    for (const std::string& name : names) width = std::max(width, name.size());
    return width;
}

std::vector<std::string> namesOf(const std::vector<MethodTotals>& methods) {
    std::vector<std::string> names;
    for (const MethodTotals& method : methods) names.push_back(method.name);
    return names;
}

/// The scores of each method, over returns or pixels.
std::string scoreTable(const Summary& summary, ScoreTotals MethodTotals::*which) {
    const std::size_t width = widthOf("method", namesOf(summary.methods));
    std::string text = left("", width) +
                       "  RoI                        ROU                        " +
                       "95 % interval of F1\n" + left("method", width) +
                       "  precision  recall      F1  precision  recall      F1  RoI          ROU\n";
    for (const MethodTotals& method : summary.methods) {
        const GroupTotals& all = (method.*which).all;
        text += left(method.name, width) + figuresOf(all.scores) + "  " +
                left(interval(all.intervals.roi.f1), 11) + "  " + interval(all.intervals.rou.f1) +
                "\n";
    }
    return text;
}

std::string latencyTable(const Summary& summary) {
    const std::size_t width = widthOf("method", namesOf(summary.methods));
    std::string text =
        left("method", width) + "     mean +- sd           p50       p95       p99       max\n";
    for (const MethodTotals& method : summary.methods) {
        const Latency& latency = method.latency;
        text += left(method.name, width) + right(figure(latency.mean_ms, 3), 9) + " +- " +
                left(figure(latency.sd_ms, 3), 7);
        for (const double ms : {latency.p50_ms, latency.p95_ms, latency.p99_ms, latency.max_ms}) {
            text += right(figure(ms, 3), 10);
        }
        text += "\n";
    }
    return text;
}

std::string percentage(double share) { return figure(100 * share, 2); }

std::string droneTable(const Summary& summary) {
    const std::size_t width = widthOf("method", namesOf(summary.methods));
    std::string text =
        "\nWhat matters to a drone\n" + left("", width) +
        "  obstacle returns above 0.5 m  obstacles              RoI on bare ground,\n" +
        left("method", width) +
        "    missed        of         %  not detected      of   returns per scan\n";
    for (const MethodTotals& method : summary.methods) {
        const DroneScores& all = method.drone.all;
        const bool are_numbered = all.obstacles.all > 0;
        text += left(method.name, width) + right(count(all.tall.missed), 10) +
                right(count(all.tall.all), 10) + right(percentage(all.tall.share()), 10) +
                right(are_numbered ? count(all.obstacles.missed) : "-", 18) +
                right(are_numbered ? count(all.obstacles.all) : "-", 6) +
                right(figure(all.falseOnBareGroundPerScan(), 2), 17) + "\n";
    }
    return text;
}

/// The change of a score, such as "+0.12", or a dash.
std::string change(double degraded, double recorded) {
    const double points = changeInPoints(degraded, recorded);
    return std::isnan(points) ? "-" : format("%+.2f", points);
}

/// `recorded` is null for the original scans, which have no change.
std::string hardSetLine(const std::string& name, std::size_t width, const Scores& scores,
                        const Scores* recorded, const Missed& tall) {
    const auto changeOf = [&](ClassScore Scores::*c) {
        return recorded == nullptr ? "" : change((scores.*c).f1(), (recorded->*c).f1());
    };
    return left(name, width) + right(figure(scores.roi.f1()), 9) +
           right(changeOf(&Scores::roi), 9) + right(figure(scores.rou.f1()), 10) +
           right(changeOf(&Scores::rou), 9) + right(count(tall.missed), 10) +
           right(count(tall.all), 10) + right(percentage(tall.share()), 8) + "\n";
}

std::string hardSetTable(const Summary& summary, std::size_t method) {
    std::vector<std::string> names{"as recorded"};
    for (const HardSetTotals& set : summary.hard_sets) names.push_back(set.name);
    const MethodTotals& recorded = summary.methods[method];
    const std::size_t width = widthOf("degradation", names);
    std::string text = "\nOn degraded scans: " + recorded.name +
                       " (change of F1 in units of 0.01)\n" + left("", width) + left("   RoI", 22) +
                       left("ROU", 16) + "obstacle returns above 0.5 m\n" +
                       left("degradation", width) +
                       "       F1   change        F1   change    missed        of       %\n";
    const Scores& scores = recorded.returns.all.scores;
    text += hardSetLine(names[0], width, scores, nullptr, recorded.drone.all.tall);
    for (const HardSetTotals& set : summary.hard_sets) {
        const MethodTotals& own = set.methods[method];
        text += hardSetLine(set.name, width, own.returns.all.scores, &scores, own.drone.all.tall);
    }
    return text;
}

std::string hardSetTables(const Summary& summary) {
    if (summary.hard_sets.empty()) return "";
    const std::size_t methods = summary.hard_sets.front().methods.size();
    if (methods > kMaxColumns) return "\nScores on degraded scans are in --json.\n";
    std::string text;
    for (std::size_t method = 0; method < methods; ++method) text += hardSetTable(summary, method);
    return text;
}

using Part = std::vector<GroupTotals> ScoreTotals::*;
struct PartName {
    const char* title;
    const char* heading;
    Part part;
};
constexpr PartName kParts[] = {{"By range", "range", &ScoreTotals::by_range},
                               {"By altitude of the sensor", "altitude", &ScoreTotals::by_altitude},
                               {"By folder", "folder", &ScoreTotals::by_folder}};

std::vector<std::string> namesOf(const std::vector<GroupTotals>& groups) {
    std::vector<std::string> names;
    for (const GroupTotals& group : groups) names.push_back(group.name);
    return names;
}

std::string partTable(const PartName& part, const std::vector<GroupTotals>& groups) {
    const std::size_t width = widthOf(part.heading, namesOf(groups));
    std::string text =
        "\n" + std::string(part.title) + "\n" + left("", width) + "         returns of   " +
        "          RoI                        ROU\n" + left(part.heading, width) + "  scans" +
        "       RoI       ROU  precision  recall      F1  precision  recall      F1\n";
    for (const GroupTotals& group : groups) {
        const Scores& scores = group.scores;
        text += left(group.name, width) + right(count(static_cast<std::int64_t>(group.scans)), 7) +
                right(count(scores.roi.hits + scores.roi.misses), 10) +
                right(count(scores.rou.hits + scores.rou.misses), 10) + figuresOf(scores) + "\n";
    }
    return text;
}

/// Returns the label of a class: RoI or ROU, or both if ground-truth labels differ within the
/// class.
std::string labelOf(const Scores& scores) {
    const bool is_roi = scores.roi.hits + scores.roi.misses > 0;
    const bool is_rou = scores.rou.hits + scores.rou.misses > 0;
    return is_roi && is_rou ? "both" : is_roi ? "RoI" : "ROU";
}

std::string kindTable(const std::vector<GroupTotals>& kinds) {
    const std::size_t width = widthOf("class", namesOf(kinds));
    std::string text = "\nBy object class\n" + left("class", width) +
                       "  is    scans   returns     found  recall  95 % interval\n";
    for (const GroupTotals& kind : kinds) {
        const std::int64_t found = kind.scores.roi.hits + kind.scores.rou.hits;
        text += left(kind.name, width) + "  " + left(labelOf(kind.scores), 4) +
                right(count(static_cast<std::int64_t>(kind.scans)), 7) +
                right(count(kind.scores.returns()), 10) + right(count(found), 10) +
                right(figure(kind.scores.correct()), 8) + "  " + interval(kind.intervals.correct) +
                "\n";
    }
    return text;
}

/// Method names shortened to column width: their beginnings, or their ends if beginnings are
/// ambiguous.
std::vector<std::string> headsOf(const Summary& summary, std::size_t width) {
    std::vector<std::string> begins, ends;
    for (const MethodTotals& method : summary.methods) {
        const std::string& name = method.name;
        begins.push_back(name.substr(0, width));
        ends.push_back(name.size() <= width ? name : ".." + name.substr(name.size() - (width - 2)));
    }
    const bool are_unique =
        std::set<std::string>(begins.begin(), begins.end()).size() == begins.size();
    return are_unique ? begins : ends;
}

/// One row per group, one column per method. `groupsOf` returns the groups of a method.
template <class Groups, class Cell>
std::string matrix(const std::string& title, const std::string& heading, const Summary& summary,
                   Groups groupsOf, Cell cell) {
    std::vector<std::string> groups;
    for (const auto& group : groupsOf(summary.methods.front())) groups.push_back(group.name);
    if (groups.empty()) return "";
    const std::size_t width = widthOf(heading, groups);
    std::string heads = left(heading, width), text = "\n" + title + "\n";
    for (const std::string& head : headsOf(summary, 15)) heads += "  " + left(head, 15);
    text += trimmed(heads);
    for (std::size_t g = 0; g < groups.size(); ++g) {
        std::string line = left(groups[g], width);
        for (const MethodTotals& method : summary.methods) {
            line += "  " + left(cell(groupsOf(method)[g]), 15);
        }
        text += trimmed(line);
    }
    return text;
}

std::string comparison(const Summary& summary) {
    std::string text;
    const auto f1 = [](const GroupTotals& group) {
        return figure(group.scores.roi.f1(), 3) + " / " + figure(group.scores.rou.f1(), 3);
    };
    const auto returns = [](Part part) {
        return [part](const MethodTotals& method) -> const auto& { return method.returns.*part; };
    };
    for (const PartName& part : kParts) {
        text += matrix(std::string(part.title) + ": F1 of RoI / ROU", part.heading, summary,
                       returns(part.part), f1);
    }
    text += matrix("By object class: recall", "class", summary, returns(&ScoreTotals::by_kind),
                   [](const GroupTotals& group) { return figure(group.scores.correct()); });
    return text;
}

/// The missed obstacle returns above 0.5 m by part, such as "12 of 3456".
std::string missedParts(const Summary& summary) {
    using Groups = std::vector<MissedGroup> DroneTotals::*;
    const auto table = [&](const std::string& by, const std::string& heading, Groups part) {
        return matrix(
            "Missed obstacle returns above 0.5 m, by " + by, heading, summary,
            [part](const MethodTotals& method) -> const auto& { return method.drone.*part; },
            [](const MissedGroup& group) {
                return count(group.missed.missed) + " of " + count(group.missed.all);
            });
    };
    return table("range", "range", &DroneTotals::by_range) +
           table("object class", "class", &DroneTotals::by_kind);
}

std::string partsOf(const ScoreTotals& scores) {
    std::string text;
    for (const PartName& part : kParts) {
        if (!(scores.*part.part).empty()) text += partTable(part, scores.*part.part);
    }
    if (!scores.by_kind.empty()) text += kindTable(scores.by_kind);
    return text;
}

/// Recovered sensors, and options changed by recordings, with one line per folder.
std::string sensorsOf(const Summary& summary) {
    std::string text;
    for (std::size_t f = 0; f < summary.folders.size(); ++f) {
        const std::string of = " of " + summary.folder_names[f] + ": ";
        if (!summary.sensor_texts[f].empty()) {
            text += "sensor" + of + summary.sensor_texts[f] + "\n";
        }
        std::string changed;
        for (const OptionKey& key : optionKeys()) {
            const std::string value = textOf(key, summary.folder_settings[f].options);
            if (value == textOf(key, summary.settings.options)) continue;
            changed += (changed.empty() ? "" : ", ") + key.name + " " + value;
        }
        if (!changed.empty()) text += "settings" + of + changed + " (of the recording)\n";
    }
    return text.empty() ? "" : text + "\n";
}

}  // namespace

std::string reportOf(const Summary& summary) {
    const bool has_pixels = summary.methods.front().pixels.all.scans > 0;
    std::string text =
        format("%zu scans of %zu folder%s, returns up to %g m: %lld\n\n", summary.scans,
               summary.folders.size(), summary.folders.size() == 1 ? "" : "s",
               static_cast<double>(summary.range.max_range_m),
               static_cast<long long>(summary.methods.front().returns.all.scores.returns()));
    text += sensorsOf(summary);
    text += scoreTable(summary, &MethodTotals::returns);
    if (has_pixels) {
        text += format("\nIn the camera image, one return per pixel: %lld pixels\n",
                       static_cast<long long>(summary.methods.front().pixels.all.scores.returns()));
        text += scoreTable(summary, &MethodTotals::pixels);
    }
    text += "\nRun time of segmentation only, ms per scan\n" + latencyTable(summary);
    text += droneTable(summary) + hardSetTables(summary);
    const std::size_t methods = summary.methods.size();
    if (methods == 1) return text + missedParts(summary) + partsOf(summary.methods.front().returns);
    if (methods <= kMaxColumns) return text + missedParts(summary) + comparison(summary);
    return text + "\nScores by range, altitude, folder and class are in --json.\n";
}

}  // namespace hagen
