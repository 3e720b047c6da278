// Frames of the live renderer, for every kind of asset: with light and viewer that move, with a
// light that stands still, and of the same mesh unlit; and what a new light costs by itself.
//
// usage: lambent_live_bench [RESULT.csv [INPUTS [--quick]]]
//   RESULT.csv  figures: name, value, unit, wanted, and the OpenGL that they were measured with
//   INPUTS      folder with dragon/dragon_vrip_res2.ply (tools/fetch-inputs.sh)
//   --quick     small meshes and few frames: whether it works
//
// 512×512 pixels, one sample each. Times are stated as ratios to the unlit mesh, measured in turn
// with it, because they depend on the machine; rates in Hz stand beside those of Table 1 in
// sloan2002precomputed, for assets of the same sizes (--quick: a twentieth). Assets are baked with
// few directions: speed does not depend on the numbers.
#include <optional>

#include <epoxy/gl.h>
#include <Eigen/Geometry>

#include "bench/figures_file.h"
#include "lambent/asset/check.h"
#include "lambent/bi_scale/spread_patch.h"
#include "lambent/meso/build_rtt.h"
#include "lambent/meso/generators.h"
#include "lambent/render/gl_context.h"
#include "lambent/render/gl_scene.h"
#include "lambent/render/live_renderer.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene_io/load.h"
#include "lambent/sh/rotation.h"
#include "lambent/trace/ray_scene.h"
#include "lambent/transfer/encode.h"

namespace {

using namespace lambent;
using namespace lambent::bench;

bool quick = false;

const light::Environment& environment() {
  static const light::Environment made =
      light::Environment::uniform(Rgb::Constant(0.3f)) +
      light::Environment::disc(Vec3(0.5f, 0.7f, 0.4f).normalized(), 0.6, Rgb::Constant(8.0f));
  return made;
}

asset::Asset bake(scene::Scene scene, const transport::Placement& placement = {}) {
  macro::BakeOptions options;
  options.kind = transfer::Kind::Shadowed;
  options.directions = 64;
  const trace::RayScene rays = valueOf(trace::RayScene::build(scene));
  const auto receivers = valueOf(transport::placeReceivers(scene, placement, rays.offset()));
  asset::Asset asset;
  asset.transfer = transfer::encode(valueOf(macro::bake(scene, rays, receivers, options, {})).value,
                                    transfer::Encoding::Float16);
  asset.scene = std::move(scene);
  return asset;
}

scene::Material coloured() {
  scene::Material material;
  material.diffuse = Rgb(0.8f, 0.5f, 0.3f);
  return material;
}

scene::Material glossy() {
  scene::Material material;
  material.diffuse = Rgb::Zero();
  material.glossy = Rgb::Constant(0.7f);
  return material;
}

/// A sphere with bumps of about so many vertices.
scene::Mesh bumpySphere(int vertices) {
  const int stacks = int(std::sqrt(vertices / 2.0));
  scene::Mesh mesh = scene::uvSphere(0.5f, 2 * stacks, stacks);
  for (Vec3& p : mesh.positions)
    p *= 1.0f + 0.12f * std::sin(9 * p.x()) * std::sin(8 * p.y()) * std::sin(7 * p.z() + 1);
  scene::computeNormals(mesh);
  return mesh;
}

/// A live renderer and what moves before it.
class Stage {
 public:
  Stage(const asset::Asset& asset, const shade::Showing& options)
      : renderer_(valueOf(render::LiveRenderer::make(asset, options))),
        light_(environment().project(asset.transfer.bands)) {
    expectOk(renderer_.resize(kSide, kSide));
    expectOk(renderer_.setEnvironment(environment()));
    renderer_.setLight(light_);
    view_.camera = scene::frameAutomatically(asset.scene, 1.0f);
    view_.background = false;
    GLuint name = 0;
    glCreateFramebuffers(1, &name);
    window_ = render::Framebuffer(name);
    glNamedFramebufferTexture(name, GL_COLOR_ATTACHMENT0, color_.name(), 0);
  }

  /// Seconds of a frame: moved, drawn, shown, and finished.
  void frame(bool moveLight, bool unlit) {
    ++step_;
    const Mat3 turn = Eigen::AngleAxisf(0.02f * float(step_), Vec3::UnitY()).toRotationMatrix();
    if (moveLight) renderer_.setLight(sh::rotate(turn, light_));
    view_.worldFromAsset.topLeftCorner<3, 3>() = turn;
    view_.unlit = unlit;
    renderer_.begin();
    expectOk(renderer_.add(view_));
    expectOk(renderer_.show(window_.name(), 0.0f, tone::Curve::Filmic));
    glFinish();
  }

