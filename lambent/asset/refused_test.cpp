// spec/refused.json: samples with a change each, and whether a reader takes them. The TypeScript
// reader's test goes through the same table.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

#include "lambent/asset/asset.h"
#include "lambent/asset/test_support.h"

namespace lambent::asset {
namespace {

using nlohmann::json;

json table() {
  std::ifstream file(test::kSpec / "refused.json");
  EXPECT_TRUE(file);
  return json::parse(file, nullptr, false);
}

template <class T>
void put(std::span<std::byte> bytes, std::size_t index, T value) {
  ASSERT_LE((index + 1) * sizeof(T), bytes.size());
  std::memcpy(bytes.data() + index * sizeof(T), &value, sizeof(T));
}

/// One number of an accessor, as its component type stores it.
void poke(const json& document, std::vector<std::byte>& binary, const json& op) {
  const json& accessor = document["accessors"].at(op["accessor"].get<std::size_t>());
  const json& view = document["bufferViews"].at(accessor["bufferView"].get<std::size_t>());
  const std::span<std::byte> bytes =
      std::span(binary).subspan(view.value("byteOffset", 0u) + accessor.value("byteOffset", 0u));
  const auto index = op["number"].get<std::size_t>();
  const std::map<std::string, float> odd = {{"nan", std::nanf("")},
                                            {"inf", std::numeric_limits<float>::infinity()},
                                            {"-inf", -std::numeric_limits<float>::infinity()}};
  const json& value = op["value"];
  switch (accessor["componentType"].get<int>()) {
    case 5120:
      return put(bytes, index, value.get<std::int8_t>());
    case 5121:
      return put(bytes, index, value.get<std::uint8_t>());
    case 5123:
      return put(bytes, index, value.get<std::uint16_t>());
    case 5126:
      return put(bytes, index, value.is_string() ? odd.at(value) : value.get<float>());
    default:
      FAIL() << accessor;
  }
}

test::Glb patched(test::Glb glb, const json& patch) {
  json document = json::parse(glb.json);
  for (const json& op : patch) {
    if (op["op"] == "poke")
      poke(document, glb.binary, op);
    else if (op["op"] == "cut")
      glb.binary.resize(op["bytes"]);
    else
      document.patch_inplace(json::array({op}));  // throws where a path does not exist
  }
  glb.json = document.dump();
  return glb;
}

TEST(Refused, TheTableIsWellFormed) {
  std::set<std::string> names;
  int legal = 0;
  for (const json& entry : table()) {
    EXPECT_TRUE(names.insert(entry["name"].get<std::string>()).second) << entry["name"];
    for (const auto& [key, value] : entry.items())
      EXPECT_TRUE(
          std::set<std::string>({"name", "sample", "patch", "refused", "schema", "place", "why"})
              .contains(key))
          << key;
    legal += !entry["refused"].get<bool>();
  }
  EXPECT_GE(names.size(), 300u);
  EXPECT_GE(legal, 40);
}

TEST(Refused, AsTheTableSays) {
  const test::Folder folder;
  std::map<std::string, test::Glb> samples;
  for (const json& entry : table()) {
    const std::string sample = entry["sample"];
    SCOPED_TRACE(entry["name"].get<std::string>());
    if (!samples.contains(sample))
      samples[sample] = test::Glb::parse(test::bytesOf(test::kSpec / "samples" / sample));
    const std::filesystem::path path = folder / "patched.glb";
    test::spill(path, patched(samples[sample], entry["patch"]).bytes());
    const Result<Asset> asset = read(path);
    if (!entry["refused"].get<bool>()) {
      EXPECT_TRUE(asset) << asset.error().message;
      if (!asset) continue;
      const Status again = write(*asset, folder / "again.glb");
      EXPECT_TRUE(again) << again.error().message;
      continue;
    }
    EXPECT_FALSE(asset) << "was read";
    if (asset) continue;
    EXPECT_EQ(asset.error().kind, ErrorKind::BadInput);
    // "FILE: PLACE: WHAT", where the place may go on to a member: ".bands", "[2]".
    const std::string& message = asset.error().message;
    const std::string start = path.string() + ": " + entry.value("place", "");
    const bool named = message.starts_with(start) && message.size() > start.size() &&
                       (!entry.contains("place") ||
                        std::string_view(":.[").find(message[start.size()]) != std::string::npos);
    EXPECT_TRUE(named) << message << "\n  where the place is " << entry.value("place", "");
  }
}

}  // namespace
}  // namespace lambent::asset
