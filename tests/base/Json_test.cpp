#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/base/Json.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "support/Program.h"

namespace hagen::base {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Json, ObjectsKeepTheOrderOfTheirKeys) {
    Json json{{"z", 1}, {"a", {1.5, -2, true}}};
    json["m"] = Json();
    EXPECT_EQ(json.dump(), R"({"z":1,"a":[1.5,-2,true],"m":null})");
    json["z"] = "later";
    EXPECT_EQ(json.dump(), R"({"z":"later","a":[1.5,-2,true],"m":null})");
}

TEST(Json, TextIsEscapedAndNumbersThatAreNotFiniteAreNull) {
    EXPECT_EQ(Json("a\"\n").dump(), R"("a\"\n")");
    EXPECT_EQ(Json(NAN).dump(), "null");
    EXPECT_THROW(Json("\xff").dump(), std::exception);
    EXPECT_EQ(Json("\xff").dump(-1, Json::NotUtf8::Replace), "\"\xEF\xBF\xBD\"");
}

TEST(Json, RandomNumbersSurviveTextBitForBit) {
    std::mt19937_64 random(7);
    for (int i = 0; i < 1000; ++i) {
        const auto bits = random();
        const double number =
            std::ldexp(static_cast<double>(bits), static_cast<int>(bits % 200) - 150);
        EXPECT_EQ(Json::parse(Json(number).dump()).number(), number);
        EXPECT_EQ(Json::parse(Json(bits).dump()).count(), bits);
    }
}

TEST(Json, ReadsWhatItWrote) {
    const Json json = Json::parse(R"({"name": "x", "list": [1, 2.5], "words": ["a", "b"]})");
    EXPECT_EQ(json.at("name").text(), "x");
    EXPECT_THAT(json.at("list").numbers(), ElementsAre(1, 2.5));
    EXPECT_THAT(json.at("words").texts(), ElementsAre("a", "b"));
    EXPECT_EQ(json.at("list").at(0).count(), 1u);
    EXPECT_EQ(json.members().size(), 3u);
    EXPECT_EQ(json.find("none"), nullptr);
    EXPECT_EQ(json.at("name").find("none"), nullptr);
}

TEST(Json, SaysWhatIsExpected) {
    const Json json = Json::parse(R"({"name": "x", "list": [1, -2], "truth": true})");
    EXPECT_EQ(test::messageOf([&] { json.at("none"); }), "there is no key 'none'");
    EXPECT_EQ(test::messageOf([&] { json.at("name").number(); }), "expected a number, not: \"x\"");
    EXPECT_EQ(test::messageOf([&] { json.at("truth").number(); }), "expected a number, not: true");
    EXPECT_EQ(test::messageOf([&] { json.at("list").text(); }), "expected text, not: [1,-2]");
    EXPECT_EQ(test::messageOf([&] { json.at("list").at(1).count(); }),
              "expected an integer of at least 0, not: -2");
    EXPECT_EQ(test::messageOf([&] { json.at("list").at(2); }),
              "expected at least 3 items, not: [1,-2]");
    EXPECT_EQ(test::messageOf([&] { json.at("name").items(); }), "expected an array, not: \"x\"");
    EXPECT_EQ(test::messageOf([&] { json.at("name").members(); }),
              "expected an object, not: \"x\"");
    EXPECT_THAT(test::messageOf([&] { Json::parse("{"); }), HasSubstr("parse error"));
}

}  // namespace
}  // namespace hagen::base
