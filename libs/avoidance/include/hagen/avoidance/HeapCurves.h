#pragma once
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace hagen::avoidance {

/// Flies `path_m` with each model and writes its heap as CSV: model,path_m,bytes. `begin` is called
/// before each model, `continuing` before each scan; both may throw to end it. The file is written
/// at `place`, such as an OutputPath's temporary name; throws std::runtime_error, naming `file`, if
/// that fails.
void writeHeapCurves(const std::vector<std::string>& models, double path_m,
                     const std::function<void(const std::string& model)>& begin,
                     const std::function<void()>& continuing, const std::filesystem::path& place,
                     const std::filesystem::path& file);

}  // namespace hagen::avoidance
