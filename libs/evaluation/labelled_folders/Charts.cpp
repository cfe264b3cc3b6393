#include "evaluation/labelled_folders/Charts.h"
#include "base/NumberText.h"
#include "base/TextStream.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <locale>
#include "convert/pictures/Gnuplot.h"

namespace hagen::evaluation {
namespace {

constexpr int kWidth_px = 900, kHeight_px = 400, kLegendWidth_px = 190;
constexpr std::size_t kMaxLines = 7;
// Colour-blind safe palette (Okabe and Ito).
constexpr std::array<const char*, kMaxLines> kColours{"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                                      "#E69F00", "#333333", "#56B4E9"};

struct Value {
    std::string label;  ///< label on the x axis
    double x, y;
    Interval interval;
};
struct Line {
    std::string name;
    std::vector<Value> values;
};
struct Panel {
    std::string title, x_title, y_title;
    std::vector<Line> lines;
    double min_y;
    bool has_labels = true;  ///< whether the x axis shows value labels instead of numbers
    bool has_lines = true;   ///< whether lines connect the values
};

/// The minimum value, rounded down, as the lower limit of adjacent panels. Intervals may extend
/// below it, because wide intervals of few obstacles would compress all values into a line.
double leastOf(const std::vector<Line>& lines) {
    double min = 0.8;
    for (const Line& line : lines) {
        for (const Value& value : line.values) {
            if (value.y < min) min = std::floor(value.y * 10) / 10;  // false for NaN
        }
    }
    return min;
}

class Chart {
 public:
    /// `panels_px`: width without the legend; `bottom`: fraction of the height for axis labels.
    Chart(std::string name, int panels_px, int panels, double bottom, bool has_legend)
        : name_(std::move(name)), has_legend_(has_legend) {
        const int legend_px = has_legend ? kLegendWidth_px : 0;
        const int width_px = panels_px + legend_px;
        text_ << "set terminal svg size " << width_px << "," << kHeight_px
              << " font 'sans,14' background '#FFFFFF'\nset output "
              << convert::gnuplotString(name_) << "\nset multiplot layout 1," << panels
              << " margins screen " << 80.0 / width_px << ", " << 1 - (legend_px + 20.0) / width_px
              << ", " << bottom << ", 0.88 spacing screen " << 90.0 / width_px << "\n";
    }

    void add(const Panel& panel) {
        writeData(panel);
        text_ << "set title '{/:Bold " << panel.title << "}'\nset xlabel "
              << convert::gnuplotString(panel.x_title) << " noenhanced\nset ylabel "
              << convert::gnuplotString(panel.y_title)
              << "\nset grid y lc rgb '#DDDDDD' lw 1 lt 1\nset tics nomirror out scale 0.5\n"
              << "set border 3 lc rgb '#333333'\nset offsets graph 0.06, graph 0.06, 0, 0\n"
              << "set yrange [" << panel.min_y << ":1]\n"
              << "set key at screen 0.995, screen 0.88 right top vertical Left reverse noenhanced "
                 "samplen 1.5 width -2\n";
        if (!has_legend_ || panel_ > 0) text_ << "unset key\n";  // one for all panels
        writeTics(panel);
        writePlot(panel);
        ++panel_;
    }

    void draw(const std::filesystem::path& folder) {
        text_ << "unset multiplot\nunset output\n";
        convert::runGnuplot(text_.str(), folder, {name_});
    }

 private:
    std::string block(std::size_t line) const {
        return "$panel" + std::to_string(panel_) + "line" + std::to_string(line);
    }

    void writeData(const Panel& panel) {
        const auto number = [&](double value) {
            if (std::isnan(value)) {
                text_ << " NaN";
            } else {
                text_ << " " << value;
            }
        };
        const std::size_t lines = panel.lines.size();
        for (std::size_t l = 0; l < lines; ++l) {
            // Shift sideways so that intervals do not overlap.
            const double shift =
                panel.has_labels
                    ? 0.08 * (static_cast<double>(l) - static_cast<double>(lines - 1) / 2)
                    : 0.0;
            text_ << block(l) << " << EOD\nNaN NaN NaN NaN\n";
            for (const Value& value : panel.lines[l].values) {
                const bool has_interval = !std::isnan(value.interval.low);
                number(value.x + shift);
                number(value.y);
                number(has_interval ? value.interval.low : value.y);
                number(has_interval ? value.interval.high : value.y);
                text_ << "\n";
            }
            text_ << "EOD\n";
        }
    }

    void writeTics(const Panel& panel) {
        if (!panel.has_labels) {
            text_ << "set xtics auto\n";
            return;
        }
        const std::vector<Value>& values = panel.lines.front().values;
        const bool are_many = values.size() > 8;
        text_ << "set xtics noenhanced " << (are_many ? "rotate by -60" : "norotate") << " (";
        for (std::size_t v = 0; v < values.size(); ++v) {
            std::string label;
            for (const char c : values[v].label) label += c == '%' ? "%%" : std::string(1, c);
            text_ << (v == 0 ? "" : ", ") << convert::gnuplotString(label) << " " << values[v].x;
        }
        text_ << ")\n";
    }

    void writePlot(const Panel& panel) {
        text_ << "plot ";
        for (std::size_t l = 0; l < panel.lines.size(); ++l) {
            const std::string colour = std::string(" lc rgb '") + kColours[l % kMaxLines] + "'";
            text_ << (l == 0 ? "" : ", ") << block(l)
                  << " using 1:2:3:4 with yerrorbars pt 7 ps 0.2 lw 0.7" << colour << " notitle, "
                  << block(l) << " using 1:2 with " << (panel.has_lines ? "linespoints" : "points")
                  << " pt 7 ps 0.6 lw 2" << colour << " title "
                  << convert::gnuplotString(panel.lines[l].name);
        }
        text_ << "\n";
    }

    std::string name_;
    bool has_legend_;
    std::size_t panel_ = 0;
    base::TextStream text_;
};

using Figure = std::function<Value(const GroupTotals&)>;
Value roiF1(const GroupTotals& group) {
    return {"", 0, group.scores.roi.f1(), group.intervals.roi.f1};
}
Value rouF1(const GroupTotals& group) {
    return {"", 0, group.scores.rou.f1(), group.intervals.rou.f1};
}
Value recall(const GroupTotals& group) {
    return {"", 0, group.scores.correct(), group.intervals.correct};
}

/// One line per method over the groups of a part.
std::vector<Line> linesOf(const Summary& summary, std::vector<GroupTotals> ScoreTotals::*part,
                          const Figure& figure) {
    std::vector<Line> lines;
    for (const MethodTotals& method : summary.methods) {
        Line line{method.name, {}};
        for (const GroupTotals& group : method.returns.*part) {
            Value value = figure(group);
            value.label = group.name;
            value.x = static_cast<double>(line.values.size());
            line.values.push_back(value);
        }
        lines.push_back(line);
    }
    return lines;
}

void drawPart(const std::filesystem::path& folder, const Summary& summary, const std::string& name,
              const std::string& x_title, std::vector<GroupTotals> ScoreTotals::*part) {
    if ((summary.methods.front().returns.*part).empty()) return;
    const std::vector<Line> roi = linesOf(summary, part, roiF1);
    const std::vector<Line> rou = linesOf(summary, part, rouF1);
    const double min = std::min(leastOf(roi), leastOf(rou));
    Chart chart(name, kWidth_px, 2, 0.2, roi.size() > 1);
    chart.add({"Region of interest", x_title, "F1", roi, min});
    chart.add({"Region of uninterest", x_title, "F1", rou, min});
    chart.draw(folder);
}

void drawKinds(const std::filesystem::path& folder, const Summary& summary) {
    const auto part = &ScoreTotals::by_kind;
    if ((summary.methods.front().returns.*part).empty()) return;
    const std::vector<Line> lines = linesOf(summary, part, recall);
    Chart chart("by_kind.svg", kWidth_px, 1, 0.3, lines.size() > 1);
    Panel panel{"Recall of each kind of object", "", "recall", lines, leastOf(lines)};
    panel.has_lines = false;
    chart.add(panel);
    chart.draw(folder);
}

/// Whether all values of a sweep are numbers; the x axis is then to scale.
bool areNumbers(const std::vector<const MethodTotals*>& methods, std::vector<double>& numbers) {
    for (const MethodTotals* method : methods) {
        const auto number = base::numberFrom<double>(method->sweep_value);
        if (!number) return false;
        numbers.push_back(*number);
    }
    return true;
}

void drawSweep(const std::filesystem::path& folder, const std::string& key,
               const std::vector<const MethodTotals*>& methods) {
    std::vector<double> numbers;
    Panel panel{"F1 over all returns", key, "F1", {{"RoI", {}}, {"ROU", {}}}, 0};
    panel.has_labels = !areNumbers(methods, numbers);
    panel.has_lines = !panel.has_labels;
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const GroupTotals& all = methods[m]->returns.all;
        Value roi = roiF1(all), rou = rouF1(all);
        roi.label = rou.label = methods[m]->sweep_value;
        roi.x = rou.x = panel.has_labels ? static_cast<double>(m) : numbers[m];
        panel.lines[0].values.push_back(roi);
        panel.lines[1].values.push_back(rou);
    }
    for (Line& line : panel.lines) {
        std::sort(line.values.begin(), line.values.end(),
                  [](const Value& a, const Value& b) { return a.x < b.x; });
    }
    panel.min_y = leastOf(panel.lines);
    Chart chart("sweep_" + key + ".svg", kWidth_px / 2, 1, 0.2, true);
    chart.add(panel);
    chart.draw(folder);
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
        drawPart(folder, summary, "by_range.svg", "range", &ScoreTotals::by_range);
        drawPart(folder, summary, "by_altitude.svg", "altitude of the sensor",
                 &ScoreTotals::by_altitude);
        drawKinds(folder, summary);
    }
    std::vector<std::pair<std::string, std::vector<const MethodTotals*>>> sweeps;
    for (const MethodTotals& method : summary.methods) {
        if (method.sweep_key.empty()) continue;
        auto sweep = std::find_if(sweeps.begin(), sweeps.end(),
                                  [&](const auto& s) { return s.first == method.sweep_key; });
        if (sweep == sweeps.end()) sweep = sweeps.insert(sweeps.end(), {method.sweep_key, {}});
        sweep->second.push_back(&method);
    }
    for (const auto& [key, methods] : sweeps) drawSweep(folder, key, methods);
}

}  // namespace hagen::evaluation
