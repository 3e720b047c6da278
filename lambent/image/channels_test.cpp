// Channels of any name, read back by OpenEXR itself.
#include "lambent/image/channels.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <limits>

#include "lambent/image/io.h"
#include "lambent/image/test_pictures.h"

namespace lambent::image {
namespace {

using ChannelFiles = FolderTest;

ChannelImage spectrum() {
  ChannelImage image(5, 3);
  for (const char* name : {"S0.550,000000nm", "S0.450,500000nm", "Y"}) {
    ChannelImage::Channel& channel = image.add(name);
    for (size_t i = 0; i < channel.values.size(); ++i)
      channel.values[i] = float(i) * 1e-7f + float(image.channels.size());
  }
  image.channels[0].values[7] = std::numeric_limits<float>::infinity();
  image.attributes = {{"spectralLayoutVersion", "1.0"}, {"emissiveUnits", "W.m^-2.sr^-1.nm^-1"}};
  return image;
}

TEST_F(ChannelFiles, NamesValuesAndAttributesComeBack) {
  const ChannelImage image = spectrum();
  const std::string path = (folder_ / "a.exr").string();
  const Status done = write(image, path);
  ASSERT_TRUE(done) << done.error().message;

  Imf::InputFile file(path.c_str());
  const Imf::Header& header = file.header();
  for (const Attribute& attribute : image.attributes) {
    const auto* found = header.findTypedAttribute<Imf::StringAttribute>(attribute.name.c_str());
    ASSERT_NE(found, nullptr) << attribute.name;
    EXPECT_EQ(found->value(), attribute.value);
  }
  ASSERT_EQ(header.dataWindow().max.x, 4);
  ASSERT_EQ(header.dataWindow().max.y, 2);
  size_t count = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) ++count;
  EXPECT_EQ(count, image.channels.size());
  for (const ChannelImage::Channel& channel : image.channels) {
    const Imf::Channel* const found = header.channels().findChannel(channel.name);
    ASSERT_NE(found, nullptr) << channel.name;
    EXPECT_EQ(found->type, Imf::FLOAT);
    std::vector<float> values(15);
    Imf::FrameBuffer frame;
    frame.insert(channel.name,
                 Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(values.data()), 4, 20));
    file.setFrameBuffer(frame);
    file.readPixels(0, 2);
    EXPECT_EQ(values, channel.values) << channel.name;
  }
}

TEST_F(ChannelFiles, LuminanceIsReadAsGrey) {
  ASSERT_TRUE(write(spectrum(), folder_ / "a.exr"));
  const Result<Image> back = read(folder_ / "a.exr");
  ASSERT_TRUE(back) << back.error().message;
  EXPECT_EQ(back->at(2, 1)[1], 3.0f + 7e-7f);
}

TEST_F(ChannelFiles, WhatMakesNoFileIsRefused) {
  const auto refused = [&](const ChannelImage& image, const char* name) {
    const Status status = write(image, folder_ / name);
    EXPECT_FALSE(status);
    EXPECT_FALSE(std::filesystem::exists(folder_ / name));
    return status ? ErrorKind::Failed : status.error().kind;
  };
  EXPECT_EQ(refused(spectrum(), "a.png"), ErrorKind::BadUsage);
  EXPECT_EQ(refused(ChannelImage(), "a.exr"), ErrorKind::BadUsage);
  EXPECT_EQ(refused(ChannelImage(4, 2), "a.exr"), ErrorKind::BadUsage);
  ChannelImage twice = spectrum();
  twice.channels[1].name = "Y";
  EXPECT_EQ(refused(twice, "a.exr"), ErrorKind::BadUsage);
  EXPECT_FALSE(write(spectrum(), folder_ / "nowhere" / "a.exr"));
}

}  // namespace
}  // namespace lambent::image
