// Scene → RayScene: the only room that knows Embree.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/scene/scene.h"

namespace lambent::trace {

struct Hit {
  float distance = 0.0f;
  std::uint32_t mesh = 0;      ///< index into Scene::meshes
  std::uint32_t triangle = 0;  ///< index into that mesh's triangles
  float u = 0.0f, v = 0.0f;  ///< barycentric coordinates of the triangle's second and third vertex
  bool backFace = false;     ///< the ray came from behind the triangle
};

/// Whether a ray may slip through where two triangles meet. Watertight: never; closed rooms stay
/// dark to the last bit. Fast: about once in 10⁷ rays; packets of occlusion rays are some 10%
/// faster, closest hits 4%.
enum class Edges { Watertight, Fast };

/// An immutable acceleration structure over all meshes of a scene but layers (scene/layers.h), which
/// would hide what they lie on, and be hidden by it: light is blocked and sent on by that alone.
/// Triangles are also numbered through the whole scene ("global"), mesh after mesh; so are vertices.
/// Movable; thread-safe.
class RayScene {
 public:
  /// Copies what it needs: `scene` need not outlive it. Fails on a scene without triangles.
  static Result<RayScene> build(const scene::Scene& scene, Edges edges = Edges::Watertight);
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  /// The nearest surface at distance > tNear along a unit direction.
  std::optional<Hit> closest(const Vec3& origin, const Vec3& direction, float tNear = 0.0f,
                             float tFar = std::numeric_limits<float>::infinity()) const;
  bool occluded(const Vec3& origin, const Vec3& direction, float tNear = 0.0f,
                float tFar = std::numeric_limits<float>::infinity()) const;

  /// How far along the normal a ray's origin is lifted off its surface: 1e-5 of the scene's
  /// diagonal. The bake and the path tracer use the same.
  float offset() const;

  struct GlobalTriangle {
    std::uint32_t mesh, triangle;
  };
  GlobalTriangle locate(std::uint32_t globalTriangle) const;
  /// First global triangle (or vertex) of every mesh, and the total at the end.
  std::span<const std::uint32_t> triangleOffsets() const;
  std::span<const std::uint32_t> vertexOffsets() const;

  struct Impl;
  const Impl& impl() const { return *impl_; }

 private:
  explicit RayScene(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace lambent::trace
