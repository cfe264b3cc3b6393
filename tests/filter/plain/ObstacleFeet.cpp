#include "filter/ground/StageRules.h"
#include "filter/plain/PlainStages.h"

namespace hagen::plain {

void growFeet(const PixelPoints& pixels, const Image<float>& height_m, Image<Label>& labels) {
    using namespace feet_rules;
    const Eigen::Index rows = labels.rows();
    for (Eigen::Index column = 0; column < labels.cols(); ++column) {
        Eigen::Index above = -1;  // row of the next non-empty pixel above
        for (Eigen::Index row = rows - 1; row >= 0; --row) {
            Label& label = labels(row, column);
            if (label == Label::Unclassified) continue;
            if (above >= 0 && above - row <= kFootRows && labels(above, column) == Label::Roi &&
                height_m(row, column) > kFootHeight_m) {
                const Eigen::Vector3f up_m =
                    pixels.at(column * rows + above) - pixels.at(column * rows + row);
                const float run_m2 = up_m.x() * up_m.x() + up_m.y() * up_m.y();
                const bool is_steep = up_m.z() * up_m.z() > run_m2;  // steeper than 45 deg
                if (is_steep) label = Label::Roi;
            }
            above = row;
        }
    }
}

}  // namespace hagen::plain
