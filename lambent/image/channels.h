// Pixels with channels of any name and number: spectra, luminance, what no colour is.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::image {

/// A line of text in a file's header.
struct Attribute {
  std::string name, value;
};

/// Top row first, as Image.
struct ChannelImage {
  struct Channel {
    std::string name;           ///< 1 … 255 bytes, in no other channel
    std::vector<float> values;  ///< width·height, row after row from the top
  };

  int width = 0, height = 0;
  std::vector<Channel> channels;
  std::vector<Attribute> attributes;

  ChannelImage() = default;
  ChannelImage(int w, int h) : width(w), height(h) {}
  /// A further channel, of zeros. A reference stays good until the next one is added.
  Channel& add(std::string name) {
    channels.push_back({std::move(name), std::vector<float>(size_t(width) * size_t(height))});
    return channels.back();
  }
};

/// An .exr with 32-bit floats (ZIP), its attributes as strings. Atomic. BadUsage: another extension,
/// no pixels or no channels, two channels of one name. Readers take R, G, B, A and Y for colour (see
/// read()), whatever else there is.
Status write(const ChannelImage& image, const std::filesystem::path& path);

}  // namespace lambent::image
