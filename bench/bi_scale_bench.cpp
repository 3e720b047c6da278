// Bi-scale transfer, stage by stage: a patch's RTT, the texture's synthesis over a surface, its
// atlas and id map, a whole asset, and a frame of it by OpenGL.
//
// usage: lambent_bi_scale_bench [RESULT.csv [INPUTS [--quick]]]
//   RESULT.csv  figures: name, value, unit, wanted
//   INPUTS      folder with bunny.obj (tools/fetch-inputs.sh)
//
// Stages are stated in seconds, because what they are compared with is (sloan2003biscale §6:
// hours); the RTT's rays are counted too, and a frame is stated as a ratio to a frame of the same
// mesh with a plain texture.
#include <map>
#include <optional>

#include "bench/figures_file.h"
#include "lambent/bi_scale/spread_patch.h"
#include "lambent/light/environment.h"
#include "lambent/meso/build_rtt.h"
#include "lambent/meso/effective_albedo.h"
#include "lambent/meso/generators.h"
#include "lambent/render/renderer.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/load.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transfer/encode.h"

namespace {

using namespace lambent;
using namespace lambent::bench;

/// Seconds by stage, from what the stages tell of themselves.
class StageTimes {
 public:
  Progress progress() {
    return [this](const ProgressUpdate& update) {
      const double time = now();
      const std::string stage(update.stage);
      if (stage != current_) {
        current_ = stage;
        began_ = time;
      }
      seconds_[stage] = time - began_;
      return true;
    };
  }
  void report(const std::string& name) const {
    for (const auto& [stage, seconds] : seconds_)
      if (seconds > 0.2) note(name + ": of it " + stage, seconds, "s");
  }

