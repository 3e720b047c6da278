#include "lambent/shade/test_assets.h"

#include <cmath>

#include <Eigen/Geometry>

#include "lambent/math/directions.h"
#include "lambent/sh/product.h"
#include "lambent/sh/zonal.h"

namespace lambent::shade::test {

using transfer::Encoding;
using transfer::Numbers;

scene::Mesh sphere(const Vec3& center, float radius, int rings) {
  scene::Mesh mesh;
  mesh.name = "sphere";
  const int columns = 2 * rings;
  for (int i = 0; i <= rings; ++i)
    for (int j = 0; j <= columns; ++j) {
      const double polar = kPi * i / rings, azimuth = 2 * kPi * j / columns;
      const Vec3 n(float(std::sin(polar) * std::cos(azimuth)), float(std::cos(polar)),
                   float(-std::sin(polar) * std::sin(azimuth)));
      mesh.positions.push_back(center + radius * n);
      mesh.normals.push_back(n.normalized());
      mesh.uvs.emplace_back(float(j) / columns, float(i) / rings);
    }
  const auto at = [&](int i, int j) { return std::uint32_t(i * (columns + 1) + j); };
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < columns; ++j) {
      if (i > 0) mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i + 1 < rings) mesh.triangles.push_back({at(i, j + 1), at(i + 1, j), at(i + 1, j + 1)});
    }
  return mesh;
}

scene::Mesh floor(const Vec3& center, float halfSide) {
  scene::Mesh mesh;
  mesh.name = "floor";
  for (const auto& [x, z] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}}) {
    mesh.positions.push_back(center +
                             Vec3((2.0f * x - 1) * halfSide, 0.0f, (2.0f * z - 1) * halfSide));
    mesh.normals.push_back(Vec3::UnitY());
    mesh.uvs.emplace_back(float(x), float(z));
  }
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

namespace {

int addTexture(scene::Scene& scene) {
  scene::Texture texture;
  texture.width = 16;
  texture.height = 8;
  texture.wrapV = scene::Wrap::MirroredRepeat;
  for (int y = 0; y < texture.height; ++y)
    for (int x = 0; x < texture.width; ++x) {
      const bool dark = (x / 2 + y / 2) % 2;
      texture.rgba.insert(texture.rgba.end(), {std::uint8_t(dark ? 60 : 255), std::uint8_t(15 * x),
                                               std::uint8_t(255 - 30 * y), 255});
    }
  scene.textures.push_back(std::move(texture));
  return int(scene.textures.size()) - 1;
}

Rgb reflectanceAt(const Vec3& p) {
  return Rgb(0.5f + 0.4f * std::sin(5 * p.x()), 0.5f + 0.4f * std::sin(4 * p.y() + 1),
             0.5f + 0.4f * std::sin(6 * p.z() + 2));
}

void appendVector(std::vector<float>& out, int bands, const Vec3& normal, float reflectance) {
  std::vector<double> vector(sh::coefficientCount(bands));
  sh::turnTo(sh::clampedCosine(bands), normal.cast<double>(), std::span<double>(vector));
  for (const double m : vector) out.push_back(float(m * reflectance / kPi));
}

void appendMatrix(std::vector<float>& out, int outBands, int inBands, const Vec3& normal,
                  float scale) {
  const int bands = outBands + inBands - 1;
  std::vector<double> visible(sh::coefficientCount(bands));
  sh::turnTo(sh::hemisphere(bands), normal.cast<double>(), std::span<double>(visible));
  std::vector<double> matrix(sh::coefficientCount(outBands) * sh::coefficientCount(inBands));
  sh::productMatrix(visible, outBands, inBands, matrix);
  for (const double m : matrix) out.push_back(float(m * scale));
}

void add(asset::Asset& asset, scene::Mesh mesh, scene::Material material,
         transfer::EncodedMesh transfer) {
  mesh.material = int(asset.scene.materials.size());
  asset.scene.materials.push_back(std::move(material));
  asset.scene.meshes.push_back(std::move(mesh));
  asset.transfer.meshes.push_back(std::move(transfer));
}

void addSurface(asset::Asset& asset, scene::Mesh mesh, scene::Material material,
                transfer::Receivers receivers, transfer::SurfaceResponse<Numbers> response) {
  transfer::Surface<Numbers> surface{
      std::make_shared<const transfer::Receivers>(std::move(receivers)), {}};
  surface.responses.set(asset.transfer.kind, std::move(response));
  add(asset, std::move(mesh), std::move(material), std::move(surface));
}

}  // namespace

void addDiffuse(asset::Asset& asset, scene::Mesh mesh, const DiffuseOptions& options) {
  scene::Material material;
  transfer::Diffuse<Numbers> diffuse{{}, {options.bands, options.channels, {}}};
  if (options.texture) {
    material.baseColorTexture = addTexture(asset.scene);
    diffuse.albedo = transfer::Albedo::BaseColor;
  }
  std::vector<float> vectors;
  for (std::size_t p = 0; p < mesh.positions.size(); ++p)
    for (int c = 0; c < options.channels; ++c)
      appendVector(vectors, options.bands, mesh.normals[p],
                   options.channels == 1 ? 0.8f : reflectanceAt(mesh.positions[p])[c]);
  diffuse.vectors.numbers =
      transfer::encode(vectors, options.encoding, diffuse.vectors.perVector());
  const transfer::Receivers receivers{mesh.positions, mesh.normals, transfer::AtVertices{}};
  addSurface(asset, std::move(mesh), std::move(material), receivers, {std::move(diffuse), {}});
}

