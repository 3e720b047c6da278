// A map statement of MTL: options and a file's name ("map_Kd -s 2 2 1 -clamp on wood grain.png").
#pragma once

#include <string>
#include <string_view>

#include "lambent/math/types.h"

namespace lambent::scene_io {

/// What -s and -o do to the texture coordinates of a mesh: (u, v) · scale + offset, with v counted
/// from the bottom.
struct UvTransform {
  Vec2 scale = Vec2::Ones(), offset = Vec2::Zero();
  bool isIdentity() const { return scale == Vec2::Ones() && offset == Vec2::Zero(); }
  /// Of coordinates with v from the top, as meshes have them.
  Vec2 apply(const Vec2& uv) const;
};

struct MtlMap {
  std::string name;  ///< as it is spelled, may be empty
  UvTransform uv;
  bool clamp = false;
  std::string ignored;  ///< options that change the picture and are not read: "-mm -imfchan"
};

/// `text` is what follows the keyword. Options may stand on both sides of the name.
MtlMap readMtlMap(std::string_view text);

}  // namespace lambent::scene_io
