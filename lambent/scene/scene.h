// A scene as plain values: triangle meshes in world space, one material each, textures, cameras.
// World: right-handed, +Y up, metres. Node transforms are applied on loading, so that a mesh that
// stands in two places is two meshes: radiance transfer belongs to a place, not to a shape.
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/scene/vertex_numbers.h"

namespace lambent::scene {

/// What becomes of the alpha of a surface: of its texture, its vertices and its material
/// multiplied.
enum class AlphaMode {
  Opaque,  ///< nothing
  Mask,    ///< where it is below a threshold there is a hole
  Blend,   ///< it is the share of the surface that is there; through the rest light goes on
};

/// How light leaves a surface. Reflectances are linear RGB in [0, 1]; the base colour (texture,
/// vertex colour) multiplies all four.
///  - diffuse: exit radiance ρ/π · irradiance.
///  - glossy:  exit radiance k · ∫ L(s) G(s, R) ds over the hemisphere of the normal, with R the
///             view direction mirrored about the normal and G the Phong-like lobe
///             (r+1)/2π · max(0, s·R)^r of unit integral (sloan2002precomputed §4.2).
///  - mirror:  a perfect reflection. A surface with any mirror reflectance is a mirror and nothing
///             else: it connects paths and records no transfer (sloan2002precomputed §5).
///  - transmitted: goes on straight through, as through a thin pane, from either side.
/// Besides, its front may emit light of its own, the same radiance everywhere and in all
/// directions: the path tracer and captured light know of it, a bake leaves it out.
struct Material {
  std::string name;
  Rgb diffuse = Rgb::Constant(0.8f);
  Rgb glossy = Rgb::Zero();
  Rgb mirror = Rgb::Zero();
  Rgb transmitted = Rgb::Zero();
  float lobeExponent = 16.0f;  ///< r of the lobe, ≥ 0
  /// glTF's, [0, 1], of what has no lobe: as the file says, for viewers that give it one.
  float matteRoughness = 1.0f;
  Rgb emission = Rgb::Zero();  ///< radiance, W m⁻² sr⁻¹, ≥ 0; the base colour leaves it alone
  AlphaMode alphaMode = AlphaMode::Opaque;
  float alphaCutoff = 0.5f;   ///< ≥ 0, of Mask
  float opacity = 1.0f;       ///< [0, 1], the material's part of alpha
  int baseColorTexture = -1;  ///< index into Scene::textures, or −1
  /// As the file says. Surfaces are lit and seen from their front alone: what has two sides has a
  /// back of triangles (scene/sheets.h), which loaders add where a surface that says so is open.
  bool doubleSided = false;
  int source = -1;  ///< its number in the document of Scene::source, or −1

