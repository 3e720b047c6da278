// The readers and writers of single formats, behind io.h and decode.h. Internal to this room.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/file/budget.h"
#include "lambent/image/channels.h"
#include "lambent/image/image.h"
#include "lambent/image/io.h"
#include "lambent/radiometry/primaries.h"
#include "lambent/report/result.h"

namespace lambent::image::formats {

using Bytes = std::span<const std::byte>;

/// `layer`: see ReadOptions.
Result<PictureFile> readExr(Bytes bytes, std::string_view name, file::Budget& budget,
                            std::string_view layer = {});
/// Walks the headers of an EXR file and checks every size in them against the bytes that follow:
/// OpenEXR takes memory for an attribute before it reads it.
Status checkExrHeader(Bytes bytes, std::string_view name);
Result<PictureFile> readHdr(Bytes bytes, std::string_view name, file::Budget& budget);

/// What a file of codes says that they mean.
struct CodedColour {
  std::optional<double> gamma;  ///< PNG: code = light^gamma, unless it is that of sRGB or nearly so
  std::optional<radiometry::Primaries> primaries;  ///< PNG
  std::optional<std::string> profile;  ///< the name of an ICC profile, which is not used
};

/// The pixels of PNG, JPEG and WebP as the file has them: four codes a pixel, top row first.
struct Codes {
  int width = 0, height = 0;
  bool hasAlpha = false;
  CodedColour colour;
  std::vector<std::uint8_t> rgba8;
  std::vector<std::uint16_t> rgba16;  ///< instead of rgba8
};
enum class Depth { Eight, AsStored };  ///< whether 16-bit codes stay 16-bit codes

/// What the codes take is held in `budget` when these return.
Result<Codes> readPng(Bytes bytes, std::string_view name, Depth depth, file::Budget& budget);
Result<Codes> readJpeg(Bytes bytes, std::string_view name, file::Budget& budget);
Result<Codes> readWebP(Bytes bytes, std::string_view name, file::Budget& budget);

Result<std::vector<std::byte>> writeExr(const Image& image, std::string_view name,
                                        const WriteOptions& options);
Result<std::vector<std::byte>> writeExr(const ChannelImage& image, std::string_view name);
std::vector<std::byte> writeHdr(const Image& image);
Result<std::vector<std::byte>> writePng(const Image& image, std::string_view name);

bool isExr(Bytes bytes);
bool isHdr(Bytes bytes);
bool isPng(Bytes bytes);
bool isJpeg(Bytes bytes);
bool isWebP(Bytes bytes);

/// Linear colours, mixtures of `primaries`, become those of Rec. 709; a pixel with a channel that is
/// not finite stays as it is. False: nothing was to be done, or `primaries` span no triangle.
bool toRec709(const radiometry::Primaries& primaries, Image& image);

/// "NAME: WHAT at byte AT; the file is damaged or cut off"
Error damaged(std::string_view name, const std::string& what, size_t at);

/// Refuses sizes that are not positive, beyond kMaxPixels, or more than the file can hold even if
/// every byte of it stood for `pixelsPerByte` pixels: the check before memory is taken.
Status checkSize(long long width, long long height, size_t fileBytes, std::string_view name,
                 size_t pixelsPerByte);
/// Holds `bytesPerPixel` for each pixel.
Status holdPixels(long long width, long long height, size_t bytesPerPixel, std::string_view name,
                  file::Budget& budget);

}  // namespace lambent::image::formats
