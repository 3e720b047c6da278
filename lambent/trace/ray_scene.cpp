#include "lambent/trace/ray_scene.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <string>

#include "lambent/scene/sheets.h"
#include "lambent/trace/embree_scene.h"
#include "lambent/trace/veils.h"

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

/// Corners of the triangles that Embree gets, by geometry.
using Traced = std::array<std::vector<scene::Triangle>, 2>;

/// Of meshes with backs the fronts alone. Where Embree's numbers are not the global ones, what is
/// traced is noted in `impl`.
Traced tracedOf(const scene::Scene& scene, const std::vector<scene::Passing>& passings,
                RayScene::Impl& impl) {
  Traced traced;
  const bool anyBacks = std::any_of(scene.meshes.begin(), scene.meshes.end(), scene::hasBacks);
  const bool anyLayers = std::any_of(scene.meshes.begin(), scene.meshes.end(),
                                     [](const scene::Mesh& mesh) { return mesh.layer; });
  impl.numbered = anyBacks || anyLayers || impl.holes;
  std::vector<Holes::Place> places;
  for (std::uint32_t m = 0; m < scene.meshes.size(); ++m) {
    const scene::Mesh& mesh = scene.meshes[m];
    if (mesh.layer) continue;
    const Geometry which = passings[m] == scene::Passing::Nothing ? kWhole : kHoled;
    const bool backs = anyBacks && scene::hasBacks(mesh);
    const std::size_t fronts = mesh.triangles.size() / (backs ? 2 : 1);
    traced[which].reserve(traced[which].size() + fronts);
    for (std::uint32_t t = 0; t < fronts; ++t) {
      scene::Triangle corners = mesh.triangles[t];
      for (std::uint32_t& corner : corners) corner += impl.vertexOffsets[m];
      traced[which].push_back(corners);
      const std::uint32_t front = impl.triangleOffsets[m] + t;
      if (impl.numbered)
        impl.sides[which].push_back({front, backs ? front + std::uint32_t(fronts) : front});
      if (which == kHoled) places.push_back({m, t});
    }
  }
  if (impl.holes) impl.holes->places = std::move(places);
  return traced;
}

void copyPositions(const scene::Scene& scene, float* to) {
  for (const scene::Mesh& mesh : scene.meshes)
    for (const Vec3& p : mesh.positions) *to++ = p.x(), *to++ = p.y(), *to++ = p.z();
}

/// False: there is no memory.
bool attach(const RayScene::Impl& impl, Geometry which, const std::vector<scene::Triangle>& traced,
            RTCBuffer positions, std::size_t vertexCount) {
  RTCGeometry geometry = rtcNewGeometry(impl.device, RTC_GEOMETRY_TYPE_TRIANGLE);
  rtcSetGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, positions, 0,
                       3 * sizeof(float), vertexCount);
  void* indices = rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                          sizeof(scene::Triangle), traced.size());
  if (indices) {
    std::memcpy(indices, traced.data(), traced.size() * sizeof(scene::Triangle));
    if (which == kHoled) Holes::passOver(geometry, *impl.holes);
    rtcSetGeometryBuildQuality(geometry, RTC_BUILD_QUALITY_MEDIUM);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(impl.scene, geometry, which);
  }
  rtcReleaseGeometry(geometry);
  return indices != nullptr;
}

}  // namespace

RayScene::RayScene(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
RayScene::RayScene(RayScene&&) noexcept = default;
RayScene& RayScene::operator=(RayScene&&) noexcept = default;
RayScene::~RayScene() = default;

Result<RayScene> RayScene::build(const scene::Scene& scene, Edges edges) {
  auto impl = std::make_unique<Impl>();
  std::size_t vertexCount = 0, triangleCount = 0;
  bool anything = false;
  for (const scene::Mesh& mesh : scene.meshes) {
    impl->vertexOffsets.push_back(static_cast<std::uint32_t>(vertexCount));
    impl->triangleOffsets.push_back(static_cast<std::uint32_t>(triangleCount));
    vertexCount += mesh.positions.size();
    triangleCount += mesh.triangles.size();
    anything = anything || (!mesh.layer && !mesh.triangles.empty());
  }
  impl->vertexOffsets.push_back(static_cast<std::uint32_t>(vertexCount));
  impl->triangleOffsets.push_back(static_cast<std::uint32_t>(triangleCount));
  if (!anything) return report::badInput("the scene has no triangles to trace");
  constexpr std::size_t kMost = 0x7fffffffu;
  if (triangleCount > kMost || vertexCount > kMost)
    return report::badInput("the scene has more than 2^31 triangles or vertices: split it");
  impl->offset = 1e-5f * scene::bounds(scene).diagonal();

  impl->device = rtcNewDevice(nullptr);
  if (!impl->device) return embreeError(rtcGetDeviceError(nullptr), "starting");
  impl->scene = rtcNewScene(impl->device);
  if (edges == Edges::Watertight) rtcSetSceneFlags(impl->scene, RTC_SCENE_FLAG_ROBUST);
  const std::vector<scene::Passing> passings = passingsOnTheWay(scene);
  if (std::any_of(passings.begin(), passings.end(),
                  [](scene::Passing passing) { return passing != scene::Passing::Nothing; }))
    impl->holes = std::make_unique<Holes>(scene, passings);
  Traced traced = tracedOf(scene, passings, *impl);
  RTCBuffer positions = rtcNewBuffer(impl->device, (3 * vertexCount + 1) * sizeof(float));
  if (positions) copyPositions(scene, static_cast<float*>(rtcGetBufferData(positions)));
  bool there = positions != nullptr;
  for (const Geometry which : {kWhole, kHoled}) {
    if (there && !traced[which].empty())
      there = attach(*impl, which, traced[which], positions, vertexCount);
    traced[which] = {};
  }
  if (positions) rtcReleaseBuffer(positions);
  if (!there) return embreeError(rtcGetDeviceError(impl->device), "allocating the triangles");
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
  impl_->nameSide(query.hit.geomID, triangle, u, v, backFace);
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
