// The state of a viewer.
#include <array>
#include <cmath>

#include "lambent/view/orbit.h"
#include "lambent/view/placement.h"
#include "lambent/view/state_light.h"
#include "tests/fuzz/target.h"

namespace lambent::fuzz {
namespace {

void use(const view::ViewState& state) {
  scene::Scene scene;
  scene::Mesh mesh;
  mesh.positions = {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0)};
  mesh.normals.assign(3, Vec3::UnitZ());
  mesh.triangles.push_back({0, 1, 2});
  scene.meshes.push_back(std::move(mesh));
  scene.materials.emplace_back();
  const scene::Box box = scene::bounds(scene);

  const scene::Camera camera = view::worldCamera(state, scene, 1.5f);
  (void)view::assetCamera(state, camera);
  (void)view::pictureOptions(state, 3, 2);
  (void)view::movedBox(view::worldFromAsset(state), box);
  (void)scene::clipFromWorld(camera, 3, 2, box);
  if (state.camera) {
    view::LookAt look = view::orbited(*state.camera, 0.1, 0.2);
    look = view::panned(look, Vec2(0.1f, 0.2f));
    look = view::zoomed(look, 0.5, Vec2(0.1f, 0.2f), 1e-3, 1e3);
    (void)view::framed(look, box, 1.5);
  }
  view::StateLight light(light::Environment::uniform(Rgb::Ones()), 3);
  (void)light.asset(state);
  (void)view::assetEnvironment(state, light::Environment::uniform(Rgb::Ones()))
      .radiance(Vec3::UnitX());
}

}  // namespace

void view(Bytes bytes) {
  const Result<view::ViewState> state = view::parseViewState(textOf(bytes), "view.json");
  if (!state) return require(state.error().kind == ErrorKind::BadInput, "a bad state is BadInput");
  const Result<view::ViewState> again = view::parseViewState(view::toJson(*state), "again.json");
  if (!again) std::fprintf(stderr, "%s\n", again.error().message.c_str());
  require(again && *again == *state, "a state comes back as it was");
  use(*state);
}

}  // namespace lambent::fuzz
