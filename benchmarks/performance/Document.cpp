#include "Document.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <numeric>
#include "convert/pictures/Drawing.h"

#include "StageRows.h"
#include "support/Processor.h"
#include "support/Tables.h"

namespace hagen {
namespace {

std::string microseconds(double ms) { return cell(1e3 * ms, ms < 0.01 ? 1 : 0); }

double medianOf(const Performance& p, const std::string& sensor, const std::string& what) {
    const TimedRow* row = find(p.rows, sensor, what);
    return row == nullptr ? NAN : row->warm.p50_ms;
}

double nsPerPixel(const TimedRow& row) { return 1e6 * row.warm.p50_ms / row.pixels; }

/// The rows of a pipeline or stage, one per sensor.
std::vector<TimedRow> rowsOf(const Performance& p, const std::string& what) {
    std::vector<TimedRow> rows;
    std::copy_if(p.rows.begin(), p.rows.end(), std::back_inserter(rows),
                 [&](const TimedRow& row) { return row.what == what; });
    return rows;
}

std::string summary(const Performance& p) {
    std::string sensors, ours, fast, at_10_hz, at_20_hz;
    std::vector<double> pixels, times_ms;
    for (const TimedRow& row : rowsOf(p, kDefaultPipeline)) {
        pixels.push_back(row.pixels);
        times_ms.push_back(row.warm.p50_ms);
        if (row.sensor == "HDL-32E" || row.sensor == "OS1-128/1024") continue;
        const char* const comma = sensors.empty() ? "" : ", ";
        sensors += comma + row.sensor;
        ours += comma + cell(row.warm.p50_ms, 1);
        fast += comma + cell(medianOf(p, row.sensor, kFastPipeline), 1);
        at_10_hz += comma + cell(row.warm.p50_ms, 0);
        at_20_hz += comma + cell(2 * row.warm.p50_ms, 0);
    }
    return "A scan (" + sensors + ") takes " + ours + " ms with the default settings, and " + fast +
           " ms with `-c fast`. The default settings use " + at_10_hz +
           " % of one core at 10 Hz, and " + at_20_hz +
           " % at 20 Hz. Time grows as pixels to the power of " +
           cell(exponentOf(pixels, times_ms), 2) + ".\n\n";
}

std::string wholeSection(const Performance& p) {
    Table table(
        {"sensor", "", "warm p50/p95/p99", "/ mrpt decode", "cold p50/p95/p99", "/ mrpt decode"});
    for (const TimedRow& row : p.rows) {
        if (row.cold.runs == 0) continue;
        const TimedRow* const mrpt = find(p.rows, row.sensor, kMrptDecode);
        std::vector<std::string> line{row.sensor, row.what};
        for (const auto part : {&TimedRow::warm, &TimedRow::cold}) {
            const evaluation::Latency& t = row.*part;
            line.push_back(microseconds(t.p50_ms) + "/" + microseconds(t.p95_ms) + "/" +
                           microseconds(t.p99_ms));
            line.push_back(cell(mrpt == nullptr ? NAN : t.p50_ms / (mrpt->*part).p50_ms, 2));
        }
        table.add(line);
    }
    return "## From packets to labels\n\n"
           "Microseconds per scan on one core, from packets (VLP-16, HDL-32E) or coordinates to "
           "labels. All rows run in turn on each scan: warm, right after the previous scan, or "
           "cold, after reading 256 MB of other data. Scans: 13 in sequence in each of four "
           "simulated "
           "scenes; HDL-64E: six real drives, with the beams of one. `mrpt decode` is "
           "`generatePointCloud()`, which decodes half of the scan.\n\n" +
           table.text();
}

std::string stageSection(const Performance& p) {
    const std::vector<TimedRow> sensors = rowsOf(p, "decode");
    std::vector<std::string> heads{"p50, microseconds"};
    for (const TimedRow& one : sensors) heads.push_back(one.sensor);
    Table table(heads);
    for (const TimedRow& row : p.rows) {
        if (row.sensor != sensors.front().sensor || row.cold.runs != 0) continue;
        std::vector<std::string> line{row.what};
        for (const TimedRow& one : sensors) {
            line.push_back(microseconds(medianOf(p, one.sensor, row.what)));
        }
        table.add(line);
    }
    return "## Each stage\n\n"
           "Stages 1 to 9 run with the paper's settings, the others with the default settings, "
           "right after a complete run on the same scan.\n\n" +
           table.text();
}

std::string growthSection(const Performance& p) {
    Table table({"ns per pixel", "pixels", "paper", "default", "fast"});
    const std::vector<TimedRow> papers = rowsOf(p, kPaperPipeline),
                                ours = rowsOf(p, kDefaultPipeline), fast = rowsOf(p, kFastPipeline);
    for (std::size_t i = 0; i < ours.size(); ++i) {
        table.add({ours[i].sensor, std::to_string(ours[i].pixels), cell(nsPerPixel(papers[i]), 0),
                   cell(nsPerPixel(ours[i]), 0), cell(nsPerPixel(fast[i]), 0)});
    }
    return "## Scaling\n\n" + table.text();
}

std::string flightSection(const Performance& p) {
    const std::size_t scans = p.table.returns.size();
    const std::size_t returns =
        std::accumulate(p.table.returns.begin(), p.table.returns.end(), std::size_t{0});
    Table table({"`" + p.table.scenario + "`, ms", "p50", "p95", "p99"});
    for (const auto& method : p.table.methods) {
        const evaluation::Latency t = evaluation::latencyOf(method.runs_ms);
        table.add({method.name, cell(t.p50_ms), cell(t.p95_ms), cell(t.p99_ms)});
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
           "# Performance\n\n" +
           summary(performance) +
           std::string(performance.is_quick
                           ? "**A quick run, to check that it works: do not cite.**\n\n"
                           : "") +
           wholeSection(performance) + stageSection(performance) + growthSection(performance) +
           flightSection(performance) + conversionSection(performance) +
           provenanceSection(performance);
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