  bool isMirror() const { return mirror.maxCoeff() > 0.0f; }
  bool isGlossy() const { return !isMirror() && glossy.maxCoeff() > 0.0f; }
  bool isEmitter() const { return emission.maxCoeff() > 0.0f; }
  bool isDiffuse() const { return !isMirror() && diffuse.maxCoeff() > 0.0f; }
};

enum class Wrap { Repeat, ClampToEdge, MirroredRepeat };

/// A base-colour texture: 8-bit sRGB texels, top row first, and the file's own bytes so that an
/// asset can carry it unchanged.
struct Texture {
  std::string name;
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4·width·height, sRGB-encoded colour, linear alpha
  Wrap wrapU = Wrap::Repeat, wrapV = Wrap::Repeat;
  std::vector<std::uint8_t> encoded;  ///< PNG or JPEG bytes as found, may be empty
  std::string mimeType;               ///< "image/png" or "image/jpeg"
  int source = -1;                    ///< its number in the document of Scene::source, or −1
};

/// Where a mesh stood in its file.
struct MeshSource {
  int node = -1;  ///< in Source::nodes
  int mesh = -1;  ///< of the document, and which of its primitives
  int primitive = -1;
  int uvSet = -1;  ///< the TEXCOORD_n that Mesh::uvs are unchanged; −1: they are none
};

using Triangle =
    std::array<std::uint32_t, 3>;  ///< vertex indices, counter-clockwise from the front

struct Mesh {
  std::string name;
  int material = 0;  ///< index into Scene::materials
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;  ///< unit, one per position (loaders make them where a file has none)
  std::vector<Vec2> uvs;      ///< TEXCOORD_0 as glTF has it (v downwards), or empty
  /// TEXCOORD_1: the surface laid out in the unit square, for receivers on texels alone; or empty:
  /// those lie by `uvs`.
  std::vector<Vec2> texelUvs;
  std::vector<Rgb> colors;    ///< linear COLOR_0, or empty
  std::vector<float> alphas;  ///< of COLOR_0, [0, 1], or empty: 1 everywhere
  AllVertexNumbers others;    ///< what else the file has there
  std::vector<Triangle> triangles;
  /// Whether it lies on another mesh, each of its triangles in the place of one of that: it is seen
  /// before it (scene/layers.h), and what light meets on its way is the other alone.
  bool layer = false;
  MeshSource source;
};

/// A pinhole or orthographic camera that looks along its −z with +y up, as glTF's.
struct Camera {
  std::string name;
  Mat4 worldFromCamera = Mat4::Identity();
  float verticalFov = 0.7f;                     ///< radians; not used if orthographic
  std::optional<float> orthographicHalfHeight;  ///< metres, half the height of the view
  int source = -1;                              ///< its node in Source::nodes, or −1
};

struct Source;  // scene/source.h

struct Scene {
  /// Where (0, 0, 0) of everything here lies in the coordinates of the file, metres: zero unless
  /// the file stands so far away that floats would not hold it (scene_io/far_origin.h). Light comes
  /// from infinity and nothing here asks for it; it is kept so that nothing is lost.
  Vec3d origin = Vec3d::Zero();
  std::vector<Mesh> meshes;
  std::vector<Material> materials;  ///< at least one if there is a mesh
  std::vector<Texture> textures;
  std::vector<Camera> cameras;
  std::shared_ptr<const Source> source;  ///< what it was read from, or null
};

/// The texture coordinates by which receivers on texels lie.
inline const std::vector<Vec2>& texelUvsOf(const Mesh& mesh) {
  return mesh.texelUvs.empty() ? mesh.uvs : mesh.texelUvs;
}

/// A mesh's material; the default one where it names none that there is.
const Material& materialOf(const Scene& scene, const Mesh& mesh);

struct Box {
  Vec3 lower = Vec3::Constant(std::numeric_limits<float>::infinity());
  Vec3 upper = Vec3::Constant(-std::numeric_limits<float>::infinity());
  bool empty() const { return !(lower.x() <= upper.x()); }
  float diagonal() const { return empty() ? 0.0f : (upper - lower).norm(); }
  Vec3 center() const { return 0.5f * (lower + upper); }
  void extend(const Vec3& p) {
    lower = lower.cwiseMin(p);
    upper = upper.cwiseMax(p);
  }
};

/// Of all positions, those of no triangle too.
Box bounds(const Mesh& mesh);
Box bounds(const Scene& scene);

/// Bilinear look-up in linear RGB; uv as glTF has it, (0, 0) the upper left corner.
Rgb sampleBaseColor(const Texture& texture, const Vec2& uv);

/// The alpha of a texture, [0, 1], looked up in the same way.
float sampleAlpha(const Texture& texture, const Vec2& uv);

/// A point of a surface with its material evaluated: what the path tracer and the bake both see.
struct SurfacePoint {
  Vec3 position;
  Vec3 normal;           ///< unit shading normal, on the front side
  Vec3 geometricNormal;  ///< unit, by the triangle's winding
  Vec2 uv = Vec2::Zero();
  Vec2 texelUv = Vec2::Zero();  ///< by texelUvsOf(mesh)
  Rgb diffuse, glossy, mirror;  ///< reflectances with texture and vertex colour applied
  float lobeExponent = 0.0f;
  Rgb emission = Rgb::Zero();  ///< radiance that leaves the front by itself
};

/// The point of `triangle` with barycentric coordinates (1−u−v, u, v).
SurfacePoint surfaceAt(const Scene& scene, std::uint32_t mesh, std::uint32_t triangle, float u,
                       float v);

/// What multiplies the reflectances there: texture × vertex colour, in [0, 1].
Rgb baseColorAt(const Scene& scene, std::uint32_t mesh, std::uint32_t triangle, float u, float v);

/// The vertex of a mesh as a SurfacePoint (geometricNormal = normal).
SurfacePoint surfaceAtVertex(const Scene& scene, std::uint32_t mesh, std::uint32_t vertex);

}  // namespace lambent::scene
