#include "Document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include "convert/pictures/Drawing.h"

#include "support/Processor.h"
#include "support/Tables.h"

namespace hagen {
namespace {

const std::string kPaper = "paper pipeline", kDefault = "default pipeline", kMrpt = "mrpt decode";

std::string microseconds(double ms) { return cell(1e3 * ms, ms < 0.01 ? 1 : 0); }

double medianOf(const Performance& p, const std::string& sensor, const std::string& what) {
    const TimedRow* row = find(p.rows, sensor, what);
    return row == nullptr ? NAN : row->latency.p50_ms;
}

bool isGrid(const std::string& sensor) { return sensor.find(" x ") != std::string::npos; }

std::vector<std::string> sensorsOf(const Performance& p) {
    std::vector<std::string> sensors;
    for (const TimedRow& row : p.rows) {
        const bool is_new = std::find(sensors.begin(), sensors.end(), row.sensor) == sensors.end();
        if (is_new && !isGrid(row.sensor)) sensors.push_back(row.sensor);
    }
    return sensors;
}

/// "1.59 to 2.37": the default pipeline's median over another pipeline's, across the sensors.
std::string defaultOver(const Performance& p, const std::string& what) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::string& sensor : sensorsOf(p)) {
        const double ratio = medianOf(p, sensor, kDefault) / medianOf(p, sensor, what);
        low = std::fmin(low, ratio);  // skips NaN
        high = std::fmax(high, ratio);
    }
    return cell(low, 2) + " to " + cell(high, 2);
}

std::string wholeSection(const Performance& p) {
    Table table({"sensor", "", "median", "p99", "/ mrpt decode", "allocations"});
    for (const std::string& sensor : sensorsOf(p)) {
        for (const std::string& what :
             {kMrpt, kPaper, kDefault, std::string("zermas ground fit")}) {
            const TimedRow* row = find(p.rows, sensor, what);
            if (row == nullptr) continue;
            const evaluation::Latency& t = row->latency;
            table.add({sensor, "`" + what + "`", microseconds(t.p50_ms), microseconds(t.p99_ms),
                       cell(t.p50_ms / medianOf(p, sensor, kMrpt), 2), cell(row->allocations, 1)});
        }
    }
    return "## From packets to labels\n\n"
           "Microseconds per scan on one core, from raw packets to one label per return and index "
           "lists. MRPT does not support the packets of an HDL-64E; its rows start from "
           "coordinates. `mrpt decode` is MRPT's `generatePointCloud()`, which decodes half of the "
           "scan. `zermas ground fit` starts from decoded returns. `VLP-16` is a real scan; the "
           "others are four simulated scans each.\n\n" +
           table.text();
}

std::string stageSection(const Performance& p) {
    const std::vector<std::string> sensors = sensorsOf(p);
    std::vector<std::string> heads{"median, microseconds"};
    heads.insert(heads.end(), sensors.begin(), sensors.end());
    Table table(heads);
    for (const TimedRow& row : p.rows) {
        const bool is_whole = row.what == "floor" || row.what == kMrpt || row.what == kPaper ||
                              row.what == kDefault || row.what == "zermas ground fit";
        if (row.sensor != sensors.front() || is_whole) continue;
        std::vector<std::string> line{row.what};
        for (const std::string& sensor : sensors) {
            line.push_back(microseconds(medianOf(p, sensor, row.what)));
        }
        table.add(line);
    }
    return "## Each stage\n\n"
           "The paper's stages run with the paper's settings, `own` stages with the default "
           "settings.\n\n" +
           table.text();
}

std::string growthTable(const Performance& p, const std::string& what_grows,
                        const std::vector<std::pair<double, std::string>>& sizes) {
    Table table({what_grows, "paper, microseconds", "default, microseconds"});
    std::vector<double> x, papers, ours;
    for (const auto& [size, sensor] : sizes) {
        x.push_back(size);
        papers.push_back(medianOf(p, sensor, kPaper));
        ours.push_back(medianOf(p, sensor, kDefault));
        table.add({sensor, microseconds(papers.back()), microseconds(ours.back())});
    }
    table.add({"fitted exponent", cell(exponentOf(x, papers), 2), cell(exponentOf(x, ours), 2)});
    return table.text();
}

std::string growthSection(const Performance& p) {
    return "## Scaling\n\n"
           "Run time from coordinates to labels by image size, for one simulated orchard scan "
           "per size. An exponent of 1 means that run time is proportional to size.\n\n" +
           growthTable(
               p, "beams x columns",
               {{435, "16 x 435"}, {870, "16 x 870"}, {1740, "16 x 1740"}, {3480, "16 x 3480"}}) +
           growthTable(p, "beams x columns",
                       {{16, "16 x 870"}, {32, "32 x 870"}, {64, "64 x 870"}, {128, "128 x 870"}});
}

std::string latencySection(const Performance& p) {
    Table table({"settings", "scans", "p50", "p95", "p99", "max"});
    for (const auto& [settings, t] : p.packets_to_labels) {
        table.add({settings, std::to_string(t.runs), microseconds(t.p50_ms), microseconds(t.p95_ms),
                   microseconds(t.p99_ms), microseconds(t.max_ms)});
    }
    return "## Latency\n\n"
           "Microseconds from a scan's last packet to its labels, over a simulated flight with a "
           "VLP-16. `rawlog-segment --stats` reports them for a log.\n\n" +
           table.text();
}

