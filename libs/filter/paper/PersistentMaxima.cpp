#include <hagen/filter/PersistentMaxima.h>
#include <array>
#include <cstdint>

#include "filter/RadixSort.h"

namespace hagen {
namespace {

/// One saddle neighbour from each stretch of adjacent older neighbours.
struct Arms {
    int count = 0;
    std::array<std::uint8_t, 4> neighbour{};
};

constexpr std::array<Arms, 256> makeArmsByOlderNeighbours() {
    std::array<Arms, 256> table{};
    for (unsigned older = 0; older < table.size(); ++older) {
        for (int side = 0; side < kNeighbours; side += 2) {
            const int corner = side + 1, next = (side + 2) % kNeighbours;
            if (older >> side & 1 || !((older >> corner | older >> next) & 1)) continue;
            const int first = older >> corner & 1 ? corner : next;
            table[older].neighbour[table[older].count++] = static_cast<std::uint8_t>(first);
        }
    }
    return table;
}
constexpr std::array<Arms, 256> kArmsByOlderNeighbours = makeArmsByOlderNeighbours();

/// The number of the maximum at the end of a pixel's ascent; maxima store ~number. Halves the path
/// for later searches (path halving).
std::int32_t maximumAbove(std::int32_t pixel, std::vector<std::int32_t>& ascent) {
    while (true) {
        const std::int32_t next = ascent[pixel];
        if (next < 0) return ~next;
        const std::int32_t after_next = ascent[next];
        if (after_next < 0) return ~after_next;
        ascent[pixel] = after_next;
        pixel = after_next;
    }
}

/// Finds the pixels where maxima meet, in pixel order.
void findMeetings(MaximaWorkspace& w) {
    CriticalPixels& critical = w.critical;
    for (std::size_t n = 0; n < critical.maxima; ++n) {
        critical.ascent[critical.maximum[n]] = ~static_cast<std::int32_t>(n);
    }
    const auto offsets = neighbourOffsets(w.proximity_m.stride());
    w.meetings.clear();
    for (std::size_t n = 0; n < critical.saddles; ++n) {
        const std::int32_t saddle = critical.saddle[n];
        const Arms& arms = kArmsByOlderNeighbours[critical.older_neighbours[saddle]];
        const auto reachedBy = [&](int arm) {
            return maximumAbove(saddle + offsets[arms.neighbour[arm]], critical.ascent);
        };
        const std::int32_t maximum = reachedBy(0);
        for (int arm = 1; arm < arms.count; ++arm) {
            const std::int32_t other = reachedBy(arm);
            if (other != maximum)
                w.meetings.push_back({w.proximity_m.level[saddle], maximum, other});
        }
    }
}

/// The maximum at which the component that now contains this one was born.
std::int32_t eldest(std::int32_t maximum, std::vector<std::int32_t>& elder) {
    while (elder[maximum] != maximum) {
        elder[maximum] = elder[elder[maximum]];
        maximum = elder[maximum];
    }
    return maximum;
}

/// Applies the elder rule at each meeting as the level decreases: the younger component dies.
void applyElderRule(MaximaWorkspace& w) {
    w.order.clear();
    for (const MaximaWorkspace::Meeting& meeting : w.meetings) {
        w.order.push_back(sinkingKey(meeting.level_m, w.order.size()));
    }
    radixSort(w.order, w.swap);
    w.elder.resize(w.critical.maxima);
    for (std::size_t n = 0; n < w.elder.size(); ++n) w.elder[n] = static_cast<std::int32_t>(n);
    for (const std::uint64_t key : w.order) {
        const MaximaWorkspace::Meeting& meeting = w.meetings[itemOf(key)];
        const std::int32_t a = eldest(meeting.maximum, w.elder), b = eldest(meeting.other, w.elder);
        if (a == b) continue;
        const bool a_is_older =
            w.birth_m[a] > w.birth_m[b] || (w.birth_m[a] == w.birth_m[b] && a < b);
        const std::int32_t younger = a_is_older ? b : a;
        w.elder[younger] = a_is_older ? a : b;
        w.death_m[younger] = meeting.level_m;
    }
}

}  // namespace

void proximityOf(const Image<float>& depth_m, float zone_m, Image<float>& proximity_m) {
    proximity_m.resize(depth_m.rows(), depth_m.cols());
    const float* const depth = depth_m.data();
    float* const proximity = proximity_m.data();
    for (Eigen::Index pixel = 0; pixel < depth_m.size(); ++pixel) {
        const float within_zone = zone_m - depth[pixel];
        const float beyond = depth[pixel] * 0.0f;  // NaN * 0 is NaN
        proximity[pixel] = depth[pixel] < zone_m ? within_zone : beyond;
    }
}

// Fast because few pixels matter: components are born where no neighbour is older, and meet only
// where the older neighbours of a pixel are not adjacent. SIMD finds these pixels,
// and only the meetings need sorting.
void findPersistentMaxima(const Image<float>& proximity_m, float min_persistence_m,
                          std::vector<Maximum>& maxima, MaximaWorkspace& w) {
    frameLevels(proximity_m, w.proximity_m);
    findCriticalPixels(w.proximity_m, w.critical);
    w.birth_m.clear();
    for (std::size_t n = 0; n < w.critical.maxima; ++n) {
        w.birth_m.push_back(w.proximity_m.level[w.critical.maximum[n]]);
    }
    w.death_m.assign(w.critical.maxima, 0.0f);
    findMeetings(w);
    applyElderRule(w);

    w.order.clear();
    for (std::size_t n = 0; n < w.critical.maxima; ++n) {
        const float persistence_m = w.birth_m[n] - w.death_m[n];
        if (persistence_m > 0.0f && persistence_m >= min_persistence_m) {
            w.order.push_back(sinkingKey(w.birth_m[n], n));
        }
    }
    radixSort(w.order, w.swap);
    maxima.clear();
    for (const std::uint64_t key : w.order) {
        const std::size_t n = itemOf(key);
        const std::int32_t pixel = w.critical.maximum[n];
        maxima.push_back({w.proximity_m.rowOf(pixel), w.proximity_m.columnOf(pixel), w.birth_m[n],
                          w.death_m[n]});
    }
}

}  // namespace hagen
