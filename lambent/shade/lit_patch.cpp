// This work is based on:
// - sloan2003biscale: bi-scale radiance transfer, eq. 4 as §5 evaluates it: M_p L at the receivers,
//   linear between them; the spatial index q from the id map; B(q, v) · (M_p L) per sub-sample.
//
// Beyond it: B is averaged over what the sub-sample covers of the patch (rtt_footprint.h). Across
// the view that is the sub-sample's width; towards the viewer it is as much longer as the surface
// is seen from the side, 1/cos θ.

#include "lambent/shade/lit_patch.h"

#include <algorithm>
#include <array>

#include "lambent/shade/macro_transport.h"
#include "lambent/shade/rtt_lookup.h"
#include "lambent/transfer/encode.h"

namespace lambent::shade {

std::shared_ptr<const RttPyramid> RttPyramids::of(int rtt) {
  std::shared_ptr<const RttPyramid>& pyramid = made_[rtt];
  if (!pyramid)
    pyramid = std::make_shared<const RttPyramid>(
        makePyramid(transfer::decode(field_.rtts[std::size_t(rtt)]), filter_ ? 32 : 1));
  return pyramid;
}

std::vector<float> inRttLayout(const std::vector<float>& light, int bands) {
  const std::size_t count = std::size_t(sh::coefficientCount(bands));
  const std::size_t stride = std::size_t(rttStride(bands)), receivers = light.size() / (3 * count);
  std::vector<float> out(receivers * stride);
  for (std::size_t p = 0; p < receivers; ++p)
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i)
        out[p * stride + 3 * i + c] = light[(p * 3 + c) * count + i];
  return out;
}

LitPatch::LitPatch(const asset::Asset& asset, std::uint32_t mesh,
                   std::shared_ptr<const RttPyramid> pyramid, const sh::RgbCoefficients& light,
                   const Showing& showing)
    : mesh_(asset.scene.meshes[mesh]),
      biScale_(std::get<transfer::BiScale<transfer::Numbers>>(asset.transfer.meshes[mesh])),
      rttSize_(asset.transfer.rtts[std::size_t(biScale_.patch.rtt)].size),
      pyramid_(std::move(pyramid)),
      viewDependent_(showing.viewDependent),
      filter_(showing.filter),
      light_(inRttLayout(incidentLight(biScale_, light, pyramid_->bands,
                                       kindShown(asset.transfer.meshes[mesh], showing)),
                         pyramid_->bands)) {
  if (!filter_ || biScale_.patch.idMap()) return;
  for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t)
    gradients_.push_back(patchGradient(biScale_.patch, mesh_, t));
}

Rgb LitPatch::at(std::uint32_t triangle, float u, float v, const scene::SurfacePoint& point,
                 const Vec3& toViewer, float width) const {
  const auto [i, j, k] = mesh_.triangles[triangle];
  const float w = 1.0f - u - v;
  const Mat3 frame = worldFromPatch(
      point.normal, w * biScale_.tangents[i] + u * biScale_.tangents[j] + v * biScale_.tangents[k]);
  const Vec3 seen = frame.transpose() * toViewer;
  const RttViews views = viewsAround(pyramid_->views, viewDependent_ ? seen : Vec3(Vec3::UnitZ()),
                                     filter_ ? pyramid_->relief : Vec2(Vec2::Zero()));

  RttProbes probes;
  PatchPlaces places;
  if (filter_) {
    const PatchGradient gradient = biScale_.patch.idMap()
                                       ? patchGradient(biScale_.patch, rttSize_, frame)
                                       : gradients_[triangle];
    const FootprintAxes axes = footprintAxes(frame, seen, width);
    const RttLevel& level = pyramid_->levels[0];
    probes = probesOf(Vec2(gradient.x.dot(axes.longer), gradient.y.dot(axes.longer)),
                      Vec2(gradient.x.dot(axes.shorter), gradient.y.dot(axes.shorter)),
                      Vec2(float(level.width), float(level.height)));
    places = patchPlaces(
        biScale_.patch, point.uv,
        biScale_.patch.idMap() ? scene::uvSteps(mesh_, triangle) : scene::UvSteps{}, gradient);
  } else {
    places.add(patchPlace(biScale_.patch, point.uv), 1.0f);
  }

  const std::size_t stride = std::size_t(pyramid_->stride());
  std::array<float, rttStride(sh::kMaxBands)> light;
  const float *a = light_.data() + i * stride, *b = light_.data() + j * stride,
              *c = light_.data() + k * stride;
  for (std::size_t n = 0; n < stride; ++n) light[n] = w * a[n] + u * b[n] + v * c[n];
  Rgb sum = Rgb::Zero();
  for (int p = 0; p < places.count; ++p)
    sum += places.share[p] * respond(*pyramid_, places.q[p], probes, views, light.data());
  return sum;
}

Rgb LitPatch::atReceiver(std::uint32_t receiver, const Vec3& toViewer) const {
  const Vec3 normal = biScale_.receivers->normals[receiver].normalized();
  const Vec3 seen = worldFromPatch(normal, biScale_.tangents[receiver]).transpose() * toViewer;
  const RttViews views = viewsAround(pyramid_->views, viewDependent_ ? seen : Vec3(Vec3::UnitZ()));
  const Vec2 uv = mesh_.uvs.empty() ? Vec2(Vec2::Zero()) : mesh_.uvs[receiver];
  return respond(*pyramid_, patchPlace(biScale_.patch, uv), {}, views,
                 light_.data() + std::size_t(receiver) * pyramid_->stride());
}

}  // namespace lambent::shade
