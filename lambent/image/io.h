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
#include "lambent/image/maps.h"
#include "lambent/report/finding.h"
#include "lambent/report/result.h"

namespace lambent::image {

/// No picture may have more pixels: 16384², 3 GiB in memory.
inline constexpr size_t kMaxPixels = size_t(1) << 28;

struct ReadOptions {
  /// Bytes that reading may take; nothing: as much as a file of that size may need (see
  /// file/budget.h).
  std::optional<std::uint64_t> memoryLimit;
  /// EXR: the layer or part to read, "diffuse", "ViewLayer.Combined", or one channel, as grey. Empty:
  /// the picture itself, which is found among them (see exr_choice.h).
  std::string layer = {};
  /// PNG: its codes are taken as sRGB, whatever it says of gamma and primaries: for numbers that are
  /// no colours.
  bool plainCodes = false;
};

/// A picture with what its file says of it.
struct PictureFile {
  Image image;
  /// The map of all directions that the file says it is; a cube's faces are brought into the
  /// sequence and orientation of MapKind::Cube.
  std::optional<MapKind> map;
  /// Whether pixels are other than those that a reader takes who knows no more than the channels R, G,
  /// B of the first part, or the numbers of a Radiance picture from the top left.
  bool converted = false;
  bool codes = false;  ///< PNG, JPEG, WebP: made for a screen, from 0 to 1
  Findings findings;  ///< what the file says or holds that is not in `image`, or was taken on trust
};

/// Colours become linear Rec. 709 where the file says which others they are: EXR by its chromaticities,
/// channels X, Y, Z or the name of its colour space, HDR by PRIMARIES and XYZE, PNG by gAMA and cHRM.
/// Otherwise as read().
Result<PictureFile> readPicture(const std::filesystem::path& path, const ReadOptions& options = {});
Result<PictureFile> decodePicture(std::span<const std::byte> bytes, std::string_view name,
                                  const ReadOptions& options = {});

/// The picture alone, for files whose maker is known: findings are dropped.
///
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
