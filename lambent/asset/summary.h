// What is in an asset, counted: for a person or a program that asks.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/asset/part_bytes.h"
#include "lambent/transfer/names.h"

namespace lambent::asset {

struct VectorsSummary {
  int bands = 0, channels = 0;
  transfer::Encoding encoding = transfer::Encoding::Float16;
  transfer::Albedo albedo = transfer::Albedo::Included;
  std::uint64_t bytes = 0;
};

struct MatricesSummary {
  int outBands = 0, inBands = 0, channels = 0;
  transfer::Encoding encoding = transfer::Encoding::Float16;
  Rgb glossy = Rgb::Zero();
  float lobeExponent = 0.0f;
  std::uint64_t bytes = 0;
};

/// Shadowed transfer kept beside the interreflected one.
struct ShadowedSummary {
  int channels = 0, matrixChannels = 0;  ///< 0: no vectors, no matrices
  std::uint64_t bytes = 0;
};

struct RttSummary {
  std::string name;
  int width = 0, height = 0, views = 0, bands = 0;
  Vec2 size = Vec2(1.0f, 1.0f);  ///< metres
  float depth = 0.0f;
  transfer::Encoding encoding = transfer::Encoding::Float16;
  std::uint64_t bytes = 0;
};

struct BiScaleSummary {
  int rtt = 0, bands = 0;
  float scale = 1.0f;
  int idMapWidth = 0, idMapHeight = 0;  ///< 0: no id map, the mesh's UVs place the patch
  Vec2 tiles = Vec2(1.0f, 1.0f);
  bool shadowed = false, interreflected = false;  ///< which matrices are there
  int channels = 0;                               ///< of the interreflected ones
  transfer::Encoding encoding = transfer::Encoding::Float16;
  std::uint64_t bytes = 0;            ///< of the matrices
  int tintWidth = 0, tintHeight = 0;  ///< texels of the texture that tints it; 0: none
  bool tintedVertices = false;        ///< colours of its vertices do
  bool layer = false;                 ///< it lies on another mesh
};

struct MeshSummary {
  std::string name, material;
  bool mirror = false;  ///< reflects, and holds no transfer
  std::uint64_t vertices = 0, triangles = 0;
  std::string_view layout = transfer::kNoLayout;  ///< none, vertices or texels
  int width = 0, height = 0;                      ///< Texels only
  int texCoord = 0;                               ///< of texels: the UV set that they lie on
  std::uint64_t receivers = 0;
  std::uint64_t covered = 0;  ///< Texels: receivers with a surface point of their own
  std::optional<VectorsSummary> vectors;
  std::optional<MatricesSummary> matrices;
  std::optional<ShadowedSummary> shadowed;
  std::optional<BiScaleSummary> biScale;
};

struct Summary {
  transfer::Kind kind = transfer::Kind::Shadowed;
  int bands = 0, directions = 0, bounces = 0;
  std::uint64_t seed = 0;
  std::vector<double> passEnergy;
  std::uint64_t vertices = 0, triangles = 0, receivers = 0;
  std::uint64_t materials = 0, textures = 0, cameras = 0;
  PartBytes bytes;
  std::uint64_t memoryBytes = 0;  ///< of the Asset in memory, textures decoded
  std::vector<MeshSummary> meshes;
  std::vector<RttSummary> rtts;
};

RttSummary summarize(const transfer::EncodedRtt& rtt);
Summary summarize(const Asset& asset);

}  // namespace lambent::asset
