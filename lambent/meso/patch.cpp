#include "lambent/meso/patch.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace lambent::meso {

namespace {

std::string text(double number) {
  std::ostringstream out;
  out.precision(4);
  out << number;
  return out.str();
}

bool isReflectance(const Rgb& rgb) {
  return (rgb >= 0.0f).all() && (rgb <= 1.0f).all();  // false for NaN as well
}

Status checkMesh(const scene::Mesh& mesh, std::size_t materials, const std::string& where) {
  const std::size_t count = mesh.positions.size();
  if (mesh.material < 0 || std::size_t(mesh.material) >= materials)
    return report::badInput(where + " names material " + std::to_string(mesh.material) +
                            ", but there are " + std::to_string(materials));
  for (std::size_t v = 0; v < count; ++v)
    if (!mesh.positions[v].allFinite())
      return report::badInput(where + ": vertex " + std::to_string(v) + " has no finite position");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t corner : mesh.triangles[t])
      if (corner >= count)
        return report::badInput(where + ": triangle " + std::to_string(t) + " names vertex " +
                                std::to_string(corner) + " of " + std::to_string(count));
  const auto fits = [count](std::size_t size) { return size == 0 || size == count; };
  if (!fits(mesh.normals.size()) || !fits(mesh.uvs.size()) || !fits(mesh.colors.size()))
    return report::badInput(where + " has normals, UVs or colours for some of its vertices only");
  for (std::size_t v = 0; v < mesh.colors.size(); ++v)
    if (!isReflectance(mesh.colors[v]))
      return report::badInput(where + ": the colour of vertex " + std::to_string(v) +
                              " lies outside of 0 to 1");
  return Status::ok();
}

}  // namespace

std::size_t Patch::triangleCount() const {
  std::size_t count = 0;
  for (const scene::Mesh& mesh : scene.meshes) count += mesh.triangles.size();
  return count;
}

Extent extentOf(const Patch& patch) {
  const scene::Box box = scene::bounds(patch.scene);
  return box.empty() ? Extent{} : Extent{box.lower.z(), box.upper.z()};
}

Result<Findings> check(const Patch& patch) {
  const std::string name = patch.name.empty() ? "the patch" : patch.name;
  if (!(patch.size.array() > 0.0f).all() || !patch.size.allFinite())
    return report::badInput(name + ": its period is " + text(patch.size.x()) + " × " +
                            text(patch.size.y()) + " m; both must be above 0");
  if (patch.triangleCount() == 0) return report::badInput(name + " has no triangles");
  for (std::size_t m = 0; m < patch.scene.meshes.size(); ++m)
    if (Status sound = checkMesh(patch.scene.meshes[m], patch.scene.materials.size(),
                                 name + ": mesh " + std::to_string(m));
        !sound)
      return sound.error();
  for (const scene::Material& material : patch.scene.materials) {
    const std::string which = name + ": material \"" + material.name + "\"";
    if (material.isMirror())
      return report::badInput(which +
                              " is a mirror, which no band-limited transfer can hold; make it "
                              "glossy (a roughness above 0)");
    if (!isReflectance(material.diffuse) || !isReflectance(material.glossy))
      return report::badInput(which + " reflects less than nothing or more than all");
    if (!(material.lobeExponent >= 0.0f) || !std::isfinite(material.lobeExponent))
      return report::badInput(which + " has a lobe exponent that is not a number from 0 up");
  }
  if (patch.backing && !isReflectance(*patch.backing))
    return report::badInput(name + ": the backing's reflectance lies outside of 0 to 1");
  const float depth = extentOf(patch).depth(), period = patch.size.minCoeff();
  Findings findings;
  if (depth > 0.5f * period)
    findings.push_back({Severity::Warning, "deep-patch",
                        name + " is " + text(depth) + " m deep, with a period of " + text(period) +
                            " m. An RTT samples few views and is meant for thin patches: expect "
                            "blur in oblique views, or make it shallower",
                        1});
  return findings;
}

}  // namespace lambent::meso
