// OpenEXR pictures that are read. The library does the decompression; what is chosen here:
//   - the part and the channels that are the picture (exr_choice.h);
//   - colours become those of Rec. 709 (exr_stated.h);
//   - the display window as the picture: what the data window lacks is black, what it has beyond is
//     cut off. Of a map of all directions (`envmap`) the data window is the map, as OpenEXR has it;
//   - of several resolutions the highest.
#include <ImathBox.h>
#include <OpenEXR/ImfArray.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfPartType.h>
#include <OpenEXR/ImfRgbaFile.h>
#include <OpenEXR/ImfTestFile.h>
#include <OpenEXR/ImfTileDescription.h>
#include <half.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <new>
#include <optional>
#include <stdexcept>

#include <fmt/format.h>

#include "lambent/image/exr_choice.h"
#include "lambent/image/exr_stated.h"
#include "lambent/image/exr_streams.h"
#include "lambent/image/formats.h"

namespace lambent::image::formats {
namespace {

using Imath::Box2i;

/// The most pixels that one byte of a file can stand for. Deflate makes at most 1032 bytes of one,
/// two bytes a pixel in a half channel; the others make less. DWA spends some 240 bytes on 32 or
/// 256 lines of a constant picture, however wide: a black 2048² picture has 2,100 pixels a byte, a
/// black 16384² one eight times that.
size_t maxPixelsPerByte(Imf::Compression compression) {
  const bool dwa = compression == Imf::DWAA_COMPRESSION || compression == Imf::DWAB_COMPRESSION;
  return dwa ? 65536 : 600;
}

/// The part of the data window that the picture shows, in both coordinates.
struct Windows {
  Box2i data, display, common;
  int width() const { return display.max.x - display.min.x + 1; }
  int height() const { return display.max.y - display.min.y + 1; }
};

/// What the library takes for blocks of lines or tiles before it knows whether they are in the
/// file.
std::uint64_t bytesForBlocks(const Imf::Header& header) {
  std::uint64_t pixel = 0;
  for (auto i = header.channels().begin(); i != header.channels().end(); ++i) {
    pixel += i.channel().type == Imf::HALF ? 2 : 4;
  }
  const Box2i& data = header.dataWindow();
  const auto width =
      static_cast<std::uint64_t>(static_cast<long long>(data.max.x) - data.min.x + 1);
  if (!header.hasTileDescription())
    return 2 * 256 * width * pixel;  // DWAB's blocks are the largest
  const Imf::TileDescription& tile = header.tileDescription();
  // Lines are read out of a row of tiles, which is kept.
  return (width + 2 * std::uint64_t(tile.xSize)) * tile.ySize * pixel;
}

Result<Windows> windowsOf(const Imf::Header& header, size_t fileBytes, std::string_view name,
                          file::Budget& budget) {
  Windows w{header.dataWindow(), header.displayWindow(), {}};
  if (statedMap(header)) w.display = w.data;
  for (const Box2i& box : {w.data, w.display}) {
    if (Status sane = checkSize(static_cast<long long>(box.max.x) - box.min.x + 1,
                                static_cast<long long>(box.max.y) - box.min.y + 1, fileBytes, name,
                                maxPixelsPerByte(header.compression()));
        !sane) {
      return sane.error();
    }
  }
  if (Status fits = budget.hold(bytesForBlocks(header), std::string(name) + ": its blocks");
      !fits) {
    return fits.error();
  }
  const size_t turned = statedMap(header) == MapKind::Cube ? sizeof(Rgb) : 0;
  if (Status fits = holdPixels(w.width(), w.height(), sizeof(Rgb) + 4 + turned, name, budget);
      !fits) {
    return fits.error();
  }
  w.common.min.x = std::max(w.data.min.x, w.display.min.x);
  w.common.min.y = std::max(w.data.min.y, w.display.min.y);
  w.common.max.x = std::min(w.data.max.x, w.display.max.x);
  w.common.max.y = std::min(w.data.max.y, w.display.max.y);
  if (w.common.isEmpty()) {
    return report::badInput(std::string(name) +
                            ": its data window lies wholly outside of its display window: there is "
                            "nothing to see");
  }
  return w;
}

/// Reads whole lines of the data window into planes, a strip at a time.
class StripReader {
 public:
  StripReader(Imf::InputPart& part, const ExrColour& channels, const Windows& windows, int lines)
      : part_(part),
        channels_(channels),
        left_(windows.data.min.x),
        width_(windows.data.max.x - windows.data.min.x + 1) {
    for (std::vector<float>& plane : planes_) plane.resize(size_t(width_) * lines);
    if (grey()) planes_[1].clear(), planes_[2].clear();
    if (channels.alpha.empty()) planes_[3].clear();
  }

