#include "lambent/image/io.h"

#include <new>

#include "lambent/file/atomic_file.h"
#include "lambent/file/extension.h"
#include "lambent/image/formats.h"

namespace lambent::image {
namespace {

Result<std::vector<std::byte>> encode(const Image& image, const std::filesystem::path& path,
                                      const WriteOptions& options) {
  const std::string extension = file::extensionOf(path);
  if (extension == ".exr") return formats::writeExr(image, path.string(), options);
  if (extension == ".hdr") return formats::writeHdr(image);
  return formats::writePng(image, path.string());
}

}  // namespace

namespace formats {

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

Result<Image> decode(std::span<const std::byte> bytes, std::string_view name) {
  try {
    if (formats::isExr(bytes)) return formats::readExr(bytes, name);
    if (formats::isHdr(bytes)) return formats::readHdr(bytes, name);
    if (formats::isPng(bytes) || formats::isJpeg(bytes)) return formats::readPngOrJpeg(bytes, name);
  } catch (const std::bad_alloc&) {
    return report::failed(std::string(name) + ": not enough memory to read the picture");
  }
  if (bytes.empty()) return report::badInput(std::string(name) + ": the file is empty");
  return report::badInput(std::string(name) +
                          ": not a picture that can be read, by its first bytes; convert it to "
                          "OpenEXR, Radiance HDR, PNG or JPEG");
}

Result<Image> read(const std::filesystem::path& path) {
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  return decode(*bytes, path.string());
}

Result<Image> readLayer(const std::filesystem::path& path, std::string_view layer) {
  const Result<std::vector<std::byte>> bytes = file::readWhole(path);
  if (!bytes) return bytes.error();
  if (!formats::isExr(*bytes)) {
    return report::badInput(path.string() + ": only OpenEXR pictures have further layers");
  }
  try {
    return formats::readExr(*bytes, path.string(), layer);
  } catch (const std::bad_alloc&) {
    return report::failed(path.string() + ": not enough memory to read the picture");
  }
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

}  // namespace lambent::image
