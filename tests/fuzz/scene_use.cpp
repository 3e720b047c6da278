#include "tests/fuzz/scene_use.h"

#include <algorithm>
#include <cmath>

#include "lambent/scene/camera.h"
#include "lambent/scene/diagnose.h"
#include "lambent/scene_io/gltf_write.h"
#include "lambent/scene_io/load.h"
#include "tests/fuzz/folder.h"

namespace lambent::fuzz {
namespace {

bool isReflectance(const Rgb& c) {
  return (c >= 0.0f).all() && (c <= 1.0f).all();
}

void requireSound(const scene::Mesh& mesh, std::size_t materials) {
  const std::size_t vertices = mesh.positions.size();
  require(mesh.material >= 0 && std::size_t(mesh.material) < materials, "a mesh has its material");
  require(!mesh.triangles.empty(), "a mesh has triangles");
  require(mesh.normals.size() == vertices, "every vertex has a normal");
  require(mesh.uvs.empty() || mesh.uvs.size() == vertices, "UVs belong to vertices");
  require(mesh.texelUvs.empty() || mesh.texelUvs.size() == vertices,
          "texel UVs belong to vertices");
  require(mesh.colors.empty() || mesh.colors.size() == vertices, "colours belong to vertices");
  for (const scene::Triangle& triangle : mesh.triangles) {
    for (const std::uint32_t vertex : triangle) {
      require(vertex < vertices, "a triangle's vertices exist");
    }
  }
  for (const Vec3& p : mesh.positions) require(p.allFinite(), "positions are finite");
  for (const Vec3& n : mesh.normals) require(std::abs(n.norm() - 1.0f) < 1e-4f, "normals are unit");
  for (const Vec2& uv : mesh.uvs) require(uv.allFinite(), "UVs are finite");
  for (const Rgb& c : mesh.colors) require(isReflectance(c), "colours are in [0, 1]");
}

void look(const scene::Scene& scene, std::uint32_t index) {
  const scene::Mesh& mesh = scene.meshes[index];
  if (mesh.triangles.size() > kMostElements) return;
  (void)scene::topology(mesh);
  (void)scene::checkUvs(mesh, 16, 16);
  const auto triangles = std::uint32_t(std::min<std::size_t>(mesh.triangles.size(), 64));
  for (std::uint32_t t = 0; t < triangles; ++t) {
    const scene::SurfacePoint point = scene::surfaceAt(scene, index, t, 0.25f, 0.5f);
    require(isReflectance(point.diffuse), "what a surface reflects is in [0, 1]");
  }
  (void)scene::surfaceAtVertex(scene, index, mesh.triangles.back()[2]);
}

}  // namespace

void requireSound(const scene::Scene& scene) {
  require(!scene.meshes.empty(), "a scene has a mesh");
  for (const scene::Mesh& mesh : scene.meshes) requireSound(mesh, scene.materials.size());
  for (const scene::Material& material : scene.materials) {
    require(
        material.baseColorTexture >= -1 && material.baseColorTexture < int(scene.textures.size()),
        "a material has its texture");
    require(isReflectance(material.diffuse) && isReflectance(material.glossy) &&
                isReflectance(material.mirror),
            "reflectances are in [0, 1]");
    require(material.lobeExponent >= 0.0f && std::isfinite(material.lobeExponent),
            "a lobe's exponent is finite");
    require((material.emission >= 0.0f).all() && material.emission.isFinite().all(),
            "emission is finite");
  }
  for (const scene::Texture& texture : scene.textures) {
    require(texture.width > 0 && texture.height > 0 &&
                texture.rgba.size() == 4 * std::size_t(texture.width) * std::size_t(texture.height),
            "a texture has its texels");
  }
}

void use(const scene::Scene& scene) {
  for (std::uint32_t i = 0; i < std::min<std::size_t>(scene.meshes.size(), 16); ++i) look(scene, i);
  (void)scene::frameAutomatically(scene, 1.5f);
  for (const scene::Camera& camera : scene.cameras) {
    (void)scene::clipFromWorld(camera, 3, 2, scene::bounds(scene));
    (void)scene::cameraRay(camera, 3, 2, 1.0f, 1.0f);
  }

  const Result<std::vector<std::byte>> glb = scene_io::GltfBuilder(scene).glb();
  require(bool(glb), "a scene that was read can be written");
  const Result<scene_io::LoadedScene> again =
      scene_io::load(Folder::ofProcess().write("again.glb", *glb));
  if (!again) std::fprintf(stderr, "%s\n", again.error().message.c_str());
  require(bool(again), "a scene that was written can be read");
  require(again->scene.meshes.size() == scene.meshes.size(), "every mesh comes back");
  require(again->scene.materials.size() >= scene.materials.size(), "every material comes back");
  // A scene that turned out to lie far away is moved when it is read again.
  if (again->scene.origin != scene.origin) return;
  for (std::size_t i = 0; i < scene.meshes.size(); ++i) {
    require(again->scene.meshes[i].positions == scene.meshes[i].positions &&
                again->scene.meshes[i].triangles == scene.meshes[i].triangles,
            "geometry comes back bit for bit");
  }
}

}  // namespace lambent::fuzz
