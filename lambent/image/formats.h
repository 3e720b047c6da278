// The readers and writers of single formats, behind io.h. Internal to this room.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/image/io.h"
#include "lambent/report/result.h"

namespace lambent::image::formats {

using Bytes = std::span<const std::byte>;

/// `layer` names the channels before the dot; empty: the picture itself.
Result<Image> readExr(Bytes bytes, std::string_view name, std::string_view layer = {});
Result<Image> readHdr(Bytes bytes, std::string_view name);
Result<Image> readPngOrJpeg(Bytes bytes, std::string_view name);

Result<std::vector<std::byte>> writeExr(const Image& image, std::string_view name,
                                        const WriteOptions& options);
std::vector<std::byte> writeHdr(const Image& image);
Result<std::vector<std::byte>> writePng(const Image& image, std::string_view name);

bool isExr(Bytes bytes);
bool isHdr(Bytes bytes);
bool isPng(Bytes bytes);
bool isJpeg(Bytes bytes);

/// Refuses sizes that are not positive, beyond kMaxPixels, or more than the file can hold even if
/// every byte of it stood for `pixelsPerByte` pixels: the check before memory is taken.
Status checkSize(long long width, long long height, size_t fileBytes, std::string_view name,
                 size_t pixelsPerByte);

}  // namespace lambent::image::formats
