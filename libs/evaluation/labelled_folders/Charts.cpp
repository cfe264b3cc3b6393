#include "evaluation/labelled_folders/Charts.h"
#include "base/NumberText.h"

#include <algorithm>
#include "convert/pictures/Drawing.h"

namespace hagen::evaluation {
namespace {

using base::Json;

constexpr int kWidth_px = 900, kHeight_px = 400, kLegendWidth_px = 180;
constexpr std::size_t kMaxLines = 7;

using Part = std::vector<GroupTotals> ScoreTotals::*;
struct Figure {
    double value;
    Interval interval;
};
Figure roiF1(const GroupTotals& group) { return {group.scores.roi.f1(), group.intervals.roi.f1}; }
Figure rouF1(const GroupTotals& group) { return {group.scores.rou.f1(), group.intervals.rou.f1}; }
Figure recall(const GroupTotals& group) {
    return {group.scores.correct(), group.intervals.correct};
}

/// Adds a point to a line of draw.py's chart().
void add(Json& line, double x, const Figure& figure) {
    line["x"].push_back(x);
    line["y"].push_back(figure.value);
    line["low"].push_back(figure.interval.low);
    line["high"].push_back(figure.interval.high);
}

/// One line per method over the groups of a part.
Json panelOf(const Summary& summary, const std::string& title, Part part,
             Figure (*figure)(const GroupTotals&), const std::string& y_title) {
    Json panel{{"title", title}, {"y", y_title}};
    for (const GroupTotals& group : summary.methods.front().returns.*part) {
        panel["categories"].push_back(group.name);
    }
    for (const MethodTotals& method : summary.methods) {
        Json line{{"name", method.name}};
        double x = 0;
        for (const GroupTotals& group : method.returns.*part) add(line, x++, figure(group));
        panel["lines"].push_back(line);
    }
    return panel;
}

void drawChart(const std::filesystem::path& file, int panels_px, bool has_legend,
               const Json& panels) {
    convert::Drawing({{"kind", "chart"},
                      {"file", file.string()},
                      {"width", panels_px + (has_legend ? kLegendWidth_px : 0)},
                      {"height", kHeight_px},
                      {"panels", panels}})
        .draw();
}

void drawPart(const std::filesystem::path& file, const Summary& summary, const std::string& x_title,
              Part part) {
    if ((summary.methods.front().returns.*part).empty()) return;
    Json roi = panelOf(summary, "Region of interest", part, roiF1, "F1");
    Json rou = panelOf(summary, "Region of uninterest", part, rouF1, "F1");
    roi["x"] = rou["x"] = x_title;
    drawChart(file, kWidth_px, summary.methods.size() > 1, {roi, rou});
}

void drawKinds(const std::filesystem::path& file, const Summary& summary) {
    if (summary.methods.front().returns.by_kind.empty()) return;
    Json panel =
        panelOf(summary, "Recall of each kind of object", &ScoreTotals::by_kind, recall, "recall");
    panel["ls"] = "";
    drawChart(file, kWidth_px, summary.methods.size() > 1, Json::array({panel}));
}

void drawSweep(const std::filesystem::path& file, const std::string& key,
               std::vector<const MethodTotals*> methods) {
    const auto number = [](const MethodTotals* method) {
        return base::numberFrom<double>(method->sweep_value);
    };
    Json panel{{"title", "F1 over all returns"}, {"x", key}, {"y", "F1"}};
    const bool are_numbers = std::all_of(methods.begin(), methods.end(), number);
    if (are_numbers) {
        std::sort(methods.begin(), methods.end(),
                  [&](const auto* a, const auto* b) { return number(a) < number(b); });
    } else {
        panel["ls"] = "";
        for (const MethodTotals* method : methods) {
            panel["categories"].push_back(method->sweep_value);
        }
    }
    Json roi{{"name", "RoI"}}, rou{{"name", "ROU"}};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const double x = are_numbers ? *number(methods[m]) : static_cast<double>(m);
        add(roi, x, roiF1(methods[m]->returns.all));
        add(rou, x, rouF1(methods[m]->returns.all));
    }
    panel["lines"] = {roi, rou};
    drawChart(file, kWidth_px / 2, true, Json::array({panel}));
}

}  // namespace

const base::OutputKind kCharts{
    "a folder of pictures", [](const std::filesystem::path& within) {
        const std::string name = within.filename().string();
        return within.extension() == ".svg" &&
               (name.rfind("by_", 0) == 0 || name.rfind("sweep_", 0) == 0);
    }};

void drawCharts(const std::filesystem::path& folder, const Summary& summary) {
    if (summary.methods.size() <= kMaxLines) {
        drawPart(folder / "by_range.svg", summary, "range", &ScoreTotals::by_range);
        drawPart(folder / "by_altitude.svg", summary, "altitude of the sensor",
                 &ScoreTotals::by_altitude);
        drawKinds(folder / "by_kind.svg", summary);
    }
    std::vector<std::pair<std::string, std::vector<const MethodTotals*>>> sweeps;
    for (const MethodTotals& method : summary.methods) {
        if (method.sweep_key.empty()) continue;
        auto sweep = std::find_if(sweeps.begin(), sweeps.end(),
                                  [&](const auto& s) { return s.first == method.sweep_key; });
        if (sweep == sweeps.end()) sweep = sweeps.insert(sweeps.end(), {method.sweep_key, {}});
        sweep->second.push_back(&method);
    }
    for (const auto& [key, methods] : sweeps) {
        drawSweep(folder / ("sweep_" + key + ".svg"), key, methods);
    }
}

}  // namespace hagen::evaluation
