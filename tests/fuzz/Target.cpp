#include "fuzz/Target.h"

#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <sstream>
#include <utility>

namespace hagen::fuzz {
namespace {

std::vector<Target>& added() {
    static std::vector<Target> targets;
    return targets;
}

struct Folder {
    std::filesystem::path path;
    Folder() {
        const std::filesystem::path memory = "/dev/shm";
        std::error_code error;
        const bool has_memory = std::filesystem::is_directory(memory, error);
        path = (has_memory ? memory : std::filesystem::temp_directory_path()) /
               ("hagen-fuzz-" + std::to_string(getpid()));
        std::filesystem::create_directories(path);
    }
    ~Folder() {
        std::error_code error;
        std::filesystem::remove_all(path, error);
    }
};

}  // namespace

const std::vector<Target>& targets() { return added(); }

bool add(Target target) {
    const auto place = std::find_if(added().begin(), added().end(),
                                    [&](const Target& other) { return other.name > target.name; });
    added().insert(place, std::move(target));
    return true;
}

std::vector<std::string> wordsIn(const std::string& text) {
    std::istringstream words(text);
    return {std::istream_iterator<std::string>(words), {}};
}

void require(bool holds, const std::string& what) {
    if (!holds) throw Violation(what);
}

const std::filesystem::path& scratch() {
    static const Folder folder;
    return folder.path;
}

InputFile::InputFile(std::string_view bytes, const std::string& name) : path_(scratch() / name) {
    std::ofstream(path_, std::ios::binary)
        .write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

InputFile::~InputFile() {
    std::error_code error;
    std::filesystem::remove(path_, error);
}

}  // namespace hagen::fuzz
