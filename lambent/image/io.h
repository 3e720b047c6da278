// Files ⇄ Image, by extension: .exr (every compression OpenEXR reads; written ZIP, half or float),
// .hdr (Radiance RGBE), .png (8 or 16 bit; colour is sRGB-encoded and becomes linear). JPEG and
// WebP are read only.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "lambent/image/image.h"
#include "lambent/report/result.h"

namespace lambent::image {

/// No picture may have more pixels: 16384², 3 GiB in memory.
inline constexpr size_t kMaxPixels = size_t(1) << 28;

struct ReadOptions {
  /// Bytes that reading may take; nothing: as much as a file of that size may need (see
  /// file/budget.h).
  std::optional<std::uint64_t> memoryLimit;
};

/// The file's first bytes say what it is; its extension is not asked. Values are kept as they
/// stand, NaN, infinities and negatives too (see repair.h). BadInput names the file and the place
/// in it.
Result<Image> read(const std::filesystem::path& path, const ReadOptions& options = {});
/// The same from memory; `name` stands in messages for the file.
Result<Image> decode(std::span<const std::byte> bytes, std::string_view name,
                     const ReadOptions& options = {});
/// A further layer of an EXR file, as WriteOptions::layers writes it. BadInput if there is none of
/// that name, or if it is no EXR file.
Result<Image> readLayer(const std::filesystem::path& path, std::string_view layer,
                        const ReadOptions& options = {});
/// The same of a file that was read already: BadInput is then about what it holds.
Result<Image> decodeLayer(std::span<const std::byte> bytes, std::string_view name,
                          std::string_view layer, const ReadOptions& options = {});

struct WriteOptions {
  bool halfFloat = false;  ///< EXR: 16-bit channels instead of 32; finite values beyond ±65504 are
                           ///< clamped to that
  std::vector<std::pair<std::string, const Image*>>
      layers;  ///< EXR: further layers, e.g. "variance"; of the same size as the image
};
/// Atomic. PNG: values are clamped to [0, 1] and sRGB-encoded (tone-map first), 8 bits a channel.
/// HDR: 8-bit mantissas with a shared exponent; negatives become 0, alpha is lost.
Status write(const Image& image, const std::filesystem::path& path,
             const WriteOptions& options = {});

/// Whether write() knows the extension of `path`: asked before long work.
Status checkWritableFormat(const std::filesystem::path& path);

}  // namespace lambent::image
