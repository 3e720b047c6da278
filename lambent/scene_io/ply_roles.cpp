#include "lambent/scene_io/ply_roles.h"

#include <utility>

namespace lambent::scene_io {
namespace {

/// Names that a finding lists; a hostile header has thousands.
constexpr std::size_t kMostListed = 200;

using Known = std::pair<std::string_view, PlyRole>;
constexpr Known kScalars[] = {{"x", PlyRole::X},
                              {"y", PlyRole::Y},
                              {"z", PlyRole::Z},
                              {"nx", PlyRole::NX},
                              {"ny", PlyRole::NY},
                              {"nz", PlyRole::NZ},
                              {"normal_x", PlyRole::NX},
                              {"normal_y", PlyRole::NY},
                              {"normal_z", PlyRole::NZ},
                              {"s", PlyRole::U},
                              {"t", PlyRole::V},
                              {"u", PlyRole::U},
                              {"v", PlyRole::V},
                              {"texture_u", PlyRole::U},
                              {"texture_v", PlyRole::V},
                              {"texture_s", PlyRole::U},
                              {"texture_t", PlyRole::V},
                              {"s0", PlyRole::U},
                              {"t0", PlyRole::V},
                              {"red", PlyRole::Red},
                              {"green", PlyRole::Green},
                              {"blue", PlyRole::Blue},
                              {"r", PlyRole::Red},
                              {"g", PlyRole::Green},
                              {"b", PlyRole::Blue},
                              {"diffuse_red", PlyRole::Red},
                              {"diffuse_green", PlyRole::Green},
                              {"diffuse_blue", PlyRole::Blue},
                              {"alpha", PlyRole::Alpha},
                              {"a", PlyRole::Alpha},
                              {"diffuse_alpha", PlyRole::Alpha},
                              {"texnumber", PlyRole::Texture},
                              {"tex_number", PlyRole::Texture}};
constexpr Known kLists[] = {{"vertex_indices", PlyRole::Corners},
                            {"vertex_index", PlyRole::Corners},
                            {"vertex_indexes", PlyRole::Corners},
                            {"texcoord", PlyRole::CornerUvs},
                            {"texture_coordinates", PlyRole::CornerUvs}};

PlyRole roleOf(const PlyProperty& property) {
  const auto in = [&](const auto& table) {
    for (const auto& [known, role] : table) {
      if (property.name == known) return role;
    }
    return PlyRole::None;
  };
  return property.isList ? in(kLists) : in(kScalars);
}

}  // namespace

PlyRoles::PlyRoles(const PlyElement& element) {
  for (const PlyProperty& property : element.properties) {
    PlyRole role = roleOf(property);
    if (has_[int(role)]) role = PlyRole::None;
    has_[int(role)] = role != PlyRole::None;
    roles.push_back(role);
    if (role == PlyRole::Red) redType = property.type;
    unreadCount += role == PlyRole::None;
    if (role == PlyRole::None && unread.size() < kMostListed) {
      unread += (unread.empty() ? "" : ", ") + property.name.substr(0, 40);
    }
  }
}

}  // namespace lambent::scene_io
