// What the properties of PLY elements are for, by the names that programs give them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "lambent/scene_io/ply_header.h"

namespace lambent::scene_io {

enum class PlyRole {
  None,
  X,
  Y,
  Z,
  NX,
  NY,
  NZ,
  U,
  V,
  Red,
  Green,
  Blue,
  Alpha,
  Corners,    ///< a list: the vertices of a face
  CornerUvs,  ///< a list: u, v of each of its corners
  Texture,    ///< the number of a face's texture
};
inline constexpr int kPlyRoles = 16;

/// The roles of an element's properties, each at most once.
struct PlyRoles {
  std::vector<PlyRole> roles;  ///< one for each property
  PlyType redType = PlyType::Uint8;
  std::size_t unreadCount = 0;
  std::string unread;  ///< names without a role: "quality, confidence"

  explicit PlyRoles(const PlyElement& element);
  bool has(PlyRole role) const { return has_[int(role)]; }
  bool hasColors() const { return has(PlyRole::Red) && has(PlyRole::Green) && has(PlyRole::Blue); }

 private:
  bool has_[kPlyRoles] = {};
};

}  // namespace lambent::scene_io
