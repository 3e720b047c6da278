#include "apps/viewer/stage.h"

#include <cmath>

#include <Eigen/LU>

#include "lambent/scene/camera.h"
#include "lambent/shade/showing.h"
#include "lambent/tone/tone_curve.h"
#include "lambent/view/placement.h"

namespace lambent::viewer {

namespace {

/// Whether the pictures of two states are made of the same light: they may be developed otherwise.
bool sameRadiance(view::ViewState a, const view::ViewState& b) {
  a.exposure = b.exposure, a.tone = b.tone;
  return a == b;
}

Possibilities possibilitiesOf(const asset::Asset& asset) {
  using transfer::Kind, transfer::Numbers;
  Possibilities result;
  result.unshadowed = shade::offers(asset, Kind::Unshadowed);
  result.shadowed = shade::offers(asset, Kind::Shadowed);
  result.interreflected = shade::offers(asset, Kind::Interreflected);
  for (const transfer::EncodedMesh& mesh : asset.transfer.meshes) {
    if (shade::kindWithoutBounces(mesh, {})) result.sharpSun = true;
    if (std::holds_alternative<transfer::BiScale<Numbers>>(mesh)) result.mesoStructure = true;
    if (const auto* surface = std::get_if<transfer::Surface<Numbers>>(&mesh))
      surface->responses.each([&](Kind, const auto& response) {
        result.glossy = result.glossy || response.glossy.has_value();
      });
  }
  return result;
}

/// What a picture of this state shows as radiance 1.
float brightnessOf(const view::ViewState& state) {
  return std::exp2(-float(state.exposure));
}

render::LiveView liveView(const view::ViewState& state, const scene::Camera& camera, bool unlit) {
  render::LiveView view;
  view.camera = camera;
  view.worldFromAsset = view::worldFromAsset(state);
  view.worldFromEnvironment = view::worldFromEnvironment(state);
  view.background = state.background;
  view.unlit = unlit;
  return view;
}

}  // namespace

Status Stage::show(LoadedAsset loaded, const view::ViewState& state) {
  auto renderer = render::LiveRenderer::make(*loaded.asset, view::showingOf(state));
  if (!renderer) return renderer.error();
  if (surroundings_)
    if (Status s = surroundings_->attach(*renderer, *loaded.asset); !s) return s;
  renderer_.emplace(std::move(*renderer));
  asset_.emplace(std::move(loaded));
  marks_.reset();
  possibilities_ = possibilitiesOf(*asset_->asset);
  box_ = scene::bounds(asset_->asset->scene);
  showing_ = view::showingOf(state);
  backdrop_.reset();
  size_ = {};
  drawn_.reset();
  const int bands = asset_->asset->transfer.bands;
  if (!light_ || light_->bands() != bands) light_.emplace(environment_, bands);
  return Status::ok();
}

void Stage::setEnvironment(const light::Environment& environment) {
  environment_ = environment;
  if (asset_) light_.emplace(environment_, asset_->asset->transfer.bands);
  backdrop_.reset();
  drawn_.reset();
}

void Stage::setAir(std::shared_ptr<const sky::AirTable> table, const Mat3d& environmentFromSun) {
  air_ = std::move(table);
  environmentFromSun_ = environmentFromSun;
  drawn_.reset();
}

Status Stage::setSurroundings(std::unique_ptr<Surroundings> surroundings) {
  if (surroundings && renderer_)
    if (Status s = surroundings->attach(*renderer_, *asset_->asset); !s) return s;
  surroundings_ = std::move(surroundings);
  drawn_.reset();
  return Status::ok();
}

void Stage::elapse(double seconds) {
  if (surroundings_) surroundings_->elapse(seconds);
}

Status Stage::setLightSamples(int count) {
  if (!surroundings_ || count == surroundings_->samples()) return Status::ok();
  surroundings_->setSamples(count);
  drawn_.reset();
  return renderer_ ? surroundings_->attach(*renderer_, *asset_->asset) : Status::ok();
}

scene::Box Stage::bounds(const view::ViewState& state) const {
  return view::movedBox(view::worldFromAsset(state), box_);
}

scene::Camera Stage::camera(const view::ViewState& state, const PixelSize& size) const {
  const float aspect = float(size.width) / float(std::max(size.height, 1));
  return asset_ ? view::worldCamera(state, asset_->asset->scene, aspect)
                : view::worldCamera(state, {}, aspect);
}

/// What mirrors and the background show. Discs are parts of it that do not turn with the rest.
Status Stage::hangBackdrop(const view::ViewState& state) {
  light::Environment backdrop = environment_;
  const Mat3 environmentFromWorld = view::worldFromEnvironment(state).transpose();
  for (const view::Disc& disc : state.discs)
    backdrop = backdrop + view::environmentOf(disc).rotated(environmentFromWorld);
  if (Status s = renderer_->setEnvironment(backdrop); !s) return s;
  backdrop_ = state;
  return Status::ok();
}

Status Stage::letAirIn(const view::ViewState& state, const PixelSize& size) {
  // What an orthographic camera sees has no distance.
  if (!air_ || camera(state, size).orthographicHalfHeight) return renderer_->setAir(std::nullopt);
  return renderer_->setAir(view::assetAir(state, air_, environmentFromSun_));
}

Status Stage::prepare(const view::ViewState& state, const PixelSize& size, bool moving) {
  if (const shade::Showing showing = view::showingOf(state); showing_ != showing) {
    if (Status s = renderer_->choose(showing); !s) return s;
    showing_ = showing;
  }
  if (size != size_) {
    if (Status s = renderer_->resize(size.width, size.height); !s) return s;
    size_ = size;
  }
  if (Status s = letAirIn(state, size); !s) return s;
  const bool stale =
      !backdrop_ || backdrop_->discs != state.discs ||
      (!state.discs.empty() && backdrop_->environmentRotation != state.environmentRotation);
  // The renderer moves so many discs at no cost; more of them are an image to be made, for which
  // it waits until the hand rests.
  const bool cheap = state.discs.size() <= 16;
  if (stale && (cheap || !moving || !backdrop_))
    if (Status s = hangBackdrop(state); !s) return s;
  if (surroundings_) {
    const Result<bool> lit = surroundings_->light(*renderer_, state, light_->world(state));
    return lit ? Status::ok() : Status(lit.error());
  }
  renderer_->setLight(light_->asset(state));
  return renderer_->setSun(light_->sharpSun(state));
}

Status Stage::addSample(const view::ViewState& state, const PixelSize& size, const Vec2& place,
                        int samples) {
  render::LiveView view = liveView(state, camera(state, size), unlit);
  if (surroundings_) view.others = surroundings_->bounds();
  if (overlays.seams) view.seams = brightnessOf(state) * kSeamColor;
  if (Status s = renderer_->add(view, place, samples); !s) return s;
  if (overlays.any() && possibilities_.mesoStructure) {
    if (!marks_) marks_.emplace(*asset_->asset);
    render::MarkView marked{view.camera, renderer_->clipFromWorld() * view.worldFromAsset,
                            brightnessOf(state)};
    marked.camera.worldFromCamera = view.worldFromAsset.inverse() * view.camera.worldFromCamera;
    if (Status s = marks_->draw(overlays, renderer_->framebuffer(), size, marked); !s) return s;
  }
  return surroundings_ ? surroundings_->draw(*renderer_, size) : Status::ok();
}

bool Stage::sameFrame(const view::ViewState& state, const PixelSize& size) const {
  if (!drawn_ || drawn_->size != size || drawn_->unlit != unlit || drawn_->overlays != overlays)
    return false;
  // Overlays have a radiance that the exposure takes back.
  return sameRadiance(drawn_->state, state) &&
         (!overlays.any() || drawn_->state.exposure == state.exposure);
}

Status Stage::draw(const view::ViewState& state, const PixelSize& size) {
  bool moving = !sameFrame(state, size);
  if (surroundings_) {
    const Result<bool> moved = surroundings_->light(*renderer_, state, light_->world(state));
    if (!moved) return moved.error();
    moving = moving || *moved;
  }
  drawn_ = Drawn{state, size, unlit, overlays};
  if (moving) {
    samples_ = 0;
    settled_ = false;
    if (Status s = prepare(state, size, true); !s) return s;
    renderer_->begin();
    return addSample(state, size, Vec2(0.5f, 0.5f), 1);
  }
  if (samples_ >= state.samples) {
    settled_ = true;
    return Status::ok();
  }
  if (samples_ == 0) {
    if (Status s = prepare(state, size, false); !s) return s;
    renderer_->begin();
  }
  const Vec2 place = scene::subpixelPositions(state.samples)[std::size_t(samples_++)];
  settled_ = samples_ >= state.samples;
  return addSample(state, size, place, state.samples);
}

Status Stage::present(unsigned framebuffer, const view::ViewState& state) const {
  return renderer_->show(framebuffer, float(state.exposure), state.tone);
}

Result<image::Image> Stage::picture(const view::ViewState& state, const PixelSize& size) {
  if (Status s = prepare(state, size, false); !s) return s.error();
  renderer_->begin();
  for (const Vec2& place : scene::subpixelPositions(state.samples))
    if (Status s = addSample(state, size, place, state.samples); !s) return s.error();
  auto linear = renderer_->picture();
  drawn_.reset();  // of this size nothing is to be shown
  if (!linear) return linear;
  return tone::toneMap(std::move(*linear), float(state.exposure), state.tone);
}

}  // namespace lambent::viewer
