#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <cstddef>
#include <vector>

namespace hagen {

/// A progress line on standard error, removed at the end; silent unless standard error is a
/// terminal.
class Progress {
 public:
    explicit Progress(const evaluation::LabelledScanSources& sources);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(const evaluation::MethodOutput& view);

 private:
    bool is_on_terminal_;
    std::size_t done_ = 0, all_ = 0;
};

}  // namespace hagen
