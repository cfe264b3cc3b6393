#include "Progress.h"
#include "base/command_line/Terminal.h"

#include <unistd.h>

#include <iostream>

namespace hagen {

Progress::Progress(const evaluation::LabelledScanSources& sources, std::size_t times)
    : is_on_terminal_(isatty(STDERR_FILENO) == 1) {
    for (const auto& source : sources) all_ += times * source->size();
}

Progress::~Progress() {
    if (is_on_terminal_) std::cerr << hagen::base::clearLine << std::flush;
}

void Progress::show(const evaluation::MethodOutput& view, const std::string& what) {
    if (!is_on_terminal_ || view.method + 1 < view.methods) return;
    std::cerr << hagen::base::clearLine << what << "scan " << ++done_ << " of " << all_
              << std::flush;
}

}  // namespace hagen
