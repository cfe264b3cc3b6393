#include <hagen/live/Recording.h>

#include <system_error>

namespace hagen::live {

std::filesystem::path recorderProgram() {
    namespace fs = std::filesystem;
    constexpr const char* kName = "live-record";
    std::error_code error;
    const fs::path program = fs::read_symlink("/proc/self/exe", error);
    if (!error && program.has_parent_path()) {
        const fs::path beside = program.parent_path().parent_path() / "libexec/hagen" / kName;
        if (fs::exists(beside, error)) return beside;
    }
    return fs::path(HAGEN_INSTALLED_LIBEXEC) / kName;
}

}  // namespace hagen::live
