#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::test {

/// A folder of its own for a test, gone with it.
class TemporaryFolder {
 public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    /// Writes a text file and returns its path.
    std::filesystem::path write(const std::string& name, const std::string& text) const;

 private:
    std::filesystem::path path_;
};

/// What a call says where it throws a std::runtime_error; empty where it does not.
template <class Call>
std::string messageOf(Call call) {
    try {
        call();
    } catch (const std::runtime_error& e) {
        return e.what();
    }
    return "";
}

std::string readFile(const std::filesystem::path& file);

/// What a program did.
struct Outcome {
    int exit_code;
    std::string out, err;
};
/// Runs a program with these arguments, with neither input nor terminal.
Outcome run(const std::string& program, const std::vector<std::string>& arguments);

/// A file of Debian's mrpt-common: one outdoor VLP-16 scan. Empty where it is not installed.
std::filesystem::path realScan();

/// The folder that this environment variable names, empty where it does not. Tests skip then.
std::filesystem::path dataFolder(const char* variable);

}  // namespace hagen::test
