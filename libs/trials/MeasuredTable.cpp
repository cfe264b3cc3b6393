#include <hagen/base/Quantile.h>
#include <hagen/trials/MeasuredTable.h>
#include <hagen/trials/Statistics.h>
#include <algorithm>

#include "CsvNumbers.h"

namespace hagen::trials {

std::string measuredHeader() {
    std::string header = keyHeader();
    for (const char* stage : {"filter", "update", "guidance", "planner"}) {
        header += std::string(",") + stage + "_p50_ms," + stage + "_p95_ms";
    }
    return header + ",peak_model_bytes";
}

std::string measuredRowOf(const Run& run, const TrialMeasurement& measurement) {
    const std::string prefix = run.setup.model + "/";
    std::string row = keyOf(run);
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
    return row + "," + measureText(measurement.peak_model_bytes, 0);
}

std::string keyOfMeasuredRow(const std::string& row) {
    static const std::string header = keyHeader();
    std::size_t end = 0;
    for (auto left = std::count(header.begin(), header.end(), ',') + 1;
         left > 0 && end != std::string::npos; --left) {
        end = row.find(',', end + 1);
    }
    return row.substr(0, end);
}

}  // namespace hagen::trials
