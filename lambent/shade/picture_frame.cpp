#include "lambent/shade/picture_frame.h"

#include <cmath>

#include <fmt/format.h>
#include <tbb/parallel_for.h>
#include <Eigen/LU>

#include "lambent/shade/check_bi_scale.h"

namespace lambent::shade {
namespace {

constexpr int kLargestSide = 16384;
constexpr int kMostSamples = 4096;

using encode::EncodedMesh;
using transport::Layout;

Status checkTransfer(const std::string& where, const char* what, const encode::Numbers& numbers,
                     std::size_t receivers, int channels, int perChannel) {
  if (numbers.empty()) return Status::ok();
  if (channels != 1 && channels != 3)
    return report::badInput(fmt::format(
        "{}: {} of {} channels, where 1 or 3 can be. Bake the asset again", where, what, channels));
  return checkNumbers(fmt::format("{}: its {}", where, what), numbers,
                      receivers * channels * perChannel);
}

bool bandsStand(int bands) {
  return bands >= 1 && bands <= sh::kMaxBands;
}

Status checkMesh(const std::string& where, const scene::Mesh& mesh, const EncodedMesh& transfer) {
  if (mesh.normals.size() != mesh.positions.size())
    return report::badInput(fmt::format("{}: {} normals for {} vertices", where,
                                        mesh.normals.size(), mesh.positions.size()));
  if ((!mesh.uvs.empty() && mesh.uvs.size() != mesh.positions.size()) ||
      (!mesh.colors.empty() && mesh.colors.size() != mesh.positions.size()))
    return report::badInput(where + ": texture coordinates or colours do not match the vertices");
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t index : mesh.triangles[t])
      if (index >= mesh.positions.size())
        return report::badInput(fmt::format("{}: triangle {} names vertex {}, but there are {}",
                                            where, t, index, mesh.positions.size()));
  if (transfer.layout == Layout::None) return Status::ok();

  const std::size_t receivers = transfer.receiverCount();
  if (transfer.layout == Layout::Vertices && receivers != mesh.positions.size())
    return report::badInput(
        fmt::format("{}: {} receivers for {} vertices: the transfer belongs to another mesh. Bake "
                    "the scene again",
                    where, receivers, mesh.positions.size()));
  if (transfer.layout == Layout::Texels) {
    if (transfer.width < 1 || transfer.height < 1 ||
        receivers != std::size_t(transfer.width) * transfer.height)
      return report::badInput(fmt::format("{}: {} receivers for a grid of {}×{} texels", where,
                                          receivers, transfer.width, transfer.height));
    if (mesh.uvs.empty())
      return report::badInput(where + ": a texel grid, but no texture coordinates to find it by");
  }
  if (!transfer.vectors.empty() && !bandsStand(transfer.bands))
    return report::badInput(fmt::format("{}: vectors of {} bands, where 1 to {} can be", where,
                                        transfer.bands, sh::kMaxBands));
  if (!transfer.matrices.empty() &&
      !(bandsStand(transfer.inBands) && bandsStand(transfer.outBands)))
    return report::badInput(fmt::format("{}: matrices of {}×{} bands, where 1 to {} can be", where,
                                        transfer.outBands, transfer.inBands, sh::kMaxBands));
  if (Status s = checkTransfer(where, "transfer vectors", transfer.vectors, receivers,
                               transfer.channels, sh::coefficientCount(transfer.bands));
      !s)
    return s;
  const int matrix =
      sh::coefficientCount(transfer.outBands) * sh::coefficientCount(transfer.inBands);
  if (Status s = checkTransfer(where, "transfer matrices", transfer.matrices, receivers,
                               transfer.matrixChannels, matrix);
      !s)
    return s;
  const encode::EncodedShadowed& kept = transfer.shadowed;
  if (!kept.empty() && (kept.vectors.empty() != transfer.vectors.empty() ||
                        kept.matrices.empty() != transfer.matrices.empty()))
    return report::badInput(
        fmt::format("{}: its shadowed transfer lacks what the interreflected one has", where));
  if (Status s = checkTransfer(where, "shadowed transfer vectors", kept.vectors, receivers,
                               kept.channels, sh::coefficientCount(transfer.bands));
      !s)
    return s;
  return checkTransfer(where, "shadowed transfer matrices", kept.matrices, receivers,
                       kept.matrixChannels, matrix);
}

}  // namespace

