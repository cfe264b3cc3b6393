#include "avoidance/world_models/VoxelSet.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace hagen::avoidance {

namespace {

/// Squared distances from a coordinate to four consecutive intervals of equal length.
struct Four {
    float of[4];

    Four(float at, float first, float length) {
        for (int i = 0; i < 4; ++i) {
            const float from = first + static_cast<float>(i) * length;
            const float beyond = std::max(std::max(from - at, at - (from + length)), 0.0f);
            of[i] = beyond * beyond;
        }
    }
};

/// Groups along an axis within reach, nearest first.
struct Column {
    float distance2;       ///< squared distance to the group, in voxels
    float first;           ///< the group's first voxel, as a position in the box
    std::uint32_t part;    ///< along this axis, of the group's number
    std::uint64_t blocks;  ///< mask of its blocks in the box and within reach
};
constexpr int kMaxColumns = 16;
struct BitColumns {
    std::array<Column, kMaxColumns> of;
    int count = 0;
};

std::uint64_t maskOf(int axis, unsigned four) {
    static constexpr std::uint64_t kOf[3][4] = {
        {0x1111111111111111, 0x2222222222222222, 0x4444444444444444, 0x8888888888888888},
        {0x000F000F000F000F, 0x00F000F000F000F0, 0x0F000F000F000F00, 0xF000F000F000F000},
        {0x000000000000FFFF, 0x00000000FFFF0000, 0x0000FFFF00000000, 0xFFFF000000000000}};
    std::uint64_t mask = 0;
    for (unsigned i = 0; i < 4; ++i) {
        if ((four >> i) & 1) mask |= kOf[axis][i];
    }
    return mask;
}

int floorDiv(int value, int by) { return value >= 0 ? value / by : -((by - 1 - value) / by); }

BitColumns columnsNear(const RollingBox& box, int axis, float at, float reach) {
    BitColumns columns;
    const int size = box.size()[axis], min = box.min()[axis];
    const int low = std::max(0, static_cast<int>(std::floor(at - reach)));
    const int high = std::min(size - 1, static_cast<int>(std::floor(at + reach)));
    const int first = floorDiv(min + low, RollingBox::kGroup);
    const int last = floorDiv(min + high, RollingBox::kGroup);
    for (int group = first; group <= last; ++group) {
        Column column;
        const int begin = group * RollingBox::kGroup - min;
        unsigned four = 0;
        for (int i = 0; i < 4; ++i) {
            const int block = begin + i * RollingBox::kBlock;
            if (block + RollingBox::kBlock > low && block <= high) four |= 1u << i;
        }
        column.first = static_cast<float>(begin);
        const float end = column.first + RollingBox::kGroup;
        const float beyond = std::max(std::max(column.first - at, at - end), 0.0f);
        column.distance2 = beyond * beyond;
        column.part = box.groupPart(axis, group);
        column.blocks = maskOf(axis, four);
        int i = columns.count++;
        for (; i > 0 && columns.of[static_cast<std::size_t>(i) - 1].distance2 > column.distance2;
             --i) {
            columns.of[static_cast<std::size_t>(i)] = columns.of[static_cast<std::size_t>(i) - 1];
        }
        columns.of[static_cast<std::size_t>(i)] = column;
    }
    return columns;
}

float nearestInBlock(std::uint64_t voxels, const Eigen::Array3f& at, const Eigen::Array3f& first,
                     float best2) {
    const Four x(at.x(), first.x(), 1), y(at.y(), first.y(), 1), z(at.z(), first.z(), 1);
    forEachBit(voxels, [&](unsigned bit) {
        best2 = std::min(best2, z.of[bit >> 4] + y.of[(bit >> 2) & 3] + x.of[bit & 3]);
    });
    return best2;
}

float nearestInGroup(const std::uint64_t* voxels, std::uint64_t blocks, const Eigen::Array3f& at,
                     const Eigen::Array3f& first, float best2) {
    constexpr float kEdge = RollingBox::kBlock;
    const Four x(at.x(), first.x(), kEdge), y(at.y(), first.y(), kEdge),
        z(at.z(), first.z(), kEdge);
    std::array<float, 64> distance2;
    std::array<std::uint8_t, 64> block;
    int count = 0, nearest = 0;
    forEachBit(blocks, [&](unsigned bit) {
        const float d2 = z.of[bit >> 4] + y.of[(bit >> 2) & 3] + x.of[bit & 3];
        const auto i = static_cast<std::size_t>(count);
        distance2[i] = d2;
        block[i] = static_cast<std::uint8_t>(bit);
        if (d2 < distance2[static_cast<std::size_t>(nearest)]) nearest = count;
        count += d2 < best2;
    });
    if (count == 0) return best2;
    const auto look = [&](int i) {
        if (distance2[static_cast<std::size_t>(i)] >= best2) return;
        const unsigned bit = block[static_cast<std::size_t>(i)];
        const Eigen::Array3f corner(first.x() + kEdge * static_cast<float>(bit & 3),
                                    first.y() + kEdge * static_cast<float>((bit >> 2) & 3),
                                    first.z() + kEdge * static_cast<float>(bit >> 4));
        best2 = nearestInBlock(voxels[bit], at, corner, best2);
    };
    if (nearest < count) look(nearest);  // then, most other blocks are too far
    for (int i = 0; i < count; ++i) look(i);
    return best2;
}

}  // namespace

float VoxelSet::distance_m(const RollingBox& box, const Eigen::Vector3f& point_m,
                           float limit_m) const {
    const Eigen::Array3f at = box.inVoxels(point_m);
    const float reach = limit_m / box.edge_m();
    if ((at + reach < 0).any() || (at - reach >= box.size().cast<float>()).any()) return limit_m;
    const BitColumns xs = columnsNear(box, 0, at.x(), reach),
                     ys = columnsNear(box, 1, at.y(), reach),
                     zs = columnsNear(box, 2, at.z(), reach);
    const float most2 = reach * reach;
    float best2 = most2;
    for (int k = 0; k < zs.count; ++k) {
        const Column& z = zs.of[static_cast<std::size_t>(k)];
        if (z.distance2 >= best2) break;
        for (int j = 0; j < ys.count; ++j) {
            const Column& y = ys.of[static_cast<std::size_t>(j)];
            if (z.distance2 + y.distance2 >= best2) break;
            for (int i = 0; i < xs.count; ++i) {
                const Column& x = xs.of[static_cast<std::size_t>(i)];
                if (z.distance2 + y.distance2 + x.distance2 >= best2) break;
                const std::size_t group = z.part + y.part + x.part;
                const std::uint64_t blocks = blocks_[group] & z.blocks & y.blocks & x.blocks;
                if (blocks == 0) continue;
                best2 = nearestInGroup(&voxels_[group * 64], blocks, at,
                                       {x.first, y.first, z.first}, best2);
            }
        }
    }
    return best2 < most2 ? std::sqrt(best2) * box.edge_m() : limit_m;
}

std::vector<Eigen::Vector3f> VoxelSet::centres_m(const RollingBox& box) const {
    std::vector<Eigen::Vector3f> centres;
    for (std::size_t block = 0; block < voxels_.size(); ++block) {
        if (voxels_[block] == 0) continue;
        const Eigen::Array3i first = box.placeOf(static_cast<std::uint32_t>(block));
        forEachBit(voxels_[block], [&](unsigned bit) {
            const Eigen::Array3i within(static_cast<int>(bit & 3), static_cast<int>((bit >> 2) & 3),
                                        static_cast<int>(bit >> 4));
            centres.push_back(box.centre_m(first + within));
        });
    }
    return centres;
}

}  // namespace hagen::avoidance
