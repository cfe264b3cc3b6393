#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <hagen/base/Json.h>

#include <cmath>
#include <ctime>
#include <nlohmann/json.hpp>
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

/// A random value of nlohmann's library, which has the definition of our text.
nlohmann::ordered_json randomValue(std::mt19937& random, int depth) {
    nlohmann::ordered_json value;
    switch (random() % (depth > 0 ? 8 : 6)) {
        case 0:
            return nullptr;
        case 1:
            return random() % 2 == 0;
        case 2:
            return random();
        case 3:
            return -static_cast<std::int64_t>(random());
        case 4:
            return std::ldexp(static_cast<double>(random()), static_cast<int>(random() % 60) - 50);
        case 5:
            return std::string(random() % 3, "a\"\n\t/\x01"[random() % 6]) + "\xC3\xA4";
        case 6:
            value = nlohmann::ordered_json::array();
            for (unsigned i = random() % 4; i > 0; --i)
                value.push_back(randomValue(random, depth - 1));
            return value;
        default:
            value = nlohmann::ordered_json::object();
            for (unsigned i = random() % 4; i > 0; --i) {
                value["key " + std::to_string(random() % 3)] = randomValue(random, depth - 1);
            }
            return value;
    }
}

TEST(Json, ReadsAndWritesAsItsLibraryDoes) {
    std::mt19937 random(3);
    for (int i = 0; i < 300; ++i) {
        const nlohmann::ordered_json value = randomValue(random, 4);
        const Json json = Json::parse(value.dump());
        for (const int indent : {-1, 0, 2}) EXPECT_EQ(json.dump(indent), value.dump(indent));
    }
    EXPECT_EQ(Json::parse(R"({"a": {"b": [1]}, "c": 1, "a": [2, {}]})").dump(),
              R"({"a":[2,{}],"c":1})");
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
    EXPECT_EQ(test::messageOf([] { Json::parse(R"([1, "x", 2])").numbers(); }),
              "item 2 of 3: expected a number, not: \"x\"");
}

TEST(Json, SaysWhereATextIsNoJson) {
    const auto faultOf = [](const std::string& text) {
        return test::messageOf([&] { Json::parse(text); });
    };
    EXPECT_EQ(
        faultOf("{\n \"a\": 1,\n  b: 2}"),
        "is no JSON: line 3, column 3: unexpected text at '  b'; a name in quotes is expected");
    EXPECT_EQ(
        faultOf("{\"a\": [1 2]}"),
        "is no JSON: line 1, column 10: unexpected text at '{\"a\": [1 2'; ',' or ']' is expected");
    EXPECT_EQ(
        faultOf("{\"a\": 1}\n}"),
        "is no JSON: line 2, column 1: unexpected text at '}'; the end of the text is expected");
    EXPECT_EQ(
        faultOf("{\"a\": \"one\ntwo\"}"),
        "is no JSON: line 1, column 10: text that does not end in its line at '{\"a\": \"one'");
    EXPECT_EQ(faultOf("[1e999]"), "is no JSON: number overflow parsing '1e999'");
    // Bytes that a terminal must not see.
    EXPECT_EQ(faultOf("\xff\x1b"), "is no JSON: line 1, column 1: unexpected text at '?'");
    for (const std::string cut : {"{", "[1,", "{\"a\": \"b", "{\"a\"", ""}) {
        EXPECT_EQ(faultOf(cut), "is no JSON: it ends too early; is it cut?") << cut;
    }
    // Only what is close to the place, however long the line is.
    EXPECT_LT(faultOf("[" + std::string(5000, ' ') + "x").size(), 120u);
}

TEST(Json, RefusesTextThatIsNestedTooDeeply) {
    const auto nested = [](std::size_t levels) {
        return std::string(levels, '[') + std::string(levels, ']');
    };
    EXPECT_EQ(Json::parse(nested(64)).dump(), nested(64));
    const std::string fault =
        "is nested too deeply: more than 64 lists and objects within each other";
    EXPECT_EQ(test::messageOf([&] { Json::parse(nested(65)); }), fault);
    // Deep enough to end the program by the calls that destroy such a value; whatever texts say.
    EXPECT_EQ(test::messageOf([&] { Json::parse(std::string(300000, '[')); }), fault);
    EXPECT_EQ(test::messageOf([&] {
                  Json::parse("{\"a\": \"" + std::string(340000, ']') +
                              "\", \"b\": " + nested(340000) + "}");
              }),
              fault);
}

TEST(Json, LargeObjectsAreReadInTimeAndInOrder) {
    constexpr std::size_t kKeys = 100000;
    const std::clock_t start = std::clock();
    std::string text = "{";
    for (std::size_t i = 0; i < kKeys; ++i) text += "\"k" + std::to_string(i) + "\":1,";
    const Json json = Json::parse(text + "\"k5\": 2, \"k70000\": {\"z\": 3}}");
    // A tenth of a second; many if each key is searched among those before it.
    EXPECT_LT(static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC, 5);
    EXPECT_EQ(json.members().size(), kKeys);
    EXPECT_EQ(json.members().back().first, "k" + std::to_string(kKeys - 1));
    EXPECT_EQ(json.members()[5].first, "k5");
    EXPECT_EQ(json.at("k5").count(), 2u);  // the last one counts
    EXPECT_EQ(json.members()[70000].second.dump(), "{\"z\":3}");
}

}  // namespace
}  // namespace hagen::base
