#include "recordings/NumberTable.h"
#include "base/NumberText.h"
#include "base/ReadFile.h"
#include "recordings/clouds/CloudBytes.h"

#include <cmath>
#include <stdexcept>

namespace hagen::recordings {
namespace {

constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";  // written by spreadsheets

[[noreturn]] void failNumber(const std::filesystem::path& file, std::size_t line,
                             const std::string& why) {
    throw std::runtime_error(file.string() + ":" + std::to_string(line) + ": " + why);
}

}  // namespace

std::vector<NumberLine> readNumberTable(const std::filesystem::path& file, std::size_t max_lines) {
    std::ifstream in = base::openToRead(file);
    std::vector<NumberLine> table;
    std::size_t line = 0;
    for (std::string text; table.size() < max_lines && base::nextLine(in, text, file);) {
        ++line;
        if (line == 1 && text.rfind(kByteOrderMark, 0) == 0) text.erase(0, kByteOrderMark.size());
        NumberLine entry{line, {}};
        for (const std::string_view word : wordsOf(text)) {
            if (entry.numbers.empty() && word[0] == '#') break;
            if (word.find('\0') != std::string::npos) {
                failNumber(file, line, "contains a NUL byte, so this is not a text file");
            }
            const bool has_plus = word.size() > 1 && word[0] == '+' && word[1] != '-';
            const auto number = base::numberFrom<double>(word.substr(has_plus ? 1 : 0));
            if (!number || !std::isfinite(*number)) {
                failNumber(file, line, "'" + std::string(word) + "' is not a finite number");
            }
            entry.numbers.push_back(*number);
        }
        if (!entry.numbers.empty()) table.push_back(std::move(entry));
    }
    if (in.bad()) throw std::runtime_error(file.string() + ": read error");
    return table;
}

void checkColumns(const std::filesystem::path& file, const NumberLine& line, std::size_t columns,
                  const std::string& what) {
    if (line.numbers.size() == columns) return;
    failNumber(file, line.line,
               "expected " + base::counted(columns, "number") + " (" + what + "), found " +
                   std::to_string(line.numbers.size()));
}

}  // namespace hagen::recordings
