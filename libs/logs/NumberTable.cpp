#include <hagen/logs/NumberTable.h>

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

namespace hagen::logs {
namespace {

[[noreturn]] void fail(const std::filesystem::path& file, std::size_t line,
                       const std::string& why) {
    throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + why);
}

}  // namespace

std::vector<NumberLine> readNumberTable(const std::filesystem::path& file) {
    std::ifstream in(file);
    if (!in || std::filesystem::is_directory(file)) {
        throw std::runtime_error(file.string() + ": cannot be read");
    }
    std::vector<NumberLine> table;
    std::size_t line = 0;
    for (std::string text; std::getline(in, text);) {
        ++line;
        std::istringstream words(text);
        NumberLine entry{line, {}};
        for (std::string word; words >> word;) {
            if (entry.numbers.empty() && word[0] == '#') break;
            if (word.find('\0') != std::string::npos) {  // the rest of the word would be ignored
                fail(file, line, "there is a NUL byte, so this is no text file");
            }
            char* end = nullptr;
            const double number = std::strtod(word.c_str(), &end);
            // Not the first NUL, which a broken file may have within a word.
            if (end != word.c_str() + word.size() || !std::isfinite(number)) {
                fail(file, line, "'" + word + "' is not a finite number");
            }
            entry.numbers.push_back(number);
        }
        if (!entry.numbers.empty()) table.push_back(std::move(entry));
    }
    if (in.bad()) throw std::runtime_error(file.string() + ": cannot be read further");
    return table;
}

void checkColumns(const std::filesystem::path& file, const NumberLine& line, std::size_t columns,
                  const std::string& what) {
    if (line.numbers.size() == columns) return;
    fail(file, line.line,
         "expected " + std::to_string(columns) + " numbers (" + what + "), found " +
             std::to_string(line.numbers.size()));
}

}  // namespace hagen::logs
