// Sums over blocks of ground cells around each block, for stages that judge a surrounding.
#pragma once
#include <hagen/segmentation/GroundSurface.h>
#include <array>

namespace hagen {

constexpr int kBlockCells = 4;
constexpr int kBlocks = GroundSurface::kCells / kBlockCells;  // along each side, 3 m each

/// A value per block, column by column.
template <class Value>
using Blocks = std::array<Value, kBlocks * kBlocks>;

/// The same for each pixel's block (PixelCells.h), with a last element for pixels without one.
template <class Value>
using BlocksAndNone = std::array<Value, kBlocks * kBlocks + 1>;

/// Sums over `kReach` blocks in each direction along a line of blocks that are `stride` apart. Each
/// step adds one block and removes one.
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

/// Replaces the value of each block by the sum over the square around it.
template <int kReach, class Value>
void sumAround(Blocks<Value>& blocks) {
    Blocks<Value> sums;
    for (int j = 0; j < kBlocks; ++j) {
        sumAlong<kReach>(&blocks[j * kBlocks], 1, &sums[j * kBlocks]);
    }
    for (int i = 0; i < kBlocks; ++i) sumAlong<kReach>(&sums[i], kBlocks, &blocks[i]);
}

}  // namespace hagen
