#include "lambent/asset/rtt_file.h"

#include <limits>

#include "lambent/asset/rtt_part.h"
#include "lambent/asset/test_support.h"
#include "lambent/transfer/encode.h"

namespace lambent::asset {
namespace {

using test::bytesOf;
using test::spill;

transfer::EncodedRtt exampleRtt(transfer::Encoding encoding, bool heights = true) {
  transfer::Rtt<transfer::Floats> rtt;
  rtt.name = "stripes \"fine\"";
  rtt.width = 5, rtt.height = 3, rtt.views = 2, rtt.bands = 3;
  rtt.size = Vec2(0.5f, 0.3f);
  rtt.depth = 0.02f;
  for (std::size_t i = 0; i < 9 * rtt.planeSize(); ++i)
    rtt.values.push_back(0.01f * float(i % 101) - 0.3f);
  if (heights)
    for (std::size_t i = 0; i < rtt.positionCount() * rtt.viewCount(); ++i)
      rtt.heights.push_back(std::uint8_t(7 * i));
  return transfer::encode(rtt, encoding);
}

TEST(RttFile, ComesBackInEveryEncoding) {
  const test::Folder folder;
  for (const auto encoding :
       {transfer::Encoding::Float16, transfer::Encoding::Float32, transfer::Encoding::Snorm8}) {
    const transfer::EncodedRtt rtt = exampleRtt(encoding);
    ASSERT_TRUE(writeRtt(rtt, folder / "a.rtt"));
    EXPECT_TRUE(isRtt(folder / "a.rtt"));
    const Result<transfer::EncodedRtt> back = readRtt(folder / "a.rtt");
    ASSERT_TRUE(back) << back.error().message;
    EXPECT_EQ(back->name, rtt.name);
    EXPECT_EQ(back->width, 5);
    EXPECT_EQ(back->height, 3);
    EXPECT_EQ(back->views, 2);
    EXPECT_EQ(back->bands, 3);
    EXPECT_EQ(back->size, rtt.size);
    EXPECT_EQ(back->depth, rtt.depth);
    EXPECT_EQ(back->values.encoding, encoding);
    EXPECT_EQ(back->values.half, rtt.values.half);
    EXPECT_EQ(back->values.single, rtt.values.single);
    EXPECT_EQ(back->values.byte, rtt.values.byte);
    EXPECT_EQ(back->values.scales, rtt.values.scales);
    EXPECT_EQ(back->values.block, rtt.values.block);
    EXPECT_EQ(back->heights, rtt.heights);
  }
}

// As all were before heights were kept: what has been made stays readable.
TEST(RttFile, WithoutHeightsIsAFileOfVersion1) {
  const test::Folder folder;
  const transfer::EncodedRtt rtt = exampleRtt(transfer::Encoding::Snorm8, false);
  ASSERT_TRUE(writeRtt(rtt, folder / "a.rtt"));
  EXPECT_EQ(bytesOf(folder / "a.rtt").at(4), std::byte(1));
  const Result<transfer::EncodedRtt> back = readRtt(folder / "a.rtt");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->values.byte, rtt.values.byte);
  EXPECT_TRUE(back->heights.empty());
}

TEST(RttFile, CutOffAnywhereIsBadInputThatNamesTheFile) {
  const test::Folder folder;
  ASSERT_TRUE(writeRtt(exampleRtt(transfer::Encoding::Snorm8), folder / "a.rtt"));
  const std::vector<std::byte> whole = bytesOf(folder / "a.rtt");
  for (std::size_t length = 0; length < whole.size(); length += length < 300 ? 1 : 997) {
    spill(folder / "cut.rtt", std::span(whole).first(length));
    const Result<transfer::EncodedRtt> read = readRtt(folder / "cut.rtt");
    ASSERT_FALSE(read) << length;
    EXPECT_EQ(read.error().kind, ErrorKind::BadInput);
    EXPECT_NE(read.error().message.find("cut.rtt"), std::string::npos);
  }
  std::vector<std::byte> more = whole;
  more.push_back(std::byte(0));
  spill(folder / "more.rtt", more);
  EXPECT_FALSE(readRtt(folder / "more.rtt"));
}

TEST(RttFile, AnyByteChangedIsReadOrRefusedButNeverWorse) {
  const test::Folder folder;
  ASSERT_TRUE(writeRtt(exampleRtt(transfer::Encoding::Float16), folder / "a.rtt"));
  const std::vector<std::byte> whole = bytesOf(folder / "a.rtt");
  int refused = 0;
  for (std::size_t at = 0; at < 320; ++at) {
    std::vector<std::byte> bytes = whole;
    bytes[at] ^= std::byte(0x41);
    spill(folder / "b.rtt", bytes);
    const Result<transfer::EncodedRtt> read = readRtt(folder / "b.rtt");
    if (read)
      EXPECT_FALSE(faultOf(*read));
    else
      ++refused;
  }
  EXPECT_GT(refused, 50);
}

TEST(RttFile, NumbersThatAreNotFiniteAreNeitherWrittenNorRead) {
  const test::Folder folder;
  transfer::EncodedRtt rtt = exampleRtt(transfer::Encoding::Float32, false);
  ASSERT_TRUE(writeRtt(rtt, folder / "a.rtt"));
  std::vector<std::byte> bytes = bytesOf(folder / "a.rtt");
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + bytes.size() - 4, &nan, 4);
  spill(folder / "nan.rtt", bytes);
  const Result<transfer::EncodedRtt> read = readRtt(folder / "nan.rtt");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("finite"), std::string::npos);
  rtt.values.single[7] = nan;
  EXPECT_FALSE(writeRtt(rtt, folder / "b.rtt"));
  EXPECT_FALSE(std::filesystem::exists(folder / "b.rtt"));
}

TEST(RttFile, OtherFilesAreToldApart) {
  const test::Folder folder;
  const std::string text = "glTF but not an RTT";
  spill(folder / "x.rtt", std::as_bytes(std::span(text)));
  EXPECT_FALSE(isRtt(folder / "x.rtt"));
  EXPECT_FALSE(isRtt(folder / "nothing.rtt"));
  const Result<transfer::EncodedRtt> read = readRtt(folder / "x.rtt");
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().message.find("lambent rtt"), std::string::npos);
  const Status other = writeRtt(exampleRtt(transfer::Encoding::Float16), folder / "x.bin");
  ASSERT_FALSE(other);
  EXPECT_EQ(other.error().kind, ErrorKind::BadUsage);
}

}  // namespace
}  // namespace lambent::asset
