#include "figures/scenes.h"

#include <array>
#include <map>

#include "lambent/scene/shapes.h"

namespace lambent::figures {

scene::Material diffuseMaterial(const Rgb& albedo) {
  scene::Material material;
  material.diffuse = albedo;
  return material;
}

scene::Material glossyMaterial(const Rgb& reflectance, float exponent) {
  scene::Material material;
  material.diffuse = Rgb::Zero();
  material.glossy = reflectance;
  material.lobeExponent = exponent;
  return material;
}

scene::Material mirrorMaterial(const Rgb& reflectance) {
  scene::Material material;
  material.mirror = reflectance;
  return material;
}

scene::Scene madeOf(scene::Scene scene, const scene::Material& material) {
  scene.materials.assign(1, material);
  for (scene::Mesh& mesh : scene.meshes) mesh.material = 0;
  return scene;
}

scene::Scene ringOnGround() {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(6, 6, 1, 1), diffuseMaterial(Rgb(0.75f, 0.72f, 0.68f)));
  scene::addTo(scene,
               scene::translated(scene::ring(0.95f, 1.05f, 0.5f, 256, 4), Vec3(0, 0.2501f, 0)),
               mirrorMaterial(Rgb(0.95f, 0.78f, 0.45f)));
  return scene;
}

scene::Scene polygonOverGround() {
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(6, 6, 1, 1), diffuseMaterial(Rgb::Constant(0.8f)));
  scene::addTo(scene, scene::translated(scene::gridPlane(1.2f, 1.2f, 8, 8), Vec3(0, 0.7f, 0)),
               diffuseMaterial(Rgb(0.75f, 0.3f, 0.2f)));
  return scene;
}

namespace {

/// The curved patch of one triangle, its ten control points by vertices p and normals n.
struct Patch {
  Vec3 control[10];  // 300 030 003 210 120 021 012 102 201 111

  Patch(const Vec3 p[3], const Vec3 n[3]) {
    const auto edge = [&](int i, int j) -> Vec3 {
      const float w = (p[j] - p[i]).dot(n[i]);
      return (2.0f * p[i] + p[j] - w * n[i]) / 3.0f;
    };
    for (int k = 0; k < 3; ++k) control[k] = p[k];
    control[3] = edge(0, 1), control[4] = edge(1, 0), control[5] = edge(1, 2);
    control[6] = edge(2, 1), control[7] = edge(2, 0), control[8] = edge(0, 2);
    Vec3 mean = Vec3::Zero();
    for (int k = 3; k < 9; ++k) mean += control[k] / 6.0f;
    control[9] = mean + (mean - (p[0] + p[1] + p[2]) / 3.0f) / 2.0f;
  }

  Vec3 at(float u, float v) const {  // weights w, u, v of the corners 0, 1, 2
    const float w = 1.0f - u - v;
    return control[0] * w * w * w + control[1] * u * u * u + control[2] * v * v * v +
           3.0f * (control[3] * w * w * u + control[4] * w * u * u + control[5] * u * u * v +
                   control[6] * u * v * v + control[7] * w * v * v + control[8] * w * w * v) +
           6.0f * control[9] * w * u * v;
  }
};

}  // namespace

scene::Mesh welded(const scene::Mesh& mesh) {
  scene::Mesh out;
  out.name = mesh.name, out.material = mesh.material;
  std::map<std::array<float, 3>, std::uint32_t> places;
  std::vector<std::uint32_t> target;
  for (const Vec3& p : mesh.positions) {
    const auto [at, isNew] =
        places.try_emplace({p.x(), p.y(), p.z()}, static_cast<std::uint32_t>(out.positions.size()));
    if (isNew) out.positions.push_back(p);
    target.push_back(at->second);
  }
  for (const scene::Triangle& t : mesh.triangles) {
    const scene::Triangle w = {target[t[0]], target[t[1]], target[t[2]]};
    if (w[0] != w[1] && w[1] != w[2] && w[2] != w[0]) out.triangles.push_back(w);
  }
  scene::computeNormals(out);
  return out;
}

scene::Mesh smoothlySubdivided(scene::Mesh mesh, int levels) {
  for (int level = 0; level < levels; ++level) {
    scene::Mesh finer;
    finer.name = mesh.name, finer.material = mesh.material;
    finer.positions = mesh.positions;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
    for (const scene::Triangle& t : mesh.triangles) {
      const Vec3 p[3] = {mesh.positions[t[0]], mesh.positions[t[1]], mesh.positions[t[2]]};
      const Vec3 n[3] = {mesh.normals[t[0]], mesh.normals[t[1]], mesh.normals[t[2]]};
      const Patch patch(p, n);
      const auto middle = [&](int a, int b, float u, float v) {
        const auto key = std::minmax(t[a], t[b]);
        const auto [at, isNew] = middles.try_emplace(
            {key.first, key.second}, static_cast<std::uint32_t>(finer.positions.size()));
        if (isNew) finer.positions.push_back(patch.at(u, v));
        return at->second;
      };
      const std::uint32_t a = middle(0, 1, 0.5f, 0.0f), b = middle(1, 2, 0.5f, 0.5f),
                          c = middle(2, 0, 0.0f, 0.5f);
      finer.triangles.push_back({t[0], a, c});
      finer.triangles.push_back({a, t[1], b});
      finer.triangles.push_back({c, b, t[2]});
      finer.triangles.push_back({a, b, c});
    }
    scene::computeNormals(finer);
    mesh = std::move(finer);
  }
  return mesh;
}

}  // namespace lambent::figures
