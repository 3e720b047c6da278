// OpenEXR files of any parts, channels and attributes for tests, written by OpenEXR itself.
#pragma once

#include <ImathBox.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include <map>
#include <string>
#include <vector>

namespace lambent::image {

/// A part of one value in every pixel of each channel.
struct ExrPart {
  std::string name;
  std::map<std::string, float> channels;
  Imf::Header header = Imf::Header(8, 4);
};

inline void writeExrParts(const std::string& path, std::vector<ExrPart> parts) {
  std::vector<Imf::Header> headers;
  for (ExrPart& part : parts) {
    part.header.setType(Imf::SCANLINEIMAGE);
    if (!part.name.empty()) part.header.setName(part.name);
    for (const auto& [name, value] : part.channels)
      part.header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    headers.push_back(part.header);
  }
  Imf::MultiPartOutputFile file(path.c_str(), headers.data(), static_cast<int>(headers.size()));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const Imath::Box2i& window = headers[i].dataWindow();
    const auto width = static_cast<std::size_t>(window.max.x - window.min.x + 1);
    const int height = window.max.y - window.min.y + 1;
    std::map<std::string, std::vector<float>> planes;
    Imf::FrameBuffer frame;
    for (const auto& [name, value] : parts[i].channels) {
      std::vector<float>& plane = planes[name];
      plane.assign(width * static_cast<std::size_t>(height), value);
      frame.insert(name, Imf::Slice::Make(Imf::FLOAT, plane.data(), window));
    }
    Imf::OutputPart part(file, static_cast<int>(i));
    part.setFrameBuffer(frame);
    part.writePixels(height);
  }
}

/// R, G and B of a layer.
inline std::map<std::string, float> rgbOf(const std::string& layer, float r, float g, float b) {
  const std::string prefix = layer.empty() ? "" : layer + ".";
  return {{prefix + "R", r}, {prefix + "G", g}, {prefix + "B", b}};
}

inline std::map<std::string, float> operator+(std::map<std::string, float> a,
                                              const std::map<std::string, float>& b) {
  a.insert(b.begin(), b.end());
  return a;
}

}  // namespace lambent::image
