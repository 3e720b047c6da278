#include "apps/viewer/patch_marks.h"

#include <variant>

#include <Eigen/Geometry>

namespace lambent::viewer {
namespace {

constexpr int kStrokes = 2000;  // over all of an asset's meso-structure

using BiScale = transfer::BiScale<transfer::Numbers>;

double areaOf(const scene::Mesh& mesh) {
  double area = 0.0;
  for (const auto& [i, j, k] : mesh.triangles)
    area += 0.5 * double((mesh.positions[j] - mesh.positions[i])
                             .cross(mesh.positions[k] - mesh.positions[i])
                             .norm());
  return area;
}

}  // namespace

PatchMarks::PatchMarks(const asset::Asset& asset) {
  const std::vector<scene::Mesh>& meshes = asset.scene.meshes;
  const auto patched = [&](std::size_t m) {
    return std::get_if<BiScale>(&asset.transfer.meshes[m]);
  };
  double area = 0.0;
  for (std::size_t m = 0; m < meshes.size(); ++m)
    if (patched(m)) area += areaOf(meshes[m]);
  if (!(area > 0.0)) return;
  const float spacing = synthesis::strokeSpacing(area, kStrokes);
  for (std::size_t m = 0; m < meshes.size(); ++m)
    if (const BiScale* biScale = patched(m))
      lays_.push_back(synthesis::patchLay(meshes[m], biScale->tangents, spacing));
}

std::vector<render::Mark> PatchMarks::marksOf(const PatchOverlays& overlays) const {
  std::vector<render::Mark> marks;
  for (const synthesis::PatchLay& lay : lays_) {
    if (overlays.cuts)
      for (const auto& [from, to, normal] : lay.cuts)
        marks.push_back({from, to, normal, kCutColor, Vec2(0.75f, 0.75f)});
    if (overlays.field)
      for (const auto& [from, to, normal] : lay.field)
        marks.push_back({from, to, normal, kFieldColor, Vec2(1.3f, 0.4f)});
    if (overlays.singularities)
      for (const auto& [place, normal, index] : lay.singularities) {
        marks.push_back({place, place, normal, kRimColor, Vec2(7.0f, 7.0f)});
        marks.push_back(
            {place, place, normal, index > 0 ? kPositiveColor : kNegativeColor, Vec2(5.5f, 5.5f)});
      }
  }
  return marks;
}

Status PatchMarks::draw(const PatchOverlays& overlays, unsigned framebuffer, const PixelSize& size,
                        const render::MarkView& view) {
  if (!marks_ || uploaded_ != overlays) {
    auto made = render::GlMarks::make(marksOf(overlays));
    if (!made) return made.error();
    marks_.emplace(std::move(*made));
    uploaded_ = overlays;
  }
  marks_->draw(framebuffer, size.width, size.height, view);
  return Status::ok();
}

}  // namespace lambent::viewer
