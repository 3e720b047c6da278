// OpenEXR pictures that are written: scan lines, ZIP, one part, channels of one type.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>
#include <half.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <new>

#include "lambent/image/exr_streams.h"
#include "lambent/image/formats.h"

namespace lambent::image::formats {
namespace {

/// One channel's pixels in the type that goes to the file.
struct Plane {
  std::string name;
  std::vector<char> data;
};

Plane makePlane(std::string name, size_t count, bool halfFloat, const auto& valueAt) {
  Plane plane{std::move(name), std::vector<char>(count * (halfFloat ? 2 : 4))};
  for (size_t i = 0; i < count; ++i) {
    const float value = valueAt(i);
    if (halfFloat) {
      const Imath::half h(std::isfinite(value) ? std::clamp(value, -65504.0f, 65504.0f) : value);
      std::memcpy(plane.data.data() + 2 * i, &h, 2);
    } else {
      std::memcpy(plane.data.data() + 4 * i, &value, 4);
    }
  }
  return plane;
}

void addPlanes(const Image& image, const std::string& prefix, bool halfFloat,
               std::vector<Plane>& planes) {
  for (int c = 0; c < 3; ++c) {
    planes.push_back(makePlane(prefix + "RGB"[c], image.pixels.size(), halfFloat,
                               [&](size_t i) { return image.pixels[i][c]; }));
  }
  if (!image.alpha.empty()) {
    planes.push_back(makePlane(prefix + "A", image.alpha.size(), halfFloat,
                               [&](size_t i) { return image.alpha[i]; }));
  }
}

/// Where a channel's pixels lie, row after row.
struct Slice {
  std::string name;
  const void* data;
};

Result<std::vector<std::byte>> packExr(int width, int height, bool halfFloat,
                                       const std::vector<Slice>& slices,
                                       const std::vector<Attribute>& attributes,
                                       std::string_view name) {
  const Imf::PixelType type = halfFloat ? Imf::HALF : Imf::FLOAT;
  const size_t size = halfFloat ? 2 : 4;
  try {
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    for (const Attribute& attribute : attributes)
      header.insert(attribute.name, Imf::StringAttribute(attribute.value));
    Imf::FrameBuffer frame;
    for (const Slice& slice : slices) {
      header.channels().insert(slice.name, Imf::Channel(type));
      // The library writes nothing through this.
      char* const data = const_cast<char*>(static_cast<const char*>(slice.data));
      frame.insert(slice.name, Imf::Slice(type, data, size, size * size_t(width)));
    }
    const std::string streamName(name);
    MemoryOutput output(streamName.c_str());
    {
      Imf::OutputFile file(output, header);
      file.setFrameBuffer(frame);
      file.writePixels(height);
    }
    // Of blocks that could not be packed, for want of memory, the library (3.1.5) says nothing and
    // leaves them out.
    MemoryInput input(output.bytes, streamName.c_str());
    if (!Imf::MultiPartInputFile(input, 0, false).partComplete(0)) throw std::bad_alloc();
    return std::move(output.bytes);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    return report::failed(std::string(name) + ": cannot be written as OpenEXR: " + problem.what());
  }
}

}  // namespace

Result<std::vector<std::byte>> writeExr(const Image& image, std::string_view name,
                                        const WriteOptions& options) {
  std::vector<Plane> planes;
  addPlanes(image, "", options.halfFloat, planes);
  for (const auto& [layer, picture] : options.layers) {
    if (picture->width != image.width || picture->height != image.height) {
      return report::badUsage(std::string(name) + ": the layer " + layer +
                              " has another size than the picture");
    }
    addPlanes(*picture, layer + ".", options.halfFloat, planes);
  }
  std::vector<Slice> slices;
  for (const Plane& plane : planes) slices.push_back({plane.name, plane.data.data()});
  return packExr(image.width, image.height, options.halfFloat, slices, {}, name);
}

Result<std::vector<std::byte>> writeExr(const ChannelImage& image, std::string_view name) {
  std::vector<Slice> slices;
  for (const ChannelImage::Channel& channel : image.channels)
    slices.push_back({channel.name, channel.values.data()});
  return packExr(image.width, image.height, false, slices, image.attributes, name);
}

}  // namespace lambent::image::formats
