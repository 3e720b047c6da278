#include "lambent/image/io.h"

#include <cmath>
#include <limits>
#include <new>

#include <fmt/format.h>

#include "lambent/file/atomic_file.h"
#include "lambent/file/extension.h"
#include "lambent/image/channels.h"
#include "lambent/image/decode.h"
#include "lambent/image/formats.h"
#include "lambent/radiometry/srgb.h"

namespace lambent::image {
namespace {

Result<std::vector<std::byte>> encode(const Image& image, const std::filesystem::path& path,
                                      const WriteOptions& options) {
  const std::string extension = file::extensionOf(path);
  if (extension == ".exr") return formats::writeExr(image, path.string(), options);
  if (extension == ".hdr") return formats::writeHdr(image);
  return formats::writePng(image, path.string());
}

template <class Sample>
Image toImage(const formats::Codes& codes, const std::vector<Sample>& rgba) {
  constexpr int kLargest = std::numeric_limits<Sample>::max();
  std::vector<float> linear(size_t(kLargest) + 1);
  for (int i = 0; i <= kLargest; ++i) {
    const float code = static_cast<float>(i) / kLargest;
    linear[i] = codes.colour.gamma ? std::pow(code, static_cast<float>(1.0 / *codes.colour.gamma))
                                   : radiometry::srgbDecode(code);
  }
  Image image(codes.width, codes.height);
  if (codes.hasAlpha) image.alpha.resize(image.pixels.size());
  for (size_t i = 0; i < image.pixels.size(); ++i) {
    const float alpha = codes.hasAlpha ? static_cast<float>(rgba[4 * i + 3]) / kLargest : 1.0f;
    for (int c = 0; c < 3; ++c) image.pixels[i][c] = linear[rgba[4 * i + c]] * alpha;
    if (codes.hasAlpha) image.alpha[i] = alpha;
  }
  return image;
}

/// A profile that is not sRGB's own is not used; nor is one whose name says nothing.
void tellProfile(const formats::CodedColour& colour, std::string_view name, Findings& findings) {
  if (!colour.profile || colour.profile->find("sRGB") != std::string::npos) return;
  findings.push_back(
      {Severity::Note, "colour-profile",
       fmt::format("{}: its colour profile ({}) is not used; its colours are taken as "
                   "sRGB: convert it to sRGB, or to a linear .exr",
                   name, *colour.profile),
       1, true});
}

/// The codes of PNG, JPEG and WebP become linear: sRGB-encoded, or as a PNG says.
Result<PictureFile> linearised(Result<formats::Codes> codes, std::string_view name,
                               const ReadOptions& options, file::Budget& budget) {
  if (!codes) return codes.error();
  if (Status fits =
          formats::holdPixels(codes->width, codes->height, codes->hasAlpha ? 16 : 12, name, budget);
      !fits) {
    return fits.error();
  }
  if (options.plainCodes) codes->colour = {};
  PictureFile picture;
  picture.codes = true;
  picture.image =
      codes->rgba16.empty() ? toImage(*codes, codes->rgba8) : toImage(*codes, codes->rgba16);
  if (codes->colour.primaries)
    picture.converted = formats::toRec709(*codes->colour.primaries, picture.image);
  tellProfile(codes->colour, name, picture.findings);
  return picture;
}

Result<PictureFile> decodeAs(Format format, std::span<const std::byte> bytes, std::string_view name,
                             const ReadOptions& options, file::Budget& budget) {
  if (!options.layer.empty() && format != Format::Exr)
    return report::badInput(std::string(name) + ": only OpenEXR pictures have further layers");
  switch (format) {
    case Format::Exr:
      return formats::readExr(bytes, name, budget, options.layer);
    case Format::Hdr:
      return formats::readHdr(bytes, name, budget);
    case Format::Png:
      return linearised(formats::readPng(bytes, name, formats::Depth::AsStored, budget), name,
                        options, budget);
    case Format::Jpeg:
      return linearised(formats::readJpeg(bytes, name, budget), name, options, budget);
    case Format::WebP:
      return linearised(formats::readWebP(bytes, name, budget), name, options, budget);
    case Format::Unknown:
      break;
  }
  if (bytes.empty()) return report::badInput(std::string(name) + ": the file is empty");
  return report::badInput(std::string(name) +
                          ": not a picture that can be read, by its first bytes; convert it to "
                          "OpenEXR, Radiance HDR, PNG, JPEG or WebP");
}

}  // namespace

namespace formats {

bool toRec709(const radiometry::Primaries& primaries, Image& image) {
  if (isNear(primaries, radiometry::rec709Primaries())) return false;
  const std::optional<Mat3d> exact = rec709From(primaries);
  if (!exact) return false;
  const Mat3 matrix = exact->cast<float>();
  for (Rgb& pixel : image.pixels)
    if (pixel.isFinite().all()) pixel = (matrix * pixel.matrix()).array();
  return true;
}

Error damaged(std::string_view name, const std::string& what, size_t at) {
  return report::badInput(std::string(name) + ": " + what + " at byte " + std::to_string(at) +
                          "; the file is damaged or cut off");
}

Status holdPixels(long long width, long long height, size_t bytesPerPixel, std::string_view name,
                  file::Budget& budget) {
  const auto pixels = static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(height);
  return budget.hold(pixels * bytesPerPixel, std::string(name) + ": a picture of " +
                                                 std::to_string(width) + "×" +
                                                 std::to_string(height) + " pixels");
}

Status checkSize(long long width, long long height, size_t fileBytes, std::string_view name,
                 size_t pixelsPerByte) {
  const std::string size = std::to_string(width) + "×" + std::to_string(height);
  if (width <= 0 || height <= 0) {
    return report::badInput(std::string(name) + ": its header says " + size +
                            " pixels; the file is damaged");
  }
  const auto limit = static_cast<long long>(kMaxPixels);
  if (width > limit || height > limit || width * height > limit) {
    return report::badInput(std::string(name) + ": its header says " + size +
                            " pixels; the most that can be read are " + std::to_string(limit));
  }
  if (static_cast<size_t>(width * height) / pixelsPerByte > fileBytes) {
    return report::badInput(std::string(name) + ": its header says " + size +
                            " pixels, which cannot come out of " + std::to_string(fileBytes) +
                            " bytes; the file is damaged or cut off");
  }
  return Status::ok();
}

}  // namespace formats

Result<PictureFile> decodePicture(std::span<const std::byte> bytes, std::string_view name,
                                  const ReadOptions& options) {
  file::Budget budget(options.memoryLimit);
  budget.addFile(bytes.size());
  try {
    return decodeAs(formatOf(bytes), bytes, name, options, budget);
  } catch (const std::bad_alloc&) {
    return report::failed(std::string(name) + ": not enough memory to read the picture");
  }
}

Result<PictureFile> readPicture(const std::filesystem::path& path, const ReadOptions& options) {
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return decodePicture(*bytes, path.string(), options);
}

Result<Image> decode(std::span<const std::byte> bytes, std::string_view name,
                     const ReadOptions& options) {
  Result<PictureFile> picture = decodePicture(bytes, name, options);
  if (!picture) return picture.error();
  return std::move(picture->image);
}

Result<Image> read(const std::filesystem::path& path, const ReadOptions& options) {
  Result<PictureFile> picture = readPicture(path, options);
  if (!picture) return picture.error();
  return std::move(picture->image);
}

Result<Image> readLayer(const std::filesystem::path& path, std::string_view layer,
                        const ReadOptions& options) {
  return read(path, {options.memoryLimit, std::string(layer)});
}

Result<Image> decodeLayer(std::span<const std::byte> bytes, std::string_view name,
                          std::string_view layer, const ReadOptions& options) {
  return decode(bytes, name, {options.memoryLimit, std::string(layer)});
}

Status checkWritableFormat(const std::filesystem::path& path) {
  const std::string extension = file::extensionOf(path);
  if (extension == ".exr" || extension == ".hdr" || extension == ".png") return Status::ok();
  return report::badUsage(path.string() + ": pictures are written as .exr, .hdr or .png, not " +
                          (extension.empty() ? "without an extension" : "as " + extension));
}

Status write(const Image& image, const std::filesystem::path& path, const WriteOptions& options) {
  assert(image.pixels.size() == size_t(image.width) * image.height);
  assert(image.alpha.empty() || image.alpha.size() == image.pixels.size());
  if (Status known = checkWritableFormat(path); !known) return known;
  if (image.pixels.empty()) {
    return report::badUsage(path.string() + ": a picture without pixels cannot be written");
  }
  try {
    const Result<std::vector<std::byte>> bytes = encode(image, path, options);
    if (!bytes) return bytes.error();
    return file::writeAtomically(path, *bytes);
  } catch (const std::bad_alloc&) {
    return report::failed(path.string() + ": not enough memory to write the picture");
  }
}

Status write(const ChannelImage& image, const std::filesystem::path& path) {
  if (file::extensionOf(path) != ".exr")
    return report::badUsage(path.string() + ": channels of any name are written as .exr alone");
  if (image.width <= 0 || image.height <= 0 || image.channels.empty())
    return report::badUsage(path.string() + ": a picture without pixels cannot be written");
  for (size_t i = 0; i < image.channels.size(); ++i) {
    assert(image.channels[i].values.size() == size_t(image.width) * size_t(image.height));
    for (size_t j = 0; j < i; ++j)
      if (image.channels[i].name == image.channels[j].name)
        return report::badUsage(path.string() + ": two channels are called " +
                                image.channels[i].name);
  }
  try {
    const Result<std::vector<std::byte>> bytes = formats::writeExr(image, path.string());
    if (!bytes) return bytes.error();
    return file::writeAtomically(path, *bytes);
  } catch (const std::bad_alloc&) {
    return report::failed(path.string() + ": not enough memory to write the picture");
  }
}

}  // namespace lambent::image
