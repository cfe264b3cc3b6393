#include <algorithm>
#include <cmath>

#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {

void removeSpecks(const PixelPoints& pixels, const Image<float>& height_m,
                  const Image<float>& tolerance_m, Image<Label>& labels) {
    using namespace speck_rules;
    const int rows = static_cast<int>(labels.rows()), columns = static_cast<int>(labels.cols());
    const Image<Label> before = labels;
    const auto distance = [&](int row, int column) {  // in steps of 1/64 m
        const float x_m = pixels.x_m(row, column), y_m = pixels.y_m(row, column);
        const float distance_m = std::min(std::sqrt(x_m * x_m + y_m * y_m), kFarthest_m);
        return static_cast<int>(distance_m * kSteps_per_m + 0.5f);
    };
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < rows; ++row) {
            const float beyond_m = height_m(row, column) - tolerance_m(row, column);
            if (!(std::abs(beyond_m) < kDoubt_m)) continue;
            int votes = 0, for_roi = 0;
            for (int step = -1; step <= 1; ++step) {
                const int c = wrapColumn(column + step, columns);
                for (int r = std::max(row - 1, 0); r <= std::min(row + 1, rows - 1); ++r) {
                    if (!hasValue(height_m(r, c))) continue;
                    if (std::abs(distance(r, c) - distance(row, column)) > kVoteReach) continue;
                    ++votes;
                    for_roi += before(r, c) == Label::Roi;
                }
            }
            if (votes < kMinVotes || 2 * for_roi == votes) continue;
            labels(row, column) = 2 * for_roi > votes ? Label::Roi : Label::Rou;
        }
    }
}

}  // namespace hagen::plain
