#include <hagen/avoidance/Calibration.h>
#include <hagen/avoidance/HeapCurves.h>
#include <hagen/base/WriteFile.h>
#include <cmath>
#include <fstream>

namespace hagen::avoidance {

namespace fs = std::filesystem;

void writeHeapCurves(const std::vector<std::string>& models, double path_m,
                     const std::function<void(const std::string& model)>& begin,
                     const std::function<void()>& continuing, const fs::path& place,
                     const fs::path& file) {
    std::ofstream out = base::openToWrite(place, file);
    out << "model,path_m,bytes\n";
    for (const std::string& model : models) {
        begin(model);
        for (const HeapSample& sample : heapAlongFlight(model, path_m, continuing)) {
            out << model << "," << std::round(10 * sample.path_m) / 10 << ","
                << static_cast<long long>(sample.bytes) << "\n";
        }
    }
    base::closeWritten(out, file);
}

}  // namespace hagen::avoidance
