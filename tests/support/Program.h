#pragma once
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace hagen::test {

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

/// The message of the exception thrown by a call; empty if nothing is thrown.
template <class Exception = std::runtime_error, class Call>
std::string messageOf(Call call) {
    try {
        call();
    } catch (const Exception& e) {
        return e.what();
    }
    return "";
}

std::string readFile(const std::filesystem::path& file);

struct Outcome {
    int exit_code;
    std::string out, err;
};
/// Runs a program with these arguments, without input or terminal.
Outcome run(const std::string& program, const std::vector<std::string>& arguments);

/// An outdoor VLP-16 scan from Debian's mrpt-common; empty if not installed.
std::filesystem::path realScan();

/// The folder named by this environment variable; empty if not set. Tests are then skipped.
std::filesystem::path dataFolder(const char* variable);

}  // namespace hagen::test
