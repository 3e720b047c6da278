// The pictures of a glTF file, each decoded once, however many materials look at it.
#pragma once

#include <array>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "lambent/scene/source.h"
#include "lambent/scene_io/gltf_read.h"

namespace lambent::scene_io {

struct GltfPicture {
  /// Why the scene has to do without it: it is not there, or of a kind that is not read.
  std::string missing;
  scene::Texture texture;  ///< with texels only if some material has it as its base colour; they
                           ///< may be taken, once
  int sceneTexture = -1;   ///< where the texels went that were taken
  Rgb meanColor = Rgb::Ones();                             ///< linear, of an sRGB picture
  std::array<double, 4> meanChannels{1.0, 1.0, 0.0, 1.0};  ///< of codes in [0, 1]; these if missing
};

class GltfImages {
 public:
  explicit GltfImages(const GltfFile& file);

  /// The picture of `texture` (by an extension only where it has no `source`). A picture that is
  /// damaged, too large for the file's budget or not to be read by the file's LoadOptions is an
  /// error.
  Result<GltfPicture*> pictureOf(std::int64_t texture);
  /// The name of its image.
  std::string nameOf(std::int64_t texture) const;
  /// Its image, or −1.
  std::int64_t sourceOf(std::int64_t texture) const;
  /// An image as it can stand in another file: PNG and JPEG as they are found, WebP as PNG. Without
  /// bytes if it cannot be read, and `missing` says why; an error where it takes too much memory.
  Result<scene::SourcePicture> carried(std::int64_t image, std::string& missing) const;

 private:
  /// Its bytes, which may lie in `linked`; the error says what is wrong.
  Result<std::span<const std::byte>> bytesOf(std::int64_t image,
                                             std::vector<std::byte>& linked) const;
  /// The extension that a texture without a `source` has its image by, or nothing.
  std::string formatOf(std::int64_t texture) const;
  std::string keyOf(std::int64_t image) const;
  Result<GltfPicture> read(std::int64_t image, const std::string& key) const;

  const GltfFile& file_;
  std::set<std::string> texelsWanted_, meansWanted_;  ///< keys
  std::map<std::string, GltfPicture> pictures_;       ///< by where the bytes are
};

}  // namespace lambent::scene_io
