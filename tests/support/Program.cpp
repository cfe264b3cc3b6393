#include "support/Program.h"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <sstream>

namespace hagen::test {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
    std::string name = (fs::temp_directory_path() / "hagen-test-XXXXXX").string();
    path_ = mkdtemp(name.data());
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::write(const std::string& name, const std::string& text) const {
    fs::create_directories((path_ / name).parent_path());
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
}

std::string readFile(const fs::path& file) {
    std::ostringstream text;
    text << std::ifstream(file, std::ios::binary).rdbuf();
    return text.str();
}

Outcome run(const std::string& program, const std::vector<std::string>& arguments) {
    const TemporaryFolder folder;
    const auto quoted = [](const std::string& word) { return "'" + word + "'"; };
    std::string command = quoted(program);
    for (const std::string& argument : arguments) command += " " + quoted(argument);
    command += " >" + quoted(folder / "out") + " 2>" + quoted(folder / "err") + " </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, readFile(folder / "out"),
            readFile(folder / "err")};
}

fs::path realScan() {
    const fs::path file = "/usr/share/mrpt/datasets/test_velodyne_VLP16.rawlog";
    return fs::exists(file) ? file : fs::path{};
}

fs::path dataFolder(const char* variable) {
    const char* folder = std::getenv(variable);
    return folder != nullptr && fs::is_directory(folder) ? fs::path(folder) : fs::path{};
}

}  // namespace hagen::test
