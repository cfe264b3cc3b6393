#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <cstddef>
#include <string>
#include <vector>

namespace hagen {

/// A progress line on standard error, removed at the end; shown only if standard error is a
/// terminal.
class Progress {
 public:
    /// `times` is the number of passes over all scans.
    explicit Progress(const evaluation::LabelledScanSources& sources, std::size_t times = 1);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    /// `what` is shown before the scan number.
    void show(const evaluation::MethodOutput& view, const std::string& what = "");

 private:
    bool is_on_terminal_;
    std::size_t done_ = 0, all_ = 0;
};

}  // namespace hagen
