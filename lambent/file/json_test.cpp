#include "lambent/file/json.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

namespace lambent::file {
namespace {

std::string nested(int depth) {
  return std::string(std::size_t(depth), '[') + std::string(std::size_t(depth), ']');
}

TEST(Json, DepthIsBounded) {
  EXPECT_TRUE(parseJson(nested(kDeepestJson)));
  const auto refused = parseJson("  " + nested(kDeepestJson + 1));
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().kind, ErrorKind::BadInput);
  EXPECT_EQ(refused.error().message, "its values are nested more than 200 deep at byte 202");
  EXPECT_FALSE(parseJson(std::string(1000000, '[')));
  std::string objects;
  for (int i = 0; i < 100000; ++i) objects += R"({"a":)";
  EXPECT_FALSE(parseJson(objects));
}

TEST(Json, BracketsInStringsDoNotNest) {
  const std::string many(1000, '[');
  const auto json = parseJson("{\"a\\\\\": \"\\\"" + many + "\", \"b\": [1]}");
  ASSERT_TRUE(json) << json.error().message;
  EXPECT_EQ((*json)["a\\"], "\"" + many);
  EXPECT_EQ((*json)["b"][0], 1);
}

TEST(Json, DamageIsPlaced) {
  const auto cut = parseJson("{\"a\": [1, 2");
  ASSERT_FALSE(cut);
  EXPECT_NE(cut.error().message.find("column 12"), std::string::npos) << cut.error().message;
  EXPECT_FALSE(parseJson(""));
  EXPECT_FALSE(parseJson("\"\\"));
  EXPECT_LT(parseJson("[" + std::string(100000, 'x')).error().message.size(), 400u);
  EXPECT_LT(parseJson("[\"" + std::string(100000, 'x')).error().message.size(), 400u);
}

TEST(Json, ARepeatedKeyIsFound) {
  EXPECT_FALSE(repeatedKey(R"({"a": 1, "b": {"a": 2, "b": [{"a": 3}, {"a": 4}]}, "c": "a"})"));
  EXPECT_EQ(repeatedKey(R"({"a": 1, "b": {"a": 2}, "a": {"x": 1, "x": 2}})"), "a");
  EXPECT_EQ(repeatedKey(R"([{"b": [{"c": 1, "\u0063": 2}]}])"), "c");
  EXPECT_FALSE(repeatedKey("[1, []]"));
}

TEST(Json, WhatStandsInAnObjectOrIsPutThere) {
  nlohmann::json object = {{"held", {1, 2}}};
  arrayAt(object, "held").push_back(3);
  arrayAt(object, "list").push_back(4);
  objectAt(object, "inner")["a"] = 5;
  EXPECT_TRUE(objectAt(object, "empty").is_object());
  EXPECT_EQ(object,
            nlohmann::json::parse(R"({"held":[1,2,3],"list":[4],"inner":{"a":5},"empty":{}})"));
}

}  // namespace
}  // namespace lambent::file
