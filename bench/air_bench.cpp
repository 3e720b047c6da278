// What aerial perspective costs a frame: a landscape before the background of its sky, by OpenGL, with
// and without air.
//
// usage: lambent_air_bench [RESULT.csv [--quick]]
//   RESULT.csv  figures: name, value, unit, wanted, and the OpenGL that they were measured with
//   --quick     a small frame: whether it works
//
// 1280×720 pixels, one sample each: surfaces, and the background where none is, added up as pictures
// and live frames do it. Both kinds of frame are drawn in turn; the best of each counts.
#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "bench/figures_file.h"
#include "lambent/macro/bake.h"
#include "lambent/math/directions.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_scene.h"
#include "lambent/render/gl_target.h"
#include "lambent/scene/shapes.h"
#include "lambent/sky/make_aerial_perspective.h"
#include "lambent/sources/source.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transfer/encode.h"

namespace {

using namespace lambent;
using namespace lambent::bench;

constexpr const char* kSky = "sky:sun-elevation=20,sun-azimuth=60,altitude=200";

/// Hills of 16 km × 16 km.
asset::Asset hills(int quads) {
  scene::Mesh mesh = scene::gridPlane(16'000, 16'000, quads, quads);
  for (Vec3& p : mesh.positions)
    p.y() = 180.0f * std::sin(p.x() / 900) * std::sin(p.z() / 1100 + 1) - 60;
  scene::computeNormals(mesh);
  scene::Scene scene = scene::sceneOf(mesh);
  macro::BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.directions = 64;
  const trace::RayScene rays = valueOf(trace::RayScene::build(scene));
  const auto receivers = valueOf(transport::placeReceivers(scene, {}, rays.offset()));
  asset::Asset asset;
  asset.transfer = transfer::encode(valueOf(macro::bake(scene, rays, receivers, options, {})).value,
                                    transfer::Encoding::Float16);
  asset.scene = std::move(scene);
  return asset;
}

/// From above the hills' middle; `pitch`: rad above the horizon.
scene::Camera lookingOut(double pitch) {
  scene::Camera camera;
  const float c = float(std::cos(pitch)), s = float(std::sin(pitch));
  camera.worldFromCamera << 1, 0, 0, 0, 0, c, -s, 200, 0, s, c, 6000, 0, 0, 0, 1;
  return camera;
}

class Frames {
 public:
  Frames(const asset::Asset& asset, const light::Environment& environment,
         std::optional<shade::Air> air, int width, int height)
      : bounds_(scene::bounds(asset.scene)),
        target_(valueOf(render::GlTarget::make(width, height))) {
    render::GlSceneOptions options;
    options.largestBlock = render::kLargestBlock;
    options.largestTexture = render::limitsOfGl().largestTexture;
    options.air = std::move(air);
    scene_.emplace(valueOf(
        render::GlScene::makeLit(asset, environment.project(asset.transfer.bands), options)));
    expectOk(environment_.set(environment, options.largestTexture));
    expectOk(target_.prepare(around()));
  }
  void draw(const scene::Camera& camera, bool surfaces, int count) {
    const render::GlView view = render::viewThrough(camera, target_.width(), target_.height(),
                                                    bounds_, Vec2(0.5f, 0.5f), 1);
    for (int i = 0; i < count; ++i) {
      target_.beginFrame();
      if (surfaces) scene_->draw(view, environment_);
      target_.addToSum(view, around());
      glFinish();
    }
  }

 private:
  render::GlTarget::Around around() const {
    render::GlTarget::Around around = scene_->around();
    around.background = &environment_;
    return around;
  }

  scene::Box bounds_;
  render::GlTarget target_;
  std::optional<render::GlScene> scene_;
  render::GlEnvironment environment_;
};

/// How long the table takes: from nothing, from what the disk has, and for another Sun.
sky::AirTable setUp(sky::SkyOptions options) {
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       fmt::format("lambent-air-bench-{:x}", long(1e6 * now()));
  options.cache = folder;
  sky::AirMaker maker;
  const auto make = [&](sky::AirMaker& with) {
    const double start = now();
    auto made = valueOf(with.make(options, sky::AerialForm::Table));
    return std::pair(now() - start, std::get<sky::AirTable>(std::move(made.value)));
  };
  const auto [anew, table] = make(maker);
  double kept = 1e9, moved = 1e9;
  for (int i = 0; i < 5; ++i) {
    sky::AirMaker other;
    kept = std::min(kept, make(other).first);
    options.sunElevation += 0.01;
    moved = std::min(moved, make(maker).first);
  }
  std::filesystem::remove_all(folder);
  note("table of the air: from nothing", 1e3 * anew, "ms");
  note("table of the air: of what is on the disk", 1e3 * kept, "ms");
  note("table of the air: for another Sun", 1e3 * moved, "ms");
  note("table of the air: from nothing / of what is on the disk", anew / kept, "");
  return table;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path csv = argc > 1 ? argv[1] : "";
  const bool quick = argc > 2 && std::string_view(argv[2]) == "--quick";
  const render::GlContext context = valueOf(render::GlContext::create());
  const std::string device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  fmt::print("{}\n", device);

  const light::Environment sky = valueOf(sources::parseSource(kSky)).value;
  const sky::ResolvedSky resolved = valueOf(sources::resolvedSky(kSky)).value;
  shade::Air air;
  air.table = std::make_shared<const sky::AirTable>(setUp(resolved.options));
  air.sunFromAsset = resolved.worldFromSun.transpose();

  const asset::Asset asset = hills(quick ? 40 : 160);
  const int width = quick ? 320 : 1280, height = quick ? 180 : 720;
  Frames without(asset, sky, {}, width, height), with(asset, sky, air, width, height);
  const int frames = quick ? 1 : 3;
  for (const auto& [name, pitch] : {std::pair{"half sky", 0.0}, {"ground alone", -0.6}}) {
    const scene::Camera camera = lookingOut(pitch);
    const std::vector<std::function<void()>> jobs = {[&] { without.draw(camera, false, frames); },
                                                     [&] { without.draw(camera, true, frames); },
                                                     [&] { with.draw(camera, true, frames); }};
    bestOf(1, jobs);  // drivers compile with the first draws
    const std::vector<double> best = bestOf(quick ? 1 : 7, jobs);
    const std::string of = name;
    note(of + ": background alone", 1e3 * best[0] / frames, "ms");
    note(of + ": without air", 1e3 * best[1] / frames, "ms");
    note(of + ": with air", 1e3 * best[2] / frames, "ms");
    note(of + ": with air / without", best[2] / best[1], "", "<= 1.5");
    note(of + ": air / background alone", (best[2] - best[1]) / best[0], "", "<= 0.5");
  }
  writeFigures(csv, device);
  return 0;
}
