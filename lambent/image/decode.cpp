#include "lambent/image/decode.h"

#include <new>

#include "lambent/image/formats.h"

namespace lambent::image {

using namespace formats;

Format formatOf(std::span<const std::byte> bytes) {
  if (isExr(bytes)) return Format::Exr;
  if (isHdr(bytes)) return Format::Hdr;
  if (isPng(bytes)) return Format::Png;
  if (isJpeg(bytes)) return Format::Jpeg;
  return isWebP(bytes) ? Format::WebP : Format::Unknown;
}

Result<Pixels8> decode8(std::span<const std::byte> bytes, std::string_view name,
                        file::Budget& budget) {
  Result<Codes> codes = report::badInput(std::string(name) +
                                         ": is no PNG, JPEG or WebP, by its first bytes; convert "
                                         "it to one of these");
  try {
    const Format format = formatOf(bytes);
    if (format == Format::Png) codes = readPng(bytes, name, Depth::Eight, budget);
    if (format == Format::Jpeg) codes = readJpeg(bytes, name, budget);
    if (format == Format::WebP) codes = readWebP(bytes, name, budget);
  } catch (const std::bad_alloc&) {
    return report::failed(std::string(name) + ": not enough memory to read the picture");
  }
  if (!codes) return codes.error();
  return Pixels8{codes->width, codes->height, std::move(codes->rgba8)};
}

Result<Pixels8> decode8(std::span<const std::byte> bytes, std::string_view name) {
  file::Budget budget;
  budget.addFile(bytes.size());
  return decode8(bytes, name, budget);
}

}  // namespace lambent::image