void addGlossy(asset::Asset& asset, scene::Mesh mesh, int outBands, int inBands, int channels,
               Encoding encoding) {
  scene::Material material;
  material.diffuse = Rgb(0.1f, 0.1f, 0.2f);
  material.glossy = Rgb(0.8f, 0.6f, 0.3f);
  material.lobeExponent = 12.0f;
  std::vector<float> vectors, matrices;
  for (std::size_t p = 0; p < mesh.positions.size(); ++p) {
    for (int c = 0; c < 3; ++c)
      appendVector(vectors, inBands, mesh.normals[p], material.diffuse[c]);
    for (int c = 0; c < channels; ++c)
      appendMatrix(matrices, outBands, inBands, mesh.normals[p],
                   channels == 1 ? 1.0f : reflectanceAt(mesh.positions[p])[c]);
  }
  const transfer::Receivers receivers{mesh.positions, mesh.normals, transfer::AtVertices{}};
  const transfer::Lobe lobe{material.glossy, material.lobeExponent};
  addSurface(asset, std::move(mesh), std::move(material), receivers,
             {transfer::Diffuse<Numbers>{{}, {inBands, 3, transfer::encode(vectors, encoding)}},
              transfer::Glossy<Numbers>{
                  lobe, {outBands, inBands, channels, transfer::encode(matrices, encoding)}}});
}

void addTexels(asset::Asset& asset, scene::Mesh mesh, const Vec3& normal, int width, int height,
               int outBands, Encoding encoding) {
  const int bands = 4;
  scene::Material material;
  transfer::Receivers receivers;
  std::vector<float> vectors, matrices;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      receivers.positions.push_back(Vec3::Zero());
      receivers.normals.push_back(normal);
      // Rings around a corner, redder to the right and bluer downwards: no symmetry hides a flip.
      const float ring = 0.5f + 0.5f * std::cos(0.9f * std::hypot(float(x), float(y)));
      const Rgb rho(float(x) / width, 0.6f * ring, float(y) / height);
      for (int c = 0; c < 3; ++c) appendVector(vectors, bands, normal, rho[c]);
      if (outBands > 0) appendMatrix(matrices, outBands, bands, normal, ring);
    }
  receivers.where = transfer::AtTexels{
      width, height, std::vector<std::uint8_t>(std::size_t(width) * std::size_t(height), 1)};
  transfer::SurfaceResponse<Numbers> response;
  response.diffuse = {{}, {bands, 3, transfer::encode(vectors, encoding)}};
  if (outBands > 0) {
    material.glossy = Rgb(0.5f, 0.5f, 0.6f);
    response.glossy = {{material.glossy, 20.0f},
                       {outBands, bands, 1, transfer::encode(matrices, encoding)}};
  }
  addSurface(asset, std::move(mesh), std::move(material), receivers, std::move(response));
}

void addMirror(asset::Asset& asset, scene::Mesh mesh, const Rgb& reflectance) {
  scene::Material material;
  material.diffuse = Rgb::Zero();
  material.mirror = reflectance;
  add(asset, std::move(mesh), std::move(material), {});
}

light::Environment sky() {
  const Vec3 sun = Vec3(-0.5f, 0.6f, 0.6f).normalized();
  image::Image image(64, 32);
  for (int y = 0; y < image.height; ++y)
    for (int x = 0; x < image.width; ++x) {
      const double azimuth = 2 * kPi * ((x + 0.5) / image.width - 0.5);
      const double elevation = kPi * (0.5 - (y + 0.5) / image.height);
      const Vec3 d = math::directionFromAzimuthElevation(azimuth, elevation).cast<float>();
      const float up = 0.5f + 0.5f * d.y();
      image.at(x, y) = Rgb(0.25f, 0.2f, 0.15f) * (1 - up) + Rgb(0.3f, 0.5f, 0.9f) * up +
                       Rgb(6.0f, 4.5f, 2.5f) * std::exp(12.0f * (d.dot(sun) - 1.0f));
    }
  return light::Environment::latLong(std::move(image));
}

ReceiverView seenFrom(const Vec3& eye, std::optional<float> lobeExponent) {
  ReceiverView view;
  view.eye = eye;
  view.showing.lobeExponent = lobeExponent;
  return view;
}

scene::Camera cameraAt(const Vec3& eye, const Vec3& target) {
  const Vec3 back = (eye - target).normalized();
  const Vec3 right = Vec3::UnitY().cross(back).normalized();
  scene::Camera camera;
  camera.worldFromCamera.block<3, 1>(0, 0) = right;
  camera.worldFromCamera.block<3, 1>(0, 1) = back.cross(right);
  camera.worldFromCamera.block<3, 1>(0, 2) = back;
  camera.worldFromCamera.block<3, 1>(0, 3) = eye;
  return camera;
}

}  // namespace lambent::shade::test