  void read(int top, int bottom) {
    Imf::FrameBuffer frame;
    for (int p = 0; p < 4; ++p) {
      if (planes_[p].empty()) continue;
      char* const origin =
          reinterpret_cast<char*>(planes_[p].data()) -
          (std::ptrdiff_t(top) * width_ + left_) * static_cast<std::ptrdiff_t>(sizeof(float));
      frame.insert(p < 3 ? channels_.channels[p] : channels_.alpha,
                   Imf::Slice(Imf::FLOAT, origin, sizeof(float), sizeof(float) * width_, 1, 1,
                              p < 3 ? 0.0 : 1.0));
    }
    part_.setFrameBuffer(frame);
    part_.readPixels(top, bottom);
    top_ = top;
  }
  Rgb colour(int x, int y) const {
    const size_t i = at(x, y);
    if (grey()) return Rgb::Constant(planes_[0][i]);
    return Rgb(planes_[0][i], planes_[1][i], planes_[2][i]);
  }
  float alpha(int x, int y) const { return planes_[3][at(x, y)]; }

 private:
  /// Grey asks for one channel: a name may stand only once in a frame buffer.
  bool grey() const { return channels_.channels[0] == channels_.channels[1]; }
  size_t at(int x, int y) const { return size_t(y - top_) * width_ + (x - left_); }

