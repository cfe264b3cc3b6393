#pragma once
#include <octomap/OcTreeKey.h>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace hagen::observations {

/// A set of OctoMap keys within a box, one bit per key. Much faster than OctoMap's key set for
/// nearby keys.
class KeyBitset {
 public:
    struct Corners {
        octomap::OcTreeKey min, max;  ///< inclusive
    };

    void reset(const Corners& box) {
        min_ = box.min;
        std::size_t bits = 1;
        for (unsigned i = 0; i < 3; ++i) {
            size_[i] = static_cast<std::size_t>(box.max[i] - box.min[i]) + 1;
            bits *= size_[i];
        }
        words_.assign(bits / 64 + 1, 0);
    }

    /// Inserts a key, which must lie in the box; returns true if it is new.
    bool add(const octomap::OcTreeKey& key) {
        const std::size_t i = indexOf(key);
        const std::uint64_t bit = std::uint64_t{1} << (i % 64);
        const bool is_new = (words_[i / 64] & bit) == 0;
        words_[i / 64] |= bit;
        return is_new;
    }
    bool has(const octomap::OcTreeKey& key) const {
        const std::size_t i = indexOf(key);
        return (words_[i / 64] >> (i % 64)) & 1;
    }

    std::size_t bytes() const { return words_.capacity() * sizeof(std::uint64_t); }

 private:
    std::size_t indexOf(const octomap::OcTreeKey& key) const {
        return (static_cast<std::size_t>(key[2] - min_[2]) * size_[1] +
                static_cast<std::size_t>(key[1] - min_[1])) *
                   size_[0] +
               static_cast<std::size_t>(key[0] - min_[0]);
    }

    octomap::OcTreeKey min_;
    std::size_t size_[3] = {0, 0, 0};
    std::vector<std::uint64_t> words_;
};

}  // namespace hagen::observations
