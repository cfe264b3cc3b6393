#include <hagen/base/Quantile.h>
#include <hagen/trials/MeasuredTable.h>
#include <hagen/trials/Statistics.h>
#include <algorithm>

#include "CsvNumbers.h"

namespace hagen::trials {
namespace {

auto commasIn(const std::string& line) { return std::count(line.begin(), line.end(), ','); }

}  // namespace

std::string measuredHeader() {
    std::string header = keyHeader();
    for (const char* stage : {"filter", "update", "guidance", "planner"}) {
        header += std::string(",") + stage + "_p50_ms," + stage + "_p95_ms";
    }
    return header + ",peak_model_bytes";
}

std::string measuredRowOf(const Run& run, const TrialMeasurement& measurement) {
    const std::string prefix = run.setup.model + "/";
    Run usual;
    usual.scenario = run.scenario;
    usual.seed = run.seed;
    usual.setup = run.setup;
    usual.setup.updates = {};
    std::string row = keyOf(usual);
    for (const std::string& stage :
         {std::string("filter"), prefix + "update", prefix + run.setup.guidance,
          prefix + run.setup.guidance + "+" + run.setup.planner}) {
        const auto found = measurement.stage_ms.find(stage);
        for (const double share : {0.5, 0.95}) {
            row += ",";
            if (found != measurement.stage_ms.end()) {
                row += measureText(base::quantile(found->second, share), 3);
            }
        }
    }
    row += "," + measureText(measurement.peak_model_bytes, 0);
    return run.setup.updates == usual.setup.updates ? row : row + "," + nameOf(run.setup.updates);
}

std::string fullMeasuredHeader() { return measuredHeader() + ",updates"; }

std::string fullMeasuredRowOf(const std::string& row) {
    return commasIn(row) == commasIn(measuredHeader()) ? row + "," + nameOf(Updates::Scans) : row;
}

std::string keyOfMeasuredRow(const std::string& row) {
    std::size_t end = 0;
    for (auto left = commasIn(keyHeader()) + 1; left > 0 && end != std::string::npos; --left) {
        end = row.find(',', end + 1);
    }
    std::string key = row.substr(0, end);
    if (commasIn(row) > commasIn(measuredHeader())) {
        const std::string updates = row.substr(row.rfind(',') + 1);
        if (updates != nameOf(Updates::Scans)) key += "," + updates;
    }
    return key;
}

}  // namespace hagen::trials