std::string flightSection(const Performance& p) {
    const std::size_t scans = p.table.returns.size();
    const std::size_t returns =
        std::accumulate(p.table.returns.begin(), p.table.returns.end(), std::size_t{0});
    Table table({"`" + p.table.scenario + "`", "mean +- sd [ms]", "p50", "p99", "max"});
    for (const auto& method : p.table.methods) {
        const evaluation::Latency t = evaluation::latencyOf(method.runs_ms);
        table.add({method.name, cell(t.mean_ms) + " +- " + cell(t.sd_ms), cell(t.p50_ms),
                   cell(t.p99_ms), cell(t.max_ms)});
    }
    return "## Comparison with other methods\n\n"
           "A simulated flight of " +
           std::to_string(scans) + " VLP-16 scans of " +
           std::to_string(returns / std::max<std::size_t>(scans, 1)) +
           " returns on average. The methods start from returns with known beam indices. The "
           "paper reports 25 ms per scan on a laptop.\n\n" +
           table.text() + "Three flights of " + std::to_string(p.chart.front().returns.size()) +
           " scans, medians of ten scans:\n\n![Run time along three "
           "flights](performance/by_flight.svg)\n\n";
}

std::string conversionSection(const Performance& p) {
    if (p.conversions.empty()) return "";
    const ConversionTimes& first = p.conversions.front();
    Table table({"settings", "jobs", "conversion [s]", "times real time", "peak memory [MB]"});
    Table parts(
        {"CPU time per scan [ms]", "reading", "packets to labels", "clouds and writing", "total"});
    for (const ConversionTimes& t : p.conversions) {
        table.add({t.settings, std::to_string(t.jobs), cell(t.conversion_s, 2),
                   cell(t.flight_s / t.conversion_s, 1), cell(t.peak_megabytes, 0)});
        if (t.jobs > 1) continue;
        parts.add({t.settings, cell(t.reading_ms, 2), cell(t.packets_to_labels_ms, 2),
                   cell(t.cpu_ms - t.reading_ms - t.packets_to_labels_ms, 2), cell(t.cpu_ms, 2)});
    }
    return "## Converting a log\n\n"
           "`rawlog-segment` on " +
           std::to_string(first.scans) + " simulated VLP-16 scans, " + cell(first.flight_s, 0) +
           " s of flight. Reading includes the process that reads ahead.\n\n" + table.text() +
           parts.text();
}

std::string provenanceSection(const Performance& p) {
    Table table({"", ""});
    table.add({"command",
               std::string("`scripts/measure-performance") + (p.is_quick ? " --quick`" : "`")});
    table.add({"hagen", std::string(HAGEN_VERSION) + ", " + p.revision});
    table.add({"MRPT", HAGEN_MRPT_VERSION});
    table.add({"compiler", HAGEN_COMPILER});
    table.add({"processor", processor()});
    return "## Provenance\n\n" + table.text();
}

std::vector<double> mediansOfTen(const std::vector<double>& values) {
    std::vector<double> medians;
    for (std::size_t first = 0; first + 10 <= values.size(); first += 10) {
        std::array<double, 10> ten;
        std::copy_n(values.begin() + static_cast<std::ptrdiff_t>(first), 10, ten.begin());
        std::sort(ten.begin(), ten.end());
        medians.push_back(0.5 * (ten[4] + ten[5]));
    }
    return medians;
}

}  // namespace

std::string documentOf(const Performance& performance) {
    return "<!-- Made by scripts/measure-performance, which replaces it. -->\n"
           "# Performance\n\n"
           "From packets to labels, the default pipeline takes " +
           defaultOver(performance, kPaper) + " times as long as the paper's and " +
           defaultOver(performance, kMrpt) +
           " times as long as MRPT's decoder, depending on the sensor. Each table is from one run "
           "on one machine.\n\n" +
           std::string(performance.is_quick
                           ? "**A quick run, to check that it works: do not cite.**\n\n"
                           : "") +
           wholeSection(performance) + stageSection(performance) + growthSection(performance) +
           latencySection(performance) + flightSection(performance) +
           conversionSection(performance) + provenanceSection(performance);
}

void drawFlights(const std::filesystem::path& folder, const std::vector<FlightTimes>& flights) {
    base::Json panels;
    for (const FlightTimes& flight : flights) {
        base::Json panel{{"title", flight.scenario}, {"y", "run time [ms]"}, {"log", "y"}};
        if (&flight == &flights.back()) panel["x"] = "scan";
        for (const auto& method : flight.methods) {
            const std::vector<double> medians = mediansOfTen(method.runs_ms);
            std::vector<double> scans;
            for (std::size_t i = 0; i < medians.size(); ++i) {
                scans.push_back(10 * static_cast<double>(i) + 5);
            }
            panel["lines"].push_back({{"name", method.name}, {"x", scans}, {"y", medians}});
        }
        panels.push_back(panel);
    }
    convert::Drawing({{"kind", "chart"},
                      {"file", (folder / "by_flight.svg").string()},
                      {"width", 1100},
                      {"height", 300 * flights.size()},
                      {"columns", 1},
                      {"panels", panels}})
        .draw();
}

}  // namespace hagen
