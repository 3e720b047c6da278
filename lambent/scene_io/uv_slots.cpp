#include "lambent/scene_io/uv_slots.h"

#include <algorithm>
#include <charconv>
#include <string_view>

namespace lambent::scene_io {
namespace {

constexpr std::string_view kCoordinates = "TEXCOORD_";

std::optional<int> setOf(const scene::VertexNumbers& numbers) {
  const std::string_view name = numbers.name;
  if (!name.starts_with(kCoordinates) || numbers.width != 2) return {};
  int set = -1;
  const char* end = name.data() + name.size();
  const auto [rest, error] = std::from_chars(name.data() + kCoordinates.size(), end, set);
  return error == std::errc() && rest == end && set >= 0 ? std::optional(set) : std::nullopt;
}

}  // namespace

UvSlots::UvSlots(const scene::Scene& scene, const std::set<int>& wanted) {
  bool any = false, laidOut = false, agree = true;
  std::set<int> there, own;
  for (const scene::Mesh& mesh : scene.meshes) {
    laidOut |= !mesh.texelUvs.empty();
    for (const scene::VertexNumbers& numbers : mesh.others)
      if (const auto set = setOf(numbers)) there.insert(*set), own.insert(*set);
    any |= !mesh.uvs.empty();
    // Who has no material of the source, like a patch of meso-structure, looks nothing up by its
    // sets.
    if (mesh.uvs.empty() || scene::materialOf(scene, mesh).source < 0) continue;
    if (first_) agree &= first_ == mesh.source.uvSet;
    first_ = mesh.source.uvSet;
    if (mesh.source.uvSet >= 0) there.insert(mesh.source.uvSet);
  }
  if (!agree || (first_ && *first_ < 0)) first_.reset();
  for (const int set : wanted)
    if (set != first_ && there.contains(set)) own.insert(set);
  int slot = laidOut ? 2 : any ? 1 : 0;
  for (const int set : own)
    if (set != first_) slots_[set] = slot++;
}

int UvSlots::slotOf(int set) const {
  const auto slot = slots_.find(set);
  return slot == slots_.end() ? 0 : slot->second;
}

std::vector<UvSlot> UvSlots::of(const scene::Mesh& mesh, const std::set<int>& wanted) const {
  std::map<int, UvSlot> filled;
  for (const scene::VertexNumbers& numbers : mesh.others)
    if (const auto set = setOf(numbers); set && slots_.contains(*set))
      filled[slots_.at(*set)] = {slots_.at(*set), &numbers, nullptr};
  if (const auto slot = slots_.find(mesh.source.uvSet);
      slot != slots_.end() && !mesh.uvs.empty() && wanted.contains(slot->first))
    filled.try_emplace(slot->second, UvSlot{slot->second, nullptr, &mesh.uvs});
  if (filled.empty()) return {};
  std::vector<UvSlot> slots;
  for (int slot = 0; slot <= filled.rbegin()->first; ++slot) {
    if ((slot == 0 && !mesh.uvs.empty()) || (slot == 1 && !mesh.texelUvs.empty())) continue;
    const auto here = filled.find(slot);
    UvSlot found = here != filled.end() ? here->second : filled.begin()->second;
    found.slot = slot;
    slots.push_back(found);
  }
  return slots;
}

}  // namespace lambent::scene_io
