#include "lambent/trace/holes.h"

namespace lambent::trace {
namespace {

void reject(const RTCFilterFunctionNArguments* args) {
  const auto& holes = *static_cast<const Holes*>(args->geometryUserPtr);
  for (unsigned i = 0; i < args->N; ++i) {
    if (args->valid[i] != -1) continue;
    const std::uint32_t traced = RTCHitN_primID(args->hit, args->N, i);
    if (holes.at(traced, RTCHitN_u(args->hit, args->N, i), RTCHitN_v(args->hit, args->N, i)))
      args->valid[i] = 0;
  }
}

}  // namespace

Holes::Holes(const scene::Scene& scene, const std::vector<scene::Passing>& passings) {
  scene_.materials = scene.materials;
  scene_.textures.resize(scene.textures.size());
  scene_.meshes.resize(scene.meshes.size());
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    if (passings[m] == scene::Passing::Nothing) continue;
    const scene::Mesh& from = scene.meshes[m];
    scene::Mesh& to = scene_.meshes[m];
    to.material = from.material;
    to.triangles = from.triangles;
    to.uvs = from.uvs;
    to.alphas = from.alphas;
    const int texture = scene.materials[std::size_t(from.material)].baseColorTexture;
    if (texture < 0 || std::size_t(texture) >= scene.textures.size()) continue;
    scene::Texture& copy = scene_.textures[std::size_t(texture)];
    if (!copy.rgba.empty()) continue;
    const scene::Texture& whole = scene.textures[std::size_t(texture)];
    copy.width = whole.width, copy.height = whole.height;
    copy.wrapU = whole.wrapU, copy.wrapV = whole.wrapV;
    copy.rgba = whole.rgba;
  }
}

void Holes::passOver(RTCGeometry geometry, const Holes& holes) {
  rtcSetGeometryUserData(geometry, const_cast<Holes*>(&holes));
  rtcSetGeometryIntersectFilterFunction(geometry, reject);
  rtcSetGeometryOccludedFilterFunction(geometry, reject);
}

}  // namespace lambent::trace
