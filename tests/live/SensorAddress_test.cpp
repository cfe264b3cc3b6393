#include "live/SensorAddress.h"

#include <gtest/gtest.h>

namespace hagen::live {
namespace {

struct Sent {
    std::uint32_t ip;
    double time_s;
    bool is_of_sensor;
};

void expectTaken(const std::vector<Sent>& all) {
    SensorAddress address;
    for (const auto& [ip, time_s, is_of_sensor] : all) {
        EXPECT_EQ(address.take(ip, time_s), is_of_sensor) << ip << " at " << time_s << " s";
    }
}

/// The other sensor has the same model, but another mount.
TEST(SensorAddress, OtherSensorNeverReplacesOurs) {
    expectTaken({{1, 10, true}, {2, 10.1, false}, {2, 11.6, false}, {1, 11.7, true}});
}

TEST(SensorAddress, ReturnsToEarlierAddress) {
    expectTaken({{1, 10, true},
                 {2, 11.5, true},
                 {1, 11.6, true},  // shows that there are two sensors
                 {2, 11.7, false},
                 {2, 13.2, false},
                 {1, 13.3, true}});
}

TEST(SensorAddress, FollowsSuccessiveAddresses) {
    expectTaken({{1, 10, true}, {2, 11.5, true}, {3, 13, true}, {2, 14.5, true}, {3, 16, true}});
}

TEST(SensorAddress, GivenAddressNeverChanges) {
    SensorAddress address(2);
    EXPECT_FALSE(address.take(1, 10));
    EXPECT_TRUE(address.take(2, 12));
    EXPECT_FALSE(address.take(1, 14));
    EXPECT_EQ(address.others(), std::vector<sensors::IpAddress>{1});
}

TEST(SensorAddress, LimitsNumberOfAddresses) {
    SensorAddress address;
    EXPECT_TRUE(address.take(1, 10));
    for (std::uint32_t ip = 2; ip < 102; ++ip) EXPECT_FALSE(address.take(ip, 10.1));
    EXPECT_FALSE(address.take(1000, 11.6));
    EXPECT_TRUE(address.take(1, 11.7));
}

}  // namespace
}  // namespace hagen::live
