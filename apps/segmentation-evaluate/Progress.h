#pragma once
#include <hagen/evaluation/Evaluation.h>
#include <cstddef>
#include <vector>

namespace hagen {

/// A line on standard error that says how far a run is, gone at its end; nothing where that is no
/// terminal.
class Progress {
 public:
    explicit Progress(const std::vector<evaluation::ScanSource>& sources);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void show(const evaluation::LabelledView& view);

 private:
    bool is_on_terminal_;
    std::size_t done_ = 0, all_ = 0;
};

}  // namespace hagen