  Imf::InputPart& part_;
  const ExrColour& channels_;
  int left_, width_, top_ = 0;
  std::array<std::vector<float>, 4> planes_;
};

Image readColour(Imf::InputPart& part, const ExrColour& channels, const Windows& w) {
  // The first line alone before memory is taken for all: most files that lie about their size fail
  // here.
  StripReader(part, channels, w, 1).read(w.common.min.y, w.common.min.y);
  Image image(w.width(), w.height());
  if (!channels.alpha.empty()) image.alpha.assign(image.pixels.size(), 0.0f);
  constexpr int kStripLines = 256;  // DWAB packs as many into one block
  StripReader strip(part, channels, w, std::min(kStripLines, w.common.max.y - w.common.min.y + 1));
  for (int top = w.common.min.y; top <= w.common.max.y; top += kStripLines) {
    const int bottom = std::min(top + kStripLines - 1, w.common.max.y);
    strip.read(top, bottom);
    for (int y = top; y <= bottom; ++y) {
      for (int x = w.common.min.x; x <= w.common.max.x; ++x) {
        const size_t to = size_t(y - w.display.min.y) * image.width + (x - w.display.min.x);
        image.pixels[to] = strip.colour(x, y);
        if (!channels.alpha.empty()) image.alpha[to] = strip.alpha(x, y);
      }
    }
  }
  return image;
}

// Luminance and subsampled chroma: the library upsamples and converts, in half precision.
Image readChroma(MemoryInput& input, const ExrColour& channels, const Windows& w) {
  input.seekg(0);
  Imf::RgbaInputFile file(input);
  std::vector<Imf::Rgba> line(w.data.max.x - w.data.min.x + 1);
  file.setFrameBuffer(line.data() - w.data.min.x, 1, 0);
  file.readPixels(w.common.min.y);  // as above: before memory is taken
  Image image(w.width(), w.height());
  if (!channels.alpha.empty()) image.alpha.assign(image.pixels.size(), 0.0f);
  for (int y = w.common.min.y; y <= w.common.max.y; ++y) {
    file.readPixels(y);
    for (int x = w.common.min.x; x <= w.common.max.x; ++x) {
      const Imf::Rgba& pixel = line[x - w.data.min.x];
      const size_t to = size_t(y - w.display.min.y) * image.width + (x - w.display.min.x);
      image.pixels[to] = Rgb(pixel.r, pixel.g, pixel.b);
      if (!image.alpha.empty()) image.alpha[to] = pixel.a;
    }
  }
  return image;
}

std::uint64_t pixelsIn(const Box2i& box) {
  return static_cast<std::uint64_t>(box.max.x - box.min.x + 1) *
         static_cast<std::uint64_t>(box.max.y - box.min.y + 1);
}

void tellWindows(const Windows& w, std::string_view name, Findings& findings) {
  const std::uint64_t common = pixelsIn(w.common);
  const std::uint64_t black = pixelsIn(w.display) - common, cut = pixelsIn(w.data) - common;
  if (black > 0)
    findings.push_back(
        {Severity::Note, "exr-windows-black",
         fmt::format("{}: its data window leaves {} pixels of the picture free: they are "
                     "black",
                     name, black),
         black});
  if (cut > 0)
    findings.push_back(
        {Severity::Note, "exr-windows-cut",
         fmt::format("{}: {} pixels of its data window lie outside of the picture (its "
                     "display window) and were left out",
                     name, cut),
         cut, true});
}

Status checkSampling(const Imf::Header& header, const ExrColour& colour, std::string_view name) {
  for (const std::string& channel :
       {colour.channels[0], colour.channels[1], colour.channels[2], colour.alpha}) {
    const Imf::Channel* const found =
        channel.empty() ? nullptr : header.channels().findChannel(channel);
    if (found && (found->xSampling != 1 || found->ySampling != 1))
      return report::badInput(
          fmt::format("{}: channel {} is subsampled; save it at full resolution", name, channel));
  }
  return Status::ok();
}

/// The library makes colour of luminance and chroma in the first part alone.
Result<Image> readPixels(Imf::MultiPartInputFile& file, MemoryInput& input, ExrColour colour,
                         const Windows& windows, std::string_view name, Findings& findings) {
  const bool plain = colour.part == 0 && colour.layer.empty();
  if (colour.model == ExrColour::Model::Chroma && plain) return readChroma(input, colour, windows);
  if (colour.model == ExrColour::Model::Chroma)
    findings.push_back(
        {Severity::Warning, "exr-chroma",
         fmt::format("{}: luminance with chroma is read as colour from an unnamed layer of "
                     "the first part alone; this one is grey: save it as RGB",
                     name),
         1, true});
  if (Status sampled = checkSampling(file.header(colour.part), colour, name); !sampled)
    return sampled.error();
  Imf::InputPart part(file, colour.part);
  return readColour(part, colour, windows);
}

/// Brings colours and a cube's faces into the conventions of this room.
Status convert(const Imf::Header& header, ExrColour::Model model, std::string_view name,
               PictureFile& picture) {
  using Model = ExrColour::Model;
  std::optional<radiometry::Primaries> primaries;
  if (model == Model::Xyz) primaries = radiometry::xyzPrimaries();
  if (model == Model::Rgb || model == Model::Chroma)
    primaries = statedPrimaries(header, name, picture.findings);
  if (primaries && toRec709(*primaries, picture.image)) picture.converted = true;
  tellUnused(header, name, picture.findings);
  picture.map = statedMap(header);
  if (picture.map != MapKind::Cube) return Status::ok();
  std::optional<Image> cube = cubeOfEnvmap(picture.image);
  if (!cube)
    return report::badInput(
        fmt::format("{}: says that it is a cube map, but has {} x {} pixels; six "
                    "faces in a column are 1:6",
                    name, picture.image.width, picture.image.height));
  picture.image = std::move(*cube);
  return Status::ok();
}

/// Before colours are.
bool isConverted(const ExrColour& colour, const Windows& w, const Imf::Header& header) {
  using Model = ExrColour::Model;
  const bool plain = colour.model == Model::Rgb || colour.model == Model::Luminance;
  return colour.part != 0 || !colour.layer.empty() || !plain || w.data != w.display ||
         statedMap(header) == MapKind::Cube;
}

Result<PictureFile> readChecked(Bytes bytes, std::string_view name, file::Budget& budget,
                                std::string_view layer) {
  if (Status sound = checkExrHeader(bytes, name); !sound) return sound.error();
  const std::string streamName(name);
  MemoryInput input(bytes, streamName.c_str());
  // No reconstruction of a missing offset table: it would scan the file for what a writer that was
  // killed has left, and half a picture is not wanted.
  Imf::MultiPartInputFile file(input, 0, false);
  Result<WithFindings<ExrColour>> choice = chooseColour(file, layer, name);
  if (!choice) return choice.error();
  const Imf::Header& header = file.header(choice->value.part);
  const Result<Windows> windows = windowsOf(header, bytes.size(), name, budget);
  if (!windows) return windows.error();
  PictureFile picture;
  picture.findings = std::move(choice->findings);
  picture.converted = isConverted(choice->value, *windows, header);
  Result<Image> pixels = readPixels(file, input, choice->value, *windows, name, picture.findings);
  if (!pixels) return pixels.error();
  picture.image = std::move(*pixels);
  tellWindows(*windows, name, picture.findings);
  if (Status done = convert(header, choice->value.model, name, picture); !done) return done.error();
  return picture;
}

}  // namespace

bool isExr(Bytes bytes) {
  constexpr std::array<unsigned char, 4> kMagic{0x76, 0x2f, 0x31, 0x01};
  return bytes.size() >= 4 && std::memcmp(bytes.data(), kMagic.data(), 4) == 0;
}

Result<PictureFile> readExr(Bytes bytes, std::string_view name, file::Budget& budget,
                            std::string_view layer) {
  try {
    return readChecked(bytes, name, budget, layer);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    std::string what = problem.what();
    std::replace(what.begin(), what.end(), '\n', ' ');
    return report::badInput(std::string(name) + ": cannot be read as OpenEXR: " + what +
                            " The file is damaged or cut off");
  }
}

}  // namespace lambent::image::formats
