#include <hagen/base/NumberText.h>
#include <hagen/base/ReadFile.h>
#include <hagen/base/WriteFile.h>
#include <hagen/trials/Calibration.h>
#include <hagen/trials/HeapCurves.h>
#include <cmath>
#include <fstream>
#include <stdexcept>

namespace hagen::trials {

namespace fs = std::filesystem;

namespace {

const std::string kHeader = "model,path_m,bytes";

double measureFrom(const std::string& text) {
    const auto value = base::numberFrom<double>(text);
    if (!value || !(*value >= 0 && std::isfinite(*value))) throw std::invalid_argument(text);
    return *value;
}

}  // namespace

void writeHeapCurves(const std::vector<std::string>& models, double path_m,
                     const std::function<void(const std::string& model)>& begin,
                     const std::function<void()>& continuing, const fs::path& place,
                     const fs::path& file) {
    std::ofstream out = base::openToWrite(place, file);
    out << kHeader << "\n";
    for (const std::string& model : models) {
        begin(model);
        for (const HeapSample& sample : heapAlongFlight(model, path_m, continuing)) {
            out << model << "," << std::round(10 * sample.path_m) / 10 << ","
                << static_cast<long long>(sample.bytes) << "\n";
        }
    }
    base::closeWritten(out, file);
}

std::vector<HeapCurve> readHeapCurves(const fs::path& file) {
    std::vector<HeapCurve> curves;
    std::ifstream in = base::openToRead(file);
    std::string text;
    for (int line = 1; base::nextLine(in, text, file); ++line) {
        if (!text.empty() && text.back() == '\r') text.pop_back();
        if (line == 1 && text == kHeader) continue;
        const std::size_t first = text.find(','), second = text.find(',', first + 1);
        try {
            if (second == std::string::npos) throw std::invalid_argument(text);
            const std::string model = text.substr(0, first);
            const double path_m = measureFrom(text.substr(first + 1, second - first - 1));
            const double bytes = measureFrom(text.substr(second + 1));
            if (curves.empty() || curves.back().model != model) curves.push_back({model, {}});
            curves.back().bytes_by_path_m.emplace_back(path_m, bytes);
        } catch (const std::logic_error&) {
            throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": not " +
                                     kHeader + ": " + text);
        }
    }
    if (in.bad()) throw std::runtime_error(file.string() + ": cannot be read");
    return curves;
}

}  // namespace hagen::trials