 private:
  std::string current_;
  double began_ = 0.0;
  std::map<std::string, double> seconds_;
};

transfer::SimulatedRtt benchRtt(const meso::Patch& patch, meso::RttMethod method, bool quick) {
  meso::RttOptions options;
  options.method = method;
  if (quick) options.width = options.height = 16;
  const std::string name =
      fmt::format("{} {}x{}x{}x{}, {}", patch.name, options.width, options.height, options.views,
                  options.views, method == meso::RttMethod::Gather ? "gathered" : "by eq. (5)");
  StageTimes times;
  meso::RttCost cost;
  const double start = now();
  auto rtt = valueOf(meso::buildRtt(patch, options, times.progress(), &cost)).value;
  const double seconds = now() - start;
  note(name, seconds, "s", method == meso::RttMethod::Gather ? "<= 120" : "");
  note(name + ": rays", double(cost.viewRays + cost.lightRays) * 1e-6, "million");
  note(name + ": rays a second", double(cost.viewRays + cost.lightRays) / seconds * 1e-6,
       "million/s");
  times.report(name);
  return rtt;
}

/// A sphere with bumps, of about 10,800 vertices as the papers' models have.
scene::Mesh paperSized() {
  scene::Mesh mesh = scene::icosphere(0.5f, 5);
  for (Vec3& p : mesh.positions)
    p *= 1.0f + 0.12f * std::sin(9 * p.x()) * std::sin(8 * p.y()) * std::sin(7 * p.z() + 1);
  scene::computeNormals(mesh);
  mesh.name = "bumpy sphere";
  return mesh;
}

/// The same surface with a checkered base colour and unshadowed diffuse transfer: the least that a
/// relit picture with a texture costs.
asset::Asset plainlyTextured(const scene::Scene& biScale) {
  scene::Scene scene = biScale;
  scene::Texture texture;
  texture.width = texture.height = 1024;
  texture.rgba.resize(4u * 1024 * 1024, 255);
  for (std::size_t i = 0; i < texture.rgba.size(); i += 4)
    texture.rgba[i] = ((i / 4) / 64 + (i / 4 / 1024) / 64) % 2 ? 200 : 90;
  scene.textures = {texture};
  for (scene::Material& material : scene.materials) material.baseColorTexture = 0;
  macro::BakeOptions options;
  options.kind = transfer::Kind::Unshadowed;
  const auto rays = valueOf(trace::RayScene::build(scene));
  const auto receivers = valueOf(transport::placeReceivers(scene, {}, rays.offset()));
  asset::Asset asset;
  asset.transfer = transfer::encode(valueOf(macro::bake(scene, rays, receivers, options, {})).value,
                                    transfer::Encoding::Float16);
  asset.scene = std::move(scene);
  return asset;
}

double frameSeconds(render::Renderer& renderer, const scene::Camera& camera, int frames) {
  const double start = now();
  for (int frame = 0; frame < frames; ++frame)
    if (const Status drawn = renderer.drawFrame(camera); !drawn) {
      fmt::print(stderr, "{}\n", drawn.error().message);
      std::exit(1);
    }
  return (now() - start) / frames;
}

void benchFrames(const asset::Asset& biScale) {
  const light::Environment environment =
      light::Environment::uniform(Rgb::Constant(0.3f)) +
      light::Environment::disc(Vec3(0.5f, 0.7f, 0.4f).normalized(), 0.6, Rgb::Constant(8.0f));
  const sh::RgbCoefficients light = environment.project(biScale.transfer.bands);
  const scene::Camera camera = scene::frameAutomatically(biScale.scene, 1.0f);
  shade::PictureOptions options;
  options.width = options.height = 512;
  options.samples = 1;
  const auto measure = [&](const asset::Asset& asset) {
    render::Renderer renderer = valueOf(render::Renderer::make(asset, light, environment, options));
    frameSeconds(renderer, camera, 2);
    double best = 1e30;
    for (int round = 0; round < 5; ++round)
      best = std::min(best, frameSeconds(renderer, camera, 5));
    return best;
  };
  const asset::Asset plain = plainlyTextured(biScale.scene);
  const double texture = measure(plain);
  note("GL 512x512: plain texture", 1e3 * texture, "ms");
  const auto compare = [&](const std::string& name) {
    const double seconds = measure(biScale);
    note("GL 512x512: " + name, 1e3 * seconds, "ms");
    note("GL 512x512: " + name + " / plain texture", seconds / texture, "");
  };
  compare("bi-scale");
  options.showing.filter = false;
  compare("bi-scale, nearest position");
  options.showing.viewDependent = false;
  compare("bi-scale, nearest position, no view dependence");
}

bi_scale::Spread benchAsset(const std::string& name, const scene::Scene& scene,
                            const transfer::EncodedRtt& rtt, const Rgb& albedo, bool quick) {
  bi_scale::SpreadOptions options;
  options.albedo = albedo;
  options.mesoVertices = quick ? 60000 : 960000;
  options.transfer.directions = quick ? 1024 : 8192;
  StageTimes times;
  const double start = now();
  bi_scale::Spread spread =
      valueOf(bi_scale::spreadPatch(scene, rtt, options, times.progress())).value;
  note(name + ": a finished asset from the mesh and the RTT", now() - start, "s");
  times.report(name);
  const bi_scale::SpreadReport& report = spread.reports.front();
  note(name + ": meso-vertices", report.mesoVertices, "");
  note(name + ": charts", report.charts, "");
  note(name + ": stretch of the atlas, L2", report.stretch, "");
  note(name + ": of the map in use", report.usedArea, "");
  return spread;
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path csv = argc > 1 ? argv[1] : "";
  const std::filesystem::path inputs = argc > 2 ? argv[2] : "build/inputs";
  const bool quick = argc > 3 && std::string_view(argv[3]) == "--quick";

  const double start = now();
  const transfer::SimulatedRtt weave = benchRtt(meso::weave(), meso::RttMethod::Gather, quick);
  const double gathered = now() - start;
  const transfer::EncodedRtt rtt = transfer::encode(weave, transfer::Encoding::Snorm8);
  const Rgb albedo = meso::effectiveAlbedo(weave);

  if (const auto bunny = scene_io::load(inputs / "bunny.obj")) {
    const double began = now();
    benchAsset("bunny, weave", bunny->scene, rtt, albedo, quick);
    note("from bunny and weave to a finished asset", gathered + now() - began, "s", "<= 480");
  } else {
    fmt::print(stderr, "{}\n", bunny.error().message);
  }
  const bi_scale::Spread small =
      benchAsset("10,242 vertices, weave", scene::sceneOf(paperSized()), rtt, albedo, quick);
  benchFrames(small.asset);
  benchRtt(meso::weave(), meso::RttMethod::Images, quick);
  writeFigures(csv);
  return 0;
}
