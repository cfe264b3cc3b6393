#include <gtest/gtest.h>
#include <hagen/live/TurnCoverage.h>
#include <hagen/scan/Angle.h>

namespace hagen::live {
namespace {

class TurnCoverageTest : public testing::Test {
 protected:
    /// Adds packets with these angles (in degrees) as a sector; returns the centres of the degrees
    /// completed so far in the first turn.
    std::vector<double> add(const std::vector<std::pair<double, double>>& packets_deg,
                            double head_deg) {
        std::vector<Sweep> packets;
        for (const auto& [from_deg, to_deg] : packets_deg) {
            packets.push_back({radians(from_deg), radians(to_deg)});
        }
        const Sweep sector{packets.front().from_rad, radians(head_deg)};
        LabelledSector labelled{scan_, labels_, sector, 1,       1,
                                true,  false,   false,  result_, &packets};
        labelled.offsets = offsets_;
        const auto& all = coverage_.add(labelled);
        std::vector<double> complete_deg;
        for (int k = 0; k < 360; ++k) {
            bool is_complete = false;
            for (const auto& swept : all) {
                is_complete = is_complete || endOfArc(swept, {radians(1.0 * k), radians(1.0)});
            }
            if (is_complete) complete_deg.push_back(k + 0.5);
        }
        return complete_deg;
    }
    std::vector<double> add(double from_deg, double to_deg) {
        return add({{from_deg, to_deg}}, to_deg);
    }

    const Scan scan_;
    const std::vector<Label> labels_;
    const SegmentationResult result_;
    BeamOffsets offsets_;
    TurnCoverage coverage_;
};

using Degrees = std::vector<double>;

TEST_F(TurnCoverageTest, DegreeIsCompleteWhenFullySwept) {
    EXPECT_EQ(add(10, 12.4), (Degrees{10.5, 11.5}));
    EXPECT_EQ(add(12.4, 13.7), (Degrees{10.5, 11.5, 12.5}));         // completes 12 to 13
    EXPECT_EQ(add(13.71, 14.5), (Degrees{10.5, 11.5, 12.5, 13.5}));  // azimuths are rounded
}

TEST_F(TurnCoverageTest, DetectsTenthDegreeGap) {
    add(10, 12.4);
    EXPECT_EQ(add(12.5, 15), (Degrees{13.5, 14.5}));
    EXPECT_EQ(add({{15, 16.2}, {16.3, 18}}, 18), (Degrees{13.5, 14.5, 15.5, 17.5}));
}

TEST_F(TurnCoverageTest, LatePacketClosesGap) {
    add(10, 12.4);
    add(14.4, 20);
    EXPECT_EQ(add({{20, 21}, {12.4, 14.4}}, 21),
              (Degrees{10.5, 11.5, 12.5, 13.5, 14.5, 15.5, 16.5, 17.5, 18.5, 19.5, 20.5}));
}

TEST_F(TurnCoverageTest, RequiresAllBeams) {
    offsets_ = {radians(4.2), radians(2.2)};
    EXPECT_EQ(add(100, 105), Degrees());  // from 102.2 to 100.8
    EXPECT_EQ(add(105, 110), (Degrees{103.5, 104.5}));
    EXPECT_EQ(add(110, 112), (Degrees{103.5, 104.5, 105.5, 106.5}));
    EXPECT_EQ(add(113, 130),
              (Degrees{116.5, 117.5, 118.5, 119.5, 120.5, 121.5, 122.5, 123.5, 124.5}));
    add(130, 140);
    // The lost packet arrives late.
    const Degrees late = add({{112, 113}}, 140);
    EXPECT_EQ(late.front(), 104.5);
    EXPECT_EQ(late.back(), 117.5);
    EXPECT_EQ(late.size(), 14u);
}

TEST_F(TurnCoverageTest, NextTurnIsSweptAgain) {
    add(350, 362.5);
    EXPECT_EQ(add(362.5, 364.5), (Degrees{0.5, 1.5, 2.5, 3.5, 359.5}));
    EXPECT_EQ(endOfArc({radians(710), radians(730), radians(700)}, {0, radians(5)}), radians(725));
}

/// Earlier sweeps are not joined to the current sweep, even if their angles are adjacent.
TEST_F(TurnCoverageTest, RestartDoesNotJoinEarlierSweeps) {
    add(350, 370.5);
    EXPECT_EQ(add(10.5, 13), (Degrees{11.5, 12.5}));
    EXPECT_NEAR(degrees(coverage_.head_rad()), 13 + 720, 1e-9);
    EXPECT_NEAR(degrees(coverage_.before_rad()), 10.5 + 720, 1e-9);
    EXPECT_EQ(add(13, 14), (Degrees{11.5, 12.5, 13.5}));
    EXPECT_NEAR(degrees(coverage_.before_rad()), 13 + 720, 1e-9);
}

}  // namespace
}  // namespace hagen::live
