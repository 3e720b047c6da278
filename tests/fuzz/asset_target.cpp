// Assets: glTF with LAMBENT_radiance_transfer, as .glb or as .gltf.
#include "lambent/asset/check.h"
#include "lambent/asset/read.h"
#include "lambent/asset/summary.h"
#include "lambent/scene/camera.h"
#include "lambent/shade/shade.h"
#include "lambent/transfer/encode.h"
#include "tests/fuzz/folder.h"
#include "tests/fuzz/scene_use.h"

namespace lambent::fuzz {
namespace {

sh::RgbCoefficients someLight() {
  sh::RgbCoefficients light(3);
  for (std::size_t i = 0; i < light.values.size(); ++i) light.values[i] = 1.0f / float(1 + i);
  return light;
}

/// What a picture, `info` and a second bake take out of it.
void use(const asset::Asset& asset) {
  (void)asset::summarize(asset);
  (void)transfer::decode(asset.transfer);
  shade::ReceiverView view;
  view.eye = Vec3(0.5f, 2.0f, 1.0f);
  for (std::uint32_t i = 0; i < asset.scene.meshes.size(); ++i) {
    const auto* receivers = transfer::receiversOf(asset.transfer.meshes[i]);
    if (receivers == nullptr || receivers->size() > kMostElements) continue;
    const std::vector<Rgb> radiance = shade::exitRadiance(asset, i, someLight(), view);
    require(radiance.size() == receivers->size(), "every receiver has its radiance");
    view.showing.viewDependent = !view.showing.viewDependent;
  }
}

}  // namespace

void asset(Bytes bytes) {
  const bool binary = textOf(bytes).starts_with("glTF");
  const Folder& folder = Folder::ofProcess();
  const auto path = folder.write(binary ? "asset.glb" : "asset.gltf", bytes);
  const Result<bool> isAsset = asset::isAsset(path);
  asset::ReadOptions options;
  options.memoryLimit = kMemoryLimit;
  const Result<asset::Asset> asset = asset::read(path, options);
  if (!asset) return require(asset.error().kind == ErrorKind::BadInput, "a bad file is BadInput");
  require(isAsset && *isAsset, "what is read as an asset is one");
  const auto fault = asset::faultOf(*asset);
  if (fault) std::fprintf(stderr, "%s\n", fault->c_str());
  require(!fault, "an asset that was read has no fault");
  use(*asset);

  const auto copy = folder / "again.glb";
  const Status written = asset::write(*asset, copy);
  if (!written) std::fprintf(stderr, "%s\n", written.error().message.c_str());
  require(bool(written), "an asset that was read can be written");
  const Result<asset::Asset> again = asset::read(copy);
  if (!again) std::fprintf(stderr, "%s\n", again.error().message.c_str());
  require(bool(again), "an asset that was written can be read");
  const asset::PartBytes before = asset::bytesOf(*asset), after = asset::bytesOf(*again);
  require(before.total() == after.total(), "every part of an asset comes back");
}

}  // namespace lambent::fuzz
