#include "with_mrpt/Recording.h"

#include <hagen/settings/Settings.h>
#include <pybind11/pybind11.h>

#include <system_error>
#include <utility>

#include "GilRelease.h"
#include "Texts.h"
#include "with_mrpt/Recorded.h"

namespace hagen::python {

namespace py = pybind11;

namespace {

/// Runs `read` without the GIL. A signal, such as Ctrl-C, ends it with the exception raised by
/// Python's handler.
template <class Read>
auto withoutGil(Read read) {
    try {
        const GilRelease gil_release;
        return read();
    } catch (const recordings::Interrupted&) {
        if (PyErr_Occurred() != nullptr) throw py::error_already_set();
        throw;
    }
}

bool hasNoSignal() {
    const py::gil_scoped_acquire gil;
    return PyErr_CheckSignals() == 0;
}

}  // namespace

Recording::Recording(const std::filesystem::path& file, recordings::SourceOptions options,
                     const std::filesystem::path& poses)
    : file_(file), wanted_labels_(options.sensor_labels) {
    std::error_code error;
    for (const auto& needed : {file, poses}) {
        if (needed.empty() || std::filesystem::exists(needed, error)) continue;
        PyErr_SetObject(PyExc_FileNotFoundError,
                        shownText(needed.string() + ": no such file").ptr());
        throw py::error_already_set();
    }
    options.keep_going = hasNoSignal;
    source_ = withoutGil([&] {
        std::shared_ptr<recordings::ScanSource> source = recordings::openRecording(file, options);
        source->useSettings(Settings());  // required for the beams of unnamed sensors
        source->usePoses(poses);
        return source;
    });
}

std::string Recording::poseSource() const {
    const GilRelease gil_release;
    const std::lock_guard lock(reading_);
    return source_->poses().source;
}

std::vector<std::string> Recording::remarks() const {
    const GilRelease gil_release;
    const std::lock_guard lock(reading_);
    std::vector<std::string> remarks = source_->remarks();
    // A requested label without scans may be a typo.
    std::string others;
    for (const auto* const labels : {&labels_, &source_->otherLabels()}) {
        for (const std::string& label : *labels) others += " '" + label + "'";
    }
    for (const std::string& label : wanted_labels_) {
        if (!is_at_end_ || others.empty() || labels_.count(label) > 0) continue;
        remarks.push_back("no entry that was read has a LiDAR scan of '" + label + "'; there are" +
                          others);
    }
    return remarks;
}

std::optional<PythonScan> Recording::next() {
    auto recorded = withoutGil([&] {
        const std::lock_guard lock(reading_);
        auto scan = source_->nextScan();
        is_at_end_ = !scan;
        if (scan) labels_.insert(scan->observation->sensorLabel);
        return scan;
    });
    if (!recorded) return std::nullopt;
    return pythonScanOf({std::move(*recorded), source_});
}

}  // namespace hagen::python
