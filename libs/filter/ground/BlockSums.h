// Sums over the neighbourhood of each block of ground cells.
#pragma once
#include <hagen/filter/CellArea.h>
#include <hagen/filter/GroundSurface.h>
#include <algorithm>
#include <array>
#include <cmath>

namespace hagen {

constexpr int kBlockCells = 4;
constexpr int kBlocks = GroundSurface::kCells / kBlockCells;  // along each side, each 3 m wide

/// A value per block, column by column.
template <class Value>
using Blocks = std::array<Value, kBlocks * kBlocks>;

/// Like Blocks, but indexed by a pixel's block (PixelCells.h), and with a last element for pixels
/// without a block.
template <class Value>
using BlocksAndNone = std::array<Value, kBlocks * kBlocks + 1>;

/// The distance of a block's centre from the middle of the grid.
inline float blockDistance_m(int block) {
    constexpr float kWidth_m = kBlockCells * GroundSurface::kCell_m, kMiddle = 0.5f * (kBlocks - 1);
    const int row = block % kBlocks, column = block / kBlocks;
    const float u = static_cast<float>(row) - kMiddle, v = static_cast<float>(column) - kMiddle;
    return kWidth_m * std::sqrt(u * u + v * v);
}

/// Sums over `kReach` blocks in each direction along a line of blocks that are `stride` apart. Each
/// step adds a block and removes a block.
template <int kReach, class Value>
void sumAlong(const Value* blocks, int stride, Value* sums) {
    Value around;
    for (int k = 0; k < kReach; ++k) around.add(blocks[k * stride]);
    for (int k = 0; k < kBlocks; ++k) {
        if (k + kReach < kBlocks) around.add(blocks[(k + kReach) * stride]);
        if (k - kReach - 1 >= 0) around.remove(blocks[(k - kReach - 1) * stride]);
        sums[k * stride] = around;
    }
}

/// The blocks in [first, end) along both axes.
struct BlockArea {
    int first_row = 0, end_row = kBlocks, first_column = 0, end_column = kBlocks;
};

/// The blocks that lie completely inside an area.
inline BlockArea blocksIn(const CellArea& area) {
    const auto first = [](int place) {
        return (std::max(place - 1, 0) + kBlockCells - 1) / kBlockCells;
    };
    const auto end = [](int place) { return std::max(place - 1, 0) / kBlockCells; };
    return {first(area.first_row), end(area.end_row), first(area.first_column),
            end(area.end_column)};
}

/// Replaces the value of each block of an area by the sum over the square around it. Blocks outside
/// the area are treated as 0.
template <int kReach, class Value>
void sumAround(Blocks<Value>& blocks, const BlockArea& area = {}) {
    Blocks<Value> sums{};
    for (int j = area.first_column; j < area.end_column; ++j) {
        sumAlong<kReach>(&blocks[j * kBlocks], 1, &sums[j * kBlocks]);
    }
    for (int i = area.first_row; i < area.end_row; ++i) {
        sumAlong<kReach>(&sums[i], kBlocks, &blocks[i]);
    }
}

}  // namespace hagen
