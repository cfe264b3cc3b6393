#include "Figures.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <locale>
#include <sstream>
#include "convert/pictures/Gnuplot.h"

#include "Rows.h"

namespace hagen {
namespace {

struct Point {
    double x, y;
};
struct Line {
    std::string name;
    std::vector<Point> points;
};

// Colour-blind safe palette (Okabe and Ito) and point shapes.
constexpr std::array<const char*, 6> kColours{"#D55E00", "#0072B2", "#009E73",
                                              "#CC79A7", "#E69F00", "#333333"};
constexpr std::array<int, 6> kShapes{7, 5, 9, 11, 13, 4};

bool isDrawn(const std::string& row) {
    const bool is_tuned = row.find(" tuned") != std::string::npos;
    const bool is_varied = row.find('=') != std::string::npos;
    return !is_tuned && !is_varied;
}

std::string header(const std::string& file, int width_px, int height_px) {
    std::ostringstream text;
    text << "set terminal svg size " << width_px << "," << height_px
         << " font 'sans,14' background '#FFFFFF'\nset output " << convert::gnuplotString(file)
         << "\nset grid y lc rgb '#DDDDDD' lw 1 lt 1\nset tics nomirror out scale 0.5\n"
         << "set border 3 lc rgb '#333333'\n";
    return text.str();
}

std::string number(double value) {
    std::ostringstream text;
    text.imbue(std::locale::classic());
    text << value;
    return text.str();
}

/// Data blocks and their plot command.
std::string plot(const std::vector<Line>& lines, const std::string& style) {
    std::ostringstream data, command;
    data.imbue(std::locale::classic());
    for (std::size_t l = 0; l < lines.size(); ++l) {
        data << "$line" << l << " << EOD\nNaN NaN\n";
        for (const Point& point : lines[l].points) {
            if (std::isnan(point.y)) {
                data << point.x << " NaN\n";
            } else {
                data << point.x << " " << point.y << "\n";
            }
        }
        data << "EOD\n";
        command << (l == 0 ? "plot " : ", ") << "$line" << l << " using 1:2 with " << style
                << " pt " << kShapes[l % kShapes.size()] << " lc rgb '"
                << kColours[l % kColours.size()] << "' title "
                << convert::gnuplotString(lines[l].name);
    }
    return data.str() + command.str() + "\n";
}

/// Returns the part of a flight's folder name that identifies its scenario.
std::string scenarioOf(const std::string& folder, bool is_simulated) {
    return is_simulated ? folder.substr(0, folder.rfind('-', folder.rfind('-') - 1)) : folder;
}

/// F1 of RoI over the scans of a set; scenarios are marked below the axis.
std::string scanPanel(const Measured& measured) {
    std::vector<Line> lines;
    for (const evaluation::MethodScores& method : measured.methods) {
        if (!isDrawn(method.name)) continue;
        Line line{method.name, {}};
        for (const evaluation::ScanScores& scan : method.returns) {
            line.points.push_back({static_cast<double>(line.points.size()), scan.all.roi.f1()});
        }
        lines.push_back(line);
    }
    double min = 0.8;
    for (const Line& line : lines) {
        for (const Point& point : line.points) {
            if (point.y < min) min = std::floor(point.y * 10) / 10;  // false for NaN
        }
    }
    std::string tics, last;
    const std::vector<evaluation::ScanScores>& scans = measured.methods.front().returns;
    for (std::size_t s = 0; s < scans.size(); ++s) {
        const std::string name =
            scenarioOf(measured.folders[scans[s].folder], !measured.set.flights.empty());
        if (name == last) continue;
        last = name;
        tics += (tics.empty() ? "" : ", ") + convert::gnuplotString(name) + " " + std::to_string(s);
    }
    return "set title " + convert::gnuplotString(measured.set.name) +
           " noenhanced\nset xtics noenhanced (" + tics + ")\nset yrange [" + number(min) +
           ":1]\nset xrange [-1:" + std::to_string(scans.size()) + "]\n" +
           plot(lines, "linespoints lw 1 ps 0.4");
}

void drawScans(const std::filesystem::path& folder, const std::vector<Measured>& scores) {
    std::vector<std::string> panels;
    for (const Measured& measured : scores) {
        const bool is_real = measured.set.flights.empty() && measured.set.has_all_rows;
        const bool is_timed_flight = measured.set.is_altitude && measured.set.is_timed;
        if ((is_real && measured.set.preset == "vlp16.yaml") || is_timed_flight) {
            panels.push_back(scanPanel(measured));
        }
    }
    const std::string file = "by_scan.svg";
    std::string script = header(file, 1100, 360 * static_cast<int>(panels.size())) +
                         "set grid x lc rgb '#DDDDDD' lw 1 lt 1\nset ylabel 'F1 of RoI'\n"
                         "set key outside right top noenhanced samplen 1.5\n"
                         "set multiplot layout " +
                         std::to_string(panels.size()) + ",1\n";
    for (const std::string& panel : panels) script += panel;
    convert::runGnuplot(script + "unset multiplot\nunset output\n", folder, {file});
}

void drawTimes(const std::filesystem::path& folder, const std::vector<Measured>& times) {
    std::vector<Line> lines;
    for (const evaluation::MethodScores& method : times.front().methods) {
        if (!isDrawn(method.name)) continue;
        Line line{method.name, {}};
        for (const Measured& measured : times) {
            const std::vector<double>& latency_ms = measured.row(method.name)->latency_ms;
            for (std::size_t s = 0; s < latency_ms.size(); ++s) {
                line.points.push_back(
                    {static_cast<double>(measured.returns[s]) / 1000, latency_ms[s]});
            }
        }
        lines.push_back(line);
    }
    double min = INFINITY, max = 0;
    for (const Point& point : lines.front().points) {
        min = std::min(min, point.x);
        max = std::max(max, point.x);
    }
    const std::string file = "by_returns.svg";
    convert::runGnuplot(
        header(file, 1100, 480) +
            "set logscale xy\nset xtics (5, 10, 20, 30, 50, 70, 100, 150, 200)\nset xrange [" +
            number(0.9 * min) + ":" + number(1.1 * max) + "]\n" +
            "set xlabel 'returns of the scan, in thousands'\n"
            "set ylabel 'run time [ms]'\n"
            "set key outside right top noenhanced samplen 1.5\n" +
            plot(lines, "points ps 0.6") + "unset output\n",
        folder, {file});
}

}  // namespace

void drawResults(const std::filesystem::path& folder, const std::vector<Measured>& scores,
                 const std::vector<Measured>& times) {
    drawScans(folder, scores);
    drawTimes(folder, times);
}

}  // namespace hagen