Status checkCamera(const scene::Camera& camera) {
  const Eigen::Matrix4f world = camera.worldFromCamera;
  if (!world.allFinite() || !(std::abs(world.topLeftCorner<3, 3>().determinant()) > 0.0f))
    return report::badInput(
        fmt::format("camera '{}': its matrix is not a placement in space", camera.name));
  return Status::ok();
}

Status checkOptions(const PictureOptions& options) {
  if (options.width < 1 || options.height < 1 || options.width > kLargestSide ||
      options.height > kLargestSide)
    return report::badUsage(fmt::format("a picture of {}×{} pixels: each side can be 1 to {}",
                                        options.width, options.height, kLargestSide));
  if (options.samples < 1 || options.samples > kMostSamples)
    return report::badUsage(
        fmt::format("{} samples a pixel: 1 to {} can be", options.samples, kMostSamples));
  if (options.lobeExponent && !(*options.lobeExponent >= 0.0f && *options.lobeExponent < 1e6f))
    return report::badUsage(
        fmt::format("a lobe exponent of {}: 0 to 1e6 can be", *options.lobeExponent));
  return Status::ok();
}

Status checkPicture(const asset::Asset& asset, const sh::RgbCoefficients& light,
                    const scene::Camera& camera, const PictureOptions& options) {
  if (Status s = checkOptions(options); !s) return s;
  if (light.bands < 1 || light.values.size() != 3u * sh::coefficientCount(light.bands))
    return report::badInput("a light without bands, or with too few numbers for them");
  if (Status s = checkCamera(camera); !s) return s;

  const std::size_t meshes = asset.scene.meshes.size();
  if (meshes != asset.transfer.meshes.size())
    return report::badInput(fmt::format("{} meshes, but transfer for {}. Bake the scene again",
                                        meshes, asset.transfer.meshes.size()));
  std::size_t triangles = 0;
  for (std::size_t m = 0; m < meshes; ++m) {
    const scene::Mesh& mesh = asset.scene.meshes[m];
    const std::string where = fmt::format("mesh {} '{}'", m, mesh.name);
    if (mesh.material < 0 || std::size_t(mesh.material) >= asset.scene.materials.size())
      return report::badInput(fmt::format("{}: there is no material {}", where, mesh.material));
    if (Status s = checkMesh(where, mesh, asset.transfer.meshes[m]); !s) return s;
    triangles += mesh.triangles.size();
  }
  if (triangles == 0) return report::badInput("the asset has no triangles: nothing to see");
  return checkBiScale(asset, options.biScale);
}

void finishPicture(image::Image& image, const light::Environment& environment,
                   const scene::Camera& camera, const PictureOptions& options) {
  for (Rgb& pixel : image.pixels) pixel = pixel.max(0.0f);
  if (!options.background) return;
  const std::vector<Vec2> positions = scene::subpixelPositions(options.samples);
  tbb::parallel_for(0, image.height, [&](int y) {
    for (int x = 0; x < image.width; ++x) {
      const std::size_t at = std::size_t(y) * image.width + x;
      const float uncovered = 1.0f - image.alpha[at];
      if (!(uncovered > 0.0f)) continue;
      Rgb sum = Rgb::Zero();
      for (const Vec2& p : positions)
        sum += environment.radiance(
            scene::cameraRay(camera, image.width, image.height, x + p.x(), y + p.y()).direction);
      image.pixels[at] += uncovered / float(positions.size()) * sum;
    }
  });
  image.alpha.clear();
}

}  // namespace lambent::shade
