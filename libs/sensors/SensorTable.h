#pragma once
#include <cstddef>
#include <list>
#include <string>
#include <utility>

namespace hagen::sensors {

/// The sensors of a recording in order of appearance, at most 16; packets from more sensors are
/// only counted. Labels are NAME, NAME_2 and so on.
template <class Key, class Sensor>
class SensorTable {
 public:
    struct Entry {
        Key key;
        std::string label;
        Sensor sensor;
    };

    explicit SensorTable(std::string name) : name_(std::move(name)) {}

    /// Returns the sensor with this key, and creates it on its first packet. If the table is full,
    /// counts the packet and returns null.
    template <class Make>
    Sensor* find(const Key& key, Make make) {
        constexpr std::size_t kMaxSensors = 16;
        for (Entry& entry : entries_) {
            if (entry.key == key) return &entry.sensor;
        }
        if (entries_.size() == kMaxSensors) {
            ++further_;
            return nullptr;
        }
        const std::size_t number = entries_.size() + 1;
        const std::string label = number == 1 ? name_ : name_ + "_" + std::to_string(number);
        return &entries_.emplace_back(Entry{key, label, make(label)}).sensor;
    }
    std::list<Entry>& entries() { return entries_; }
    const std::list<Entry>& entries() const { return entries_; }
    /// Number of packets from sensors beyond the maximum.
    std::size_t further() const { return further_; }

 private:
    std::string name_;
    std::list<Entry> entries_;
    std::size_t further_ = 0;
};

}  // namespace hagen::sensors
