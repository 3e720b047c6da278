// Small assets with transfer in closed form, for the tests of shade and render: what a bake would
// yield for surfaces that nothing blocks.
#pragma once

#include <cstdint>
#include <optional>

#include "lambent/asset/asset.h"
#include "lambent/light/environment.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/shade.h"

namespace lambent::shade::test {

/// A sphere of 2·rings × rings quads, with texture coordinates.
scene::Mesh sphere(const Vec3& center, float radius, int rings);
/// Two triangles, seen from above (+y) front first; uv (0, 0) at its far left corner.
scene::Mesh floor(const Vec3& center, float halfSide);

struct DiffuseOptions {
  int bands = 5;
  int channels = 1;
  transfer::Encoding encoding = transfer::Encoding::Float32;
  bool texture = false;  ///< a base-colour texture, kept outside the vectors
};
/// Unshadowed diffuse transfer at the vertices; with three channels, a reflectance that differs
/// from vertex to vertex.
void addDiffuse(asset::Asset& asset, scene::Mesh mesh, const DiffuseOptions& options);
/// Diffuse and glossy at once: hemispheres as glossy matrices, at the vertices.
void addGlossy(asset::Asset& asset, scene::Mesh mesh, int outBands, int inBands, int channels,
               transfer::Encoding encoding);
/// A grid of texels over the mesh's uv, diffuse and (if outBands > 0) glossy, that differ from
/// texel to texel. All receivers look along `normal`.
void addTexels(asset::Asset& asset, scene::Mesh mesh, const Vec3& normal, int width, int height,
               int outBands, transfer::Encoding encoding);
void addMirror(asset::Asset& asset, scene::Mesh mesh, const Rgb& reflectance);

/// A sky with a warm sun, smooth enough for an image of 64×32, and its harmonics.
light::Environment sky();

/// How receivers look from a place.
ReceiverView seenFrom(const Vec3& eye, std::optional<float> lobeExponent = {});

scene::Camera cameraAt(const Vec3& eye, const Vec3& target);

}  // namespace lambent::shade::test
