// ROS 2 databases (SQLite files). The first byte of the input selects a database; the others
// overwrite bytes at given offsets, because most direct mutations would not be a database.
#include <algorithm>
#include <fstream>
#include <iterator>

#include "fuzz/Bags.h"

namespace hagen::fuzz {
namespace {

std::string databaseOf(const std::vector<test::SentMessage>& messages) {
    const std::filesystem::path file = scratch() / "seed.db3";
    std::filesystem::remove(file);
    test::writeDb3(file, messages);
    std::ifstream in(file, std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(in), {}};
    std::filesystem::remove(file);
    return bytes;
}

const std::vector<std::string>& databases() {
    static const std::vector<std::string> all = [] {
        std::vector<std::string> made;
        const auto messages = everyMessage();
        made.push_back(databaseOf({messages[0], messages[4]}));
        made.push_back(databaseOf(messages));
        return made;
    }();
    return all;
}

void readDatabase(std::string_view input) {
    Parts parts(input);
    const std::size_t chosen = parts.below(databases().size() + 1);
    std::string bytes;
    if (chosen == databases().size()) {
        bytes = std::string(parts.rest());
    } else {
        bytes = databases()[chosen];
        while (!parts.isAtEnd()) {
            const std::size_t at = parts.number<std::uint16_t>() % bytes.size();
            const std::size_t size = std::min<std::size_t>(1 + parts.below(8), bytes.size() - at);
            bytes.replace(at, size, std::string(size, '\0').replace(0, size, parts.take(size)));
        }
    }
    readAnyBag(InputFile(bytes, "input.db3").path());
}

Seeds changes() {
    return {std::string(1, '\0'), std::string(1, '\1'),
            '\1' + bytesOf(std::uint16_t{100}, std::uint8_t{1}, std::uint16_t{0xffff})};
}

const bool kAdded = add({"db3", readDatabase, changes, {"SQLite format 3"}, 256});

}  // namespace
}  // namespace hagen::fuzz
