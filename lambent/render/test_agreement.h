// The GL picture against the CPU's, for the tests of render.
#pragma once

#include <string>
#include <vector>

#include "lambent/asset/asset.h"
#include "lambent/image/image.h"
#include "lambent/light/environment.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/picture_options.h"
#include "lambent/shade/test_assets.h"

namespace lambent::render::test {

inline const scene::Camera kCamera = shade::test::cameraAt(Vec3(1.5f, 1.8f, 5.0f), Vec3::Zero());

/// 128 × 96 pixels.
inline shade::PictureOptions small(int samples) {
  shade::PictureOptions options;
  options.width = 128;
  options.height = 96;
  options.samples = samples;
  return options;
}

/// How far the pictures may be apart, in 1/255 after the tone curve.
struct Agreement {
  std::size_t largestBlock = std::size_t(1) << 40;  ///< bytes of storage buffers
  double mean = 0.05;
  double interior = 0.05;  ///< the 99th percentile of what lies wholly on surfaces
  /// Pixels that show mirrors, if any: what these show of the asset is captured, and is not as
  /// exact.
  std::vector<bool> mirrors = {};
  double inMirrors = 4;  ///< the mean there; both others are of what remains
};

/// Pixels of `picture(asset)` that show mirrors.
template <class Picture>
std::vector<bool> mirrorsIn(const asset::Asset& asset, Picture picture) {
  asset::Asset changed = asset;
  std::vector<image::Image> pictures;
  for (const float reflectance : {0.5f, 0.25f}) {
    for (scene::Material& material : changed.scene.materials)
      if (material.isMirror()) material.mirror = Rgb::Constant(reflectance);
    Result<image::Image> made = picture(changed);
    if (!made) return {};
    pictures.push_back(std::move(*made));
  }
  std::vector<bool> result;
  for (std::size_t i = 0; i < pictures[0].pixels.size(); ++i)
    result.push_back((pictures[0].pixels[i] != pictures[1].pixels[i]).any());
  return result;
}
/// The same of relitPicture's under test::sky().
std::vector<bool> mirrorsIn(const asset::Asset& asset, const scene::Camera& camera,
                            const shade::PictureOptions& options);

/// Makes both pictures under test::sky() and expects them to agree, in coverage too, and not to be
/// black; mirrors are found out. LAMBENT_TEST_PICTURES=DIR in the environment: where to leave them
/// to look at.
void expectAgreement(const std::string& name, const asset::Asset& asset,
                     const scene::Camera& camera, const shade::PictureOptions& options,
                     const Agreement& agreement = {});

/// The same of two pictures that were made already.
void expectSame(const std::string& name, const image::Image& cpu, const image::Image& gl,
                const Agreement& agreement = {});

}  // namespace lambent::render::test
