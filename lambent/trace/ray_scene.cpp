#include "lambent/trace/ray_scene.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "lambent/scene/sheets.h"
#include "lambent/trace/embree_scene.h"

namespace lambent::trace {

namespace {

Error embreeError(RTCError code, const std::string& doing) {
  return report::failed("ray tracing: " + doing + " failed (Embree error " + std::to_string(code) +
                        (code == RTC_ERROR_OUT_OF_MEMORY ? ", out of memory)" : ")"));
}

RTCRay makeRay(const Vec3& origin, const Vec3& direction, float tNear, float tFar) {
  RTCRay ray;
  ray.org_x = origin.x(), ray.org_y = origin.y(), ray.org_z = origin.z();
  ray.dir_x = direction.x(), ray.dir_y = direction.y(), ray.dir_z = direction.z();
  ray.tnear = tNear, ray.tfar = tFar;
  ray.time = 0.0f;
  ray.mask = ~0u, ray.id = 0, ray.flags = 0;
  return ray;
}

/// The triangles of a mesh that are traced.
std::span<const scene::Triangle> frontsOf(const scene::Mesh& mesh) {
  const std::span<const scene::Triangle> all = mesh.triangles;
  return scene::hasBacks(mesh) ? all.first(all.size() / 2) : all;
}

bool hasAnyBacks(const scene::Scene& scene) {
  return std::any_of(scene.meshes.begin(), scene.meshes.end(), scene::hasBacks);
}

std::vector<RayScene::Impl::Sides> sidesOf(const scene::Scene& scene,
                                           std::span<const std::uint32_t> offsets) {
  std::vector<RayScene::Impl::Sides> sides;
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const auto all = std::uint32_t(scene.meshes[m].triangles.size());
    const auto fronts = std::uint32_t(frontsOf(scene.meshes[m]).size());
    for (std::uint32_t t = 0; t < fronts; ++t)
      sides.push_back({offsets[m] + t, offsets[m] + t + (all - fronts)});
  }
  return sides;
}

}  // namespace

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Result<RayScene> RayScene::build(const scene::Scene& scene, Edges edges) {
  auto impl = std::make_unique<Impl>();
  std::size_t vertexCount = 0, triangleCount = 0;
  for (const scene::Mesh& mesh : scene.meshes) {
    impl->vertexOffsets.push_back(static_cast<std::uint32_t>(vertexCount));
    impl->triangleOffsets.push_back(static_cast<std::uint32_t>(triangleCount));
    vertexCount += mesh.positions.size();
    triangleCount += mesh.triangles.size();
  }
  impl->vertexOffsets.push_back(static_cast<std::uint32_t>(vertexCount));
  impl->triangleOffsets.push_back(static_cast<std::uint32_t>(triangleCount));
  if (triangleCount == 0) return report::badInput("the scene has no triangles to trace");
  constexpr std::size_t kMost = 0x7fffffffu;
  if (triangleCount > kMost || vertexCount > kMost)
    return report::badInput("the scene has more than 2^31 triangles or vertices: split it");
  impl->offset = 1e-5f * scene::bounds(scene).diagonal();

  impl->device = rtcNewDevice(nullptr);
  if (!impl->device) return embreeError(rtcGetDeviceError(nullptr), "starting");
  impl->scene = rtcNewScene(impl->device);
  if (edges == Edges::Watertight) rtcSetSceneFlags(impl->scene, RTC_SCENE_FLAG_ROBUST);
  RTCGeometry geometry = rtcNewGeometry(impl->device, RTC_GEOMETRY_TYPE_TRIANGLE);
  auto* positions = static_cast<float*>(rtcSetNewGeometryBuffer(
      geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertexCount));
  if (hasAnyBacks(scene)) impl->sides = sidesOf(scene, impl->triangleOffsets);
  const std::size_t traced = impl->sides.empty() ? triangleCount : impl->sides.size();
  auto* indices = static_cast<std::uint32_t*>(
      rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                              3 * sizeof(std::uint32_t), traced));
  if (!positions || !indices) {
    rtcReleaseGeometry(geometry);
    return embreeError(rtcGetDeviceError(impl->device), "allocating the triangles");
  }
  for (std::size_t m = 0; m < scene.meshes.size(); ++m) {
    const scene::Mesh& mesh = scene.meshes[m];
    const std::uint32_t first = impl->vertexOffsets[m];
    for (const Vec3& p : mesh.positions) {
      *positions++ = p.x(), *positions++ = p.y(), *positions++ = p.z();
    }
    for (const scene::Triangle& t : frontsOf(mesh))
      for (std::uint32_t corner : t) *indices++ = first + corner;
  }
  rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(impl->scene, geometry, 0);
  rtcReleaseGeometry(geometry);
  rtcSetSceneBuildQuality(impl->scene, RTC_BUILD_QUALITY_MEDIUM);
  rtcCommitScene(impl->scene);
  // Asking takes the error back: once.
  if (const RTCError code = rtcGetDeviceError(impl->device); code != RTC_ERROR_NONE)
    return embreeError(code, "building the acceleration structure");
  return RayScene(std::move(impl));
}

std::optional<Hit> RayScene::closest(const Vec3& origin, const Vec3& direction, float tNear,
                                     float tFar) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRayHit query;
  query.ray = makeRay(origin, direction, tNear, tFar);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  rtcIntersect1(impl_->scene, &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
  const Vec3 normal(query.hit.Ng_x, query.hit.Ng_y, query.hit.Ng_z);
  std::uint32_t triangle = query.hit.primID;
  float u = query.hit.u, v = query.hit.v;
  bool backFace = normal.dot(direction) > 0.0f;
  impl_->nameSide(triangle, u, v, backFace);
  const GlobalTriangle place = locate(triangle);
  return Hit{query.ray.tfar, place.mesh, place.triangle, u, v, backFace};
}

bool RayScene::occluded(const Vec3& origin, const Vec3& direction, float tNear, float tFar) const {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  RTCRay ray = makeRay(origin, direction, tNear, tFar);
  rtcOccluded1(impl_->scene, &context, &ray);
  return ray.tfar < 0.0f;
}

float RayScene::offset() const {
  return impl_->offset;
}

RayScene::GlobalTriangle RayScene::locate(std::uint32_t globalTriangle) const {
  const auto& offsets = impl_->triangleOffsets;
  const auto after = std::upper_bound(offsets.begin(), offsets.end(), globalTriangle);
  const auto mesh = static_cast<std::uint32_t>(after - offsets.begin() - 1);
  return {mesh, globalTriangle - offsets[mesh]};
}

std::span<const std::uint32_t> RayScene::triangleOffsets() const {
  return impl_->triangleOffsets;
}
std::span<const std::uint32_t> RayScene::vertexOffsets() const {
  return impl_->vertexOffsets;
}

}  // namespace lambent::trace
