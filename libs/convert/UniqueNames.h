#pragma once
#include <cstddef>
#include <map>
#include <set>
#include <string>

namespace hagen::recordings {

/// Makes duplicate field names unique: "a", "a_", "a__", "a_3", "a_4"...
class UniqueNames {
 public:
    /// A name that was not returned before.
    std::string of(const std::string& name) {
        std::string unique = name;
        // Continues after the last suffix, to avoid quadratic time for many equal names.
        for (std::size_t& again = times_[name]; !names_.insert(unique).second;) {
            ++again;
            unique = name + (again <= 2 ? std::string(again, '_') : "_" + std::to_string(again));
        }
        return unique;
    }

 private:
    std::set<std::string> names_;
    std::map<std::string, std::size_t> times_;  ///< number of suffixes tried, by name
};

}  // namespace hagen::recordings
