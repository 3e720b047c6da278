// What the tests of this room share: files of their own, and equality to the last bit.
#pragma once

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/asset/format.h"
#include "lambent/file/atomic_file.h"

namespace lambent::asset::test {

/// The published specification, and the name of the extension.
inline const std::filesystem::path kSpec = LAMBENT_SPEC_DIR;
inline const std::string kName(kExtensionName);

/// A folder that goes with the test.
class Folder {
 public:
  Folder() {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    path_ = std::filesystem::path(::testing::TempDir()) /
            (std::string("lambent_") + test->test_suite_name() + "_" + test->name());
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::vector<std::byte> bytesOf(const std::filesystem::path& path) {
  Result<std::vector<std::byte>> bytes = file::readWhole(path);
  EXPECT_TRUE(bytes) << bytes.error().message;
  return bytes ? *bytes : std::vector<std::byte>{};
}

/// Without the sync to disk that file::writeAtomically takes its time for. Removed first: some file
/// systems sync a file that is cut to nothing and written again.
inline void spill(const std::filesystem::path& path, std::span<const std::byte> bytes) {
  std::filesystem::remove(path);
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  ASSERT_TRUE(file.good());
}

template <class T>
bool sameBits(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0);
}

inline void expectSame(const scene::Mesh& a, const scene::Mesh& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.material, b.material);
  EXPECT_TRUE(sameBits(a.positions, b.positions));
  EXPECT_TRUE(sameBits(a.normals, b.normals));
  EXPECT_TRUE(sameBits(a.uvs, b.uvs));
  EXPECT_TRUE(sameBits(a.texelUvs, b.texelUvs));
  EXPECT_EQ(a.layer, b.layer);
  EXPECT_TRUE(sameBits(a.colors, b.colors));
  EXPECT_EQ(a.triangles, b.triangles);
}

inline void expectSame(const transfer::Numbers& a, const transfer::Numbers& b) {
  EXPECT_EQ(a.encoding, b.encoding);
  EXPECT_TRUE(sameBits(a.half, b.half));
  EXPECT_TRUE(sameBits(a.single, b.single));
  EXPECT_TRUE(sameBits(a.byte, b.byte));
  EXPECT_TRUE(sameBits(a.scales, b.scales));
  EXPECT_EQ(a.block, b.block);
}

inline void expectSame(const transfer::Vectors<transfer::Numbers>& a,
                       const transfer::Vectors<transfer::Numbers>& b) {
  EXPECT_EQ(a.bands, b.bands);
  EXPECT_EQ(a.channels, b.channels);
  expectSame(a.numbers, b.numbers);
}

inline void expectSame(const transfer::Matrices<transfer::Numbers>& a,
                       const transfer::Matrices<transfer::Numbers>& b) {
  EXPECT_EQ(a.outBands, b.outBands);
  EXPECT_EQ(a.inBands, b.inBands);
  EXPECT_EQ(a.channels, b.channels);
  expectSame(a.numbers, b.numbers);
}

inline void expectSame(const transfer::SurfaceResponse<transfer::Numbers>& a,
                       const transfer::SurfaceResponse<transfer::Numbers>& b) {
  ASSERT_EQ(a.diffuse.has_value(), b.diffuse.has_value());
  if (a.diffuse) {
    EXPECT_EQ(a.diffuse->albedo, b.diffuse->albedo);
    expectSame(a.diffuse->vectors, b.diffuse->vectors);
  }
  ASSERT_EQ(a.glossy.has_value(), b.glossy.has_value());
  if (a.glossy) {
    EXPECT_TRUE((a.glossy->lobe.reflectance == b.glossy->lobe.reflectance).all());
    EXPECT_EQ(a.glossy->lobe.exponent, b.glossy->lobe.exponent);
    expectSame(a.glossy->matrices, b.glossy->matrices);
  }
}

template <class T>
void expectSame(const transfer::ByKind<T>& a, const transfer::ByKind<T>& b) {
  for (const transfer::Kind kind : transfer::kKinds) {
    SCOPED_TRACE(int(kind));
    ASSERT_EQ(a.holds(kind), b.holds(kind));
    if (a.holds(kind)) expectSame(*a.find(kind), *b.find(kind));
  }
}

inline void expectSame(const transfer::Receivers& a, const transfer::Receivers& b) {
  EXPECT_TRUE(sameBits(a.positions, b.positions));
  EXPECT_TRUE(sameBits(a.normals, b.normals));
  ASSERT_EQ(a.where.index(), b.where.index());
  if (!a.texels()) return;
  EXPECT_EQ(a.texels()->width, b.texels()->width);
  EXPECT_EQ(a.texels()->height, b.texels()->height);
  EXPECT_EQ(a.texels()->covered, b.texels()->covered);
}

inline void expectSame(const transfer::Surface<transfer::Numbers>& a,
                       const transfer::Surface<transfer::Numbers>& b) {
  expectSame(*a.receivers, *b.receivers);
  expectSame(a.responses, b.responses);
}

inline void expectSame(const transfer::BiScale<transfer::Numbers>& a,
                       const transfer::BiScale<transfer::Numbers>& b) {
  expectSame(*a.receivers, *b.receivers);
  EXPECT_TRUE(sameBits(a.tangents, b.tangents));
  EXPECT_EQ(a.patch.rtt, b.patch.rtt);
  EXPECT_EQ(a.patch.scale, b.patch.scale);
  ASSERT_EQ(a.patch.place.index(), b.patch.place.index());
  EXPECT_EQ(a.patch.tiles(), b.patch.tiles());
  if (a.patch.idMap()) {
    EXPECT_EQ(a.patch.idMap()->width, b.patch.idMap()->width);
    EXPECT_EQ(a.patch.idMap()->height, b.patch.idMap()->height);
    EXPECT_EQ(a.patch.idMap()->ids, b.patch.idMap()->ids);
  }
  EXPECT_EQ(a.bands, b.bands);
  expectSame(a.matrices, b.matrices);
}

inline void expectSame(const transfer::EncodedRtt& a, const transfer::EncodedRtt& b) {
  EXPECT_EQ(a.name, b.name);
  EXPECT_EQ(a.width, b.width);
  EXPECT_EQ(a.height, b.height);
  EXPECT_EQ(a.views, b.views);
  EXPECT_EQ(a.bands, b.bands);
  EXPECT_EQ(a.size, b.size);
  EXPECT_EQ(a.depth, b.depth);
  expectSame(a.values, b.values);
  EXPECT_EQ(a.heights, b.heights);
}

inline void expectSame(const transfer::NoTransfer&, const transfer::NoTransfer&) {}

inline void expectSame(const transfer::EncodedMesh& a, const transfer::EncodedMesh& b) {
  ASSERT_EQ(a.index(), b.index());
  std::visit([&](const auto& x) { expectSame(x, std::get<std::decay_t<decltype(x)>>(b)); }, a);
}

inline void expectSame(const Asset& a, const Asset& b) {
  ASSERT_EQ(a.transfer.rtts.size(), b.transfer.rtts.size());
  for (std::size_t i = 0; i < a.transfer.rtts.size(); ++i)
    expectSame(a.transfer.rtts[i], b.transfer.rtts[i]);
  ASSERT_EQ(a.scene.meshes.size(), b.scene.meshes.size());
  for (std::size_t i = 0; i < a.scene.meshes.size(); ++i)
    expectSame(a.scene.meshes[i], b.scene.meshes[i]);
  ASSERT_EQ(a.scene.materials.size(), b.scene.materials.size());
  for (std::size_t i = 0; i < a.scene.materials.size(); ++i) {
    const scene::Material &x = a.scene.materials[i], &y = b.scene.materials[i];
    EXPECT_EQ(x.name, y.name);
    EXPECT_TRUE((x.diffuse == y.diffuse).all());
    EXPECT_TRUE((x.glossy == y.glossy).all());
    EXPECT_TRUE((x.mirror == y.mirror).all());
    EXPECT_EQ(x.lobeExponent, y.lobeExponent);
    EXPECT_EQ(x.baseColorTexture, y.baseColorTexture);
    EXPECT_EQ(x.doubleSided, y.doubleSided);
  }
  ASSERT_EQ(a.scene.textures.size(), b.scene.textures.size());
  for (std::size_t i = 0; i < a.scene.textures.size(); ++i) {
    EXPECT_EQ(a.scene.textures[i].encoded, b.scene.textures[i].encoded);
    EXPECT_EQ(a.scene.textures[i].mimeType, b.scene.textures[i].mimeType);
    EXPECT_EQ(a.scene.textures[i].rgba, b.scene.textures[i].rgba);
    EXPECT_EQ(a.scene.textures[i].wrapU, b.scene.textures[i].wrapU);
    EXPECT_EQ(a.scene.textures[i].wrapV, b.scene.textures[i].wrapV);
  }
  ASSERT_EQ(a.scene.cameras.size(), b.scene.cameras.size());
  for (std::size_t i = 0; i < a.scene.cameras.size(); ++i) {
    EXPECT_EQ(a.scene.cameras[i].name, b.scene.cameras[i].name);
    EXPECT_EQ(a.scene.cameras[i].worldFromCamera, b.scene.cameras[i].worldFromCamera);
    EXPECT_EQ(a.scene.cameras[i].verticalFov, b.scene.cameras[i].verticalFov);
    EXPECT_EQ(a.scene.cameras[i].orthographicHalfHeight, b.scene.cameras[i].orthographicHalfHeight);
  }
  EXPECT_EQ(a.transfer.kind, b.transfer.kind);
  EXPECT_EQ(a.transfer.bands, b.transfer.bands);
  EXPECT_EQ(a.transfer.directions, b.transfer.directions);
  EXPECT_EQ(a.transfer.bounces, b.transfer.bounces);
  EXPECT_EQ(a.transfer.seed, b.transfer.seed);
  EXPECT_EQ(a.transfer.passEnergy, b.transfer.passEnergy);
  ASSERT_EQ(a.transfer.meshes.size(), b.transfer.meshes.size());
  for (std::size_t i = 0; i < a.transfer.meshes.size(); ++i)
    expectSame(a.transfer.meshes[i], b.transfer.meshes[i]);
}

/// A .glb as its two chunks, to be damaged with care.
struct Glb {
  std::string json;
  std::vector<std::byte> binary;

  static Glb parse(std::span<const std::byte> file) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value;
      std::memcpy(&value, file.data() + at, 4);
      return std::size_t(value);
    };
    Glb glb;
    const std::size_t length = word(12);
    glb.json.assign(reinterpret_cast<const char*>(file.data()) + 20, length);
    if (file.size() > 28 + length)
      glb.binary.assign(file.begin() + std::ptrdiff_t(28 + length), file.end());
    return glb;
  }

  std::vector<std::byte> bytes() const {
    std::string text = json;
    text.resize((text.size() + 3) / 4 * 4, ' ');
    std::vector<std::byte> file;
    const auto word = [&](std::size_t value) {
      for (int i = 0; i < 4; ++i) file.push_back(std::byte(value >> (8 * i) & 255));
    };
    word(0x46546c67), word(2), word(12 + 8 + text.size() + 8 + binary.size());
    word(text.size()), word(0x4e4f534a);
    const auto chars = std::as_bytes(std::span(text));
    file.insert(file.end(), chars.begin(), chars.end());
    word(binary.size()), word(0x004e4942);
    file.insert(file.end(), binary.begin(), binary.end());
    return file;
  }
};

}  // namespace lambent::asset::test