 private:
  static constexpr int kSide = 512;
  render::LiveRenderer renderer_;
  sh::RgbCoefficients light_;
  render::LiveView view_;
  render::Texture color_ = render::makeTexture(GL_RGBA8, kSide, kSide);
  render::Framebuffer window_;
  int step_ = 0;
};

struct FrameTimes {
  double moving = 0, still = 0, unlit = 0;  ///< seconds
};

FrameTimes measure(const asset::Asset& asset, const shade::Showing& options = {}) {
  Stage stage(asset, options);
  const int frames = quick ? 2 : 20;
  const auto repeat = [&](bool moveLight, bool unlit) {
    return [&stage, frames, moveLight, unlit] {
      for (int i = 0; i < frames; ++i) stage.frame(moveLight, unlit);
    };
  };
  const std::vector<std::function<void()>> jobs = {repeat(true, false), repeat(false, false),
                                                   repeat(false, true)};
  bestOf(1, jobs);  // drivers compile with the first draws
  const std::vector<double> best = bestOf(quick ? 1 : 5, jobs);
  return {best[0] / frames, best[1] / frames, best[2] / frames};
}

void compare(const std::string& name, const asset::Asset& asset,
             const shade::Showing& options = {}) {
  const FrameTimes times = measure(asset, options);
  note(name + ": unlit", 1e3 * times.unlit, "ms");
  note(name + ": light stands still / unlit", times.still / times.unlit, "");
  note(name + ": light moves / unlit", times.moving / times.unlit, "");
}

void benchKinds() {
  const int vertices = quick ? 2'000 : 10'000;
  asset::Asset grey = bake(scene::sceneOf(bumpySphere(vertices)));
  compare("diffuse, vertices, 1 channel", grey);
  compare("diffuse, vertices, 3 channels", bake(scene::sceneOf(bumpySphere(vertices), coloured())));
  compare("glossy, vertices, 5 bands", bake(scene::sceneOf(bumpySphere(vertices), glossy())));
  {
    const int side = quick ? 32 : 128;
    const transport::Placement placement{{{0, side, side}}, {}};
    scene::Mesh floor = scene::gridPlane(2, 2, 40, 40);
    compare("diffuse, texels", bake(scene::sceneOf(floor, coloured()), placement));
    compare("glossy, texels, 5 bands", bake(scene::sceneOf(floor, glossy()), placement));
  }
  {
    scene::Scene caustic =
        scene::sceneOf(scene::gridPlane(3, 3, quick ? 20 : 100, quick ? 20 : 100));
    scene::Material mirror;
    mirror.mirror = Rgb::Constant(0.9f);
    scene::addTo(caustic, scene::ring(0.45f, 0.5f, 0.4f, 96, 8), mirror);
    compare("mirror and caustic", bake(caustic));
  }
  {
    // What the mirror shows is drawn anew with every light, and not with the view.
    scene::Scene scene = scene::sceneOf(bumpySphere(vertices), coloured());
    scene::addTo(scene, scene::room(Vec3(4, 3, 4), quick ? 4 : 16), coloured());
    scene::Material mirror;
    mirror.mirror = Rgb::Constant(0.9f);
    scene::addTo(scene, scene::translated(scene::uvSphere(0.6f, 48, 24), Vec3(1.2f, 0, 0.3f)),
                 mirror);
    compare("mirror in a scene", bake(std::move(scene)));
  }
  meso::RttOptions rttOptions;
  rttOptions.width = rttOptions.height = quick ? 8 : 64;
  rttOptions.directions = 32;
  rttOptions.bounces = 0;
  rttOptions.supersample = 1;
  const transfer::EncodedRtt rtt = transfer::encode(
      valueOf(meso::buildRtt(meso::weave(), rttOptions, {})).value, transfer::Encoding::Snorm8);
  bi_scale::SpreadOptions spread;
  spread.placement = bi_scale::Placement::OwnUvs;
  spread.transfer.directions = 64;
  spread.transfer.bounces = 1;
  const asset::Asset patched =
      valueOf(bi_scale::spreadPatch(scene::sceneOf(bumpySphere(vertices)), rtt, spread))
          .value.asset;
  shade::Showing options;
  compare("bi-scale, filtered", patched, options);
  options.filter = false;
  compare("bi-scale, nearest position", patched, options);
  options.mesoStructure = transfer::Kind::Unshadowed;
  compare("bi-scale, nearest position, macro off", patched, options);
}

/// M L alone: one dispatch for each chunk of transfer.
void benchRelight(const std::string& name, const asset::Asset& asset) {
  const render::GlLimits limits = render::limitsOfGl();
  render::GlSceneOptions options;
  options.largestBlock = std::min(limits.largestStorageBlock, std::size_t(128) << 20);
  options.largestTexture = limits.largestTexture;
  render::GlScene scene = valueOf(render::GlScene::make(asset, options));
  const sh::RgbCoefficients light = environment().project(asset.transfer.bands);
  const int passes = quick ? 1 : 5;
  double bytes = 0;
  const asset::PartBytes parts = asset::bytesOf(asset);
  bytes += double(parts.vectors + parts.matrices);
  const double best = bestOf(quick ? 2 : 6, {[&] {
                               for (int i = 0; i < passes; ++i) {
                                 scene.setLight(light);
                                 expectOk(scene.relight());
                                 glFinish();
                               }
                             }})[0] /
                      passes;
  note(name + ": relighting alone", 1e3 * best, "ms");
  note(name + ": relighting alone, transfer read", bytes / best * 1e-9, "GB/s");
}

/// A row of Table 1: rates on a 2.2 GHz Pentium 4 with a Radeon 8500.
struct TableRow {
  const char* name;
  int vertices;
  bool glossy;
  double moving, still, fixedView;  ///< Hz: light and view move; only the view; only the light
};

void benchRow(const TableRow& row, const asset::Asset& asset) {
  const FrameTimes times = measure(asset);
  const std::string name = std::string("as ") + row.name;
  std::size_t receivers = 0;
  for (const transfer::EncodedMesh& mesh : asset.transfer.meshes)
    if (const transfer::Receivers* held = transfer::receiversOf(mesh)) receivers += held->size();
  note(name + ": receivers", double(receivers), "");
  note(name + ": light and view move", 1 / times.moving, "Hz");
  note(name + ": light and view move, Table 1", row.moving, "Hz");
  note(name + ": light stands still", 1 / times.still, "Hz");
  note(name + ": light stands still, Table 1", row.still, "Hz");
  // Nothing is kept of a view here, so a fixed one costs what a moving one does.
  note(name + ": view stands still, Table 1", row.fixedView, "Hz");
  note(name + ": light moves / unlit", times.moving / times.unlit, "");
  if (row.glossy) benchRelight(name, asset);
}

void benchTable1(const std::filesystem::path& inputs) {
  const TableRow rows[] = {{"head (diffuse)", 50'000, false, 129, 129, 129},
                           {"tyra_d (diffuse)", 100'000, false, 83, 83, 83},
                           {"buddha_g (glossy)", 50'000, true, 3.6, 16, 125},
                           {"tyra_g (glossy)", 100'000, true, 2.2, 9.4, 83},
                           {"teapot (glossy)", 150'000, true, 1.7, 7.7, 49}};
  for (const TableRow& row : rows) {
    scene::Mesh mesh = bumpySphere(quick ? row.vertices / 20 : row.vertices);
    if (row.vertices == 100'000 && row.glossy && !quick) {
      auto dragon = scene_io::load(inputs / "dragon" / "dragon_vrip_res2.ply");
      if (dragon)
        mesh = dragon->scene.meshes[0];
      else
        fmt::print(stderr, "{}\n", dragon.error().message);
    }
    benchRow(row, bake(scene::sceneOf(mesh, row.glossy ? glossy() : coloured())));
  }
  const int side = quick ? 32 : 256;
  scene::Scene ring = scene::sceneOf(scene::gridPlane(3, 3, 20, 20));
  scene::Material mirror;
  mirror.mirror = Rgb::Constant(0.9f);
  scene::addTo(ring, scene::ring(0.45f, 0.5f, 0.4f, 96, 8), mirror);
  benchRow({"ring (texels and a mirror)", 0, false, 94, 94, 94},
           bake(ring, {{{0, side, side}}, {}}));
}

}  // namespace

int main(int argc, char** argv) {
  const std::filesystem::path csv = argc > 1 ? argv[1] : "";
  const std::filesystem::path inputs = argc > 2 ? argv[2] : "build/inputs";
  quick = argc > 3 && std::string_view(argv[3]) == "--quick";
  const render::GlContext context = valueOf(render::GlContext::create());
  const std::string device = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
  fmt::print("{}\n", device);
  benchKinds();
  benchTable1(inputs);
  writeFigures(csv, device);
  return 0;
}
