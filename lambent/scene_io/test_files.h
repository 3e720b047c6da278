// Files for the tests of this room: a folder that vanishes, and what every loaded scene must be.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "lambent/scene_io/load.h"

namespace lambent::scene_io {

class TemporaryFolder {
 public:
  TemporaryFolder() {
    static std::atomic<int> number = 0;
    // Thousands of small files are written here: in memory where that is to be had.
    std::error_code error;
    const bool memory =
        std::filesystem::is_directory("/dev/shm", error) && access("/dev/shm", W_OK) == 0;
    path_ = (memory ? std::filesystem::path("/dev/shm") : std::filesystem::temp_directory_path()) /
            ("lambent-scene-io-" + std::to_string(getpid()) + "-" + std::to_string(number++));
    std::filesystem::create_directories(path_);
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    const std::filesystem::path path = path_ / name;
    std::ofstream(path, std::ios::binary).write(content.data(), std::streamsize(content.size()));
    return path;
  }
  std::filesystem::path write(const std::string& name, std::span<const std::byte> content) const {
    return write(name, {reinterpret_cast<const char*>(content.data()), content.size()});
  }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string contentOf(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// The promise of load(): finite positions, indices in range, unit normals, no empty scene.
inline void expectSound(const scene::Scene& scene) {
  ASSERT_FALSE(scene.meshes.empty());
  for (const scene::Mesh& mesh : scene.meshes) {
    ASSERT_GE(mesh.material, 0);
    ASSERT_LT(std::size_t(mesh.material), scene.materials.size());
    ASSERT_FALSE(mesh.triangles.empty());
    ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
    ASSERT_TRUE(mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size());
    ASSERT_TRUE(mesh.colors.empty() || mesh.colors.size() == mesh.positions.size());
    for (const Vec3& p : mesh.positions) ASSERT_TRUE(p.allFinite());
    for (const Vec3& n : mesh.normals) ASSERT_NEAR(n.norm(), 1.0f, 1e-5f);
    for (const scene::Triangle& t : mesh.triangles) {
      for (std::uint32_t v : t) ASSERT_LT(v, mesh.positions.size());
    }
  }
  for (const scene::Material& material : scene.materials) {
    ASSERT_LT(material.baseColorTexture, int(scene.textures.size()));
    for (const Rgb& c : {material.diffuse, material.glossy, material.mirror}) {
      ASSERT_TRUE((c >= 0.0f).all() && (c <= 1.0f).all());
    }
  }
}

/// A file that must be refused as bad input, with all of `parts` and the file's name in the
/// message.
inline void expectBadInput(const std::filesystem::path& path,
                           std::initializer_list<std::string> parts) {
  const Result<LoadedScene> loaded = load(path);
  ASSERT_FALSE(loaded) << path;
  EXPECT_EQ(loaded.error().kind, ErrorKind::BadInput);
  const std::string& message = loaded.error().message;
  EXPECT_NE(message.find(path.filename().string()), std::string::npos) << message;
  for (const std::string& part : parts) {
    EXPECT_NE(message.find(part), std::string::npos) << message << "\nlacks: " << part;
  }
}

inline std::uint64_t countOf(const Findings& findings, std::string_view code) {
  for (const Finding& finding : findings) {
    if (finding.code == code) return finding.count;
  }
  return 0;
}

/// Truncated at many places, and with bytes changed at random (the same ones each time): whatever
/// comes of it is an error or a sound scene.
inline void abuse(const TemporaryFolder& folder, const std::string& name,
                  const std::string& content, std::size_t step, int mutations) {
  const auto check = [&](const std::string& bytes) {
    const Result<LoadedScene> loaded = load(folder.write(name, std::string_view(bytes)));
    if (loaded) {
      expectSound(loaded->scene);
    } else {
      EXPECT_EQ(loaded.error().kind, ErrorKind::BadInput) << loaded.error().message;
    }
  };
  for (std::size_t size = 0; size < content.size(); size += step) check(content.substr(0, size));
  std::uint64_t state = 1;
  const auto random = [&] {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    return std::size_t(state >> 33);
  };
  constexpr unsigned char kNasty[] = {0, 1, 0x7f, 0x80, 0xff, '-', '9', '{', '"', ' '};
  for (int i = 0; i < mutations; ++i) {
    std::string bytes = content;
    const std::size_t changes = 1 + random() % 4;
    for (std::size_t c = 0; c < changes; ++c) {
      const std::size_t place = random() % bytes.size();
      bytes[place] = char(random() % 2 ? kNasty[random() % 10] : random() % 256);
    }
    check(bytes);
    if (testing::Test::HasFatalFailure()) return;
  }
}

}  // namespace lambent::scene_io
