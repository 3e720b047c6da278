// 3. Transfer: simulate once how light moves over a scene, then relight it with a dot product.
#include <lambent/asset/asset.h>
#include <lambent/light/environment.h>
#include <lambent/macro/bake.h>
#include <lambent/scene/shapes.h>
#include <lambent/shade/shade.h>
#include <lambent/transfer/encode.h>

#include <cstdio>

using namespace lambent;

int main() {
  // A red ball that stands on a white floor.
  scene::Material white, red;
  white.diffuse = Rgb::Constant(0.8f);
  red.diffuse = Rgb(0.7f, 0.05f, 0.05f);
  scene::Scene scene;
  scene::addTo(scene, scene::gridPlane(6, 6, 40, 40), white);
  scene::addTo(scene, scene::translated(scene::icosphere(1, 4), Vec3(0, 1, 0)), red);

  // Where light can go is geometry: build it once.
  const auto rays = trace::RayScene::build(scene);
  if (!rays) return std::fprintf(stderr, "%s\n", rays.error().message.c_str()), 1;

  // Where transfer is recorded: at every vertex, unless a placement names meshes and texels.
  const auto receivers = transport::placeReceivers(scene, {}, rays->offset());
  if (!receivers) return std::fprintf(stderr, "%s\n", receivers.error().message.c_str()), 1;

  // The bake knows no light yet. It asks, at every receiver: how would you answer to each of the 25
  // basis lights? Its findings tell what was odd about the scene.
  macro::BakeOptions options;
  options.kind = transfer::Kind::Interreflected;
  options.bands = 5;
  options.directions = 2048;
  options.bounces = 2;
  const auto field = macro::bake(scene, *rays, *receivers, options, {});
  if (!field) return std::fprintf(stderr, "%s\n", field.error().message.c_str()), 1;
  for (const Finding& finding : field->findings) std::printf("%s\n", finding.message.c_str());

  // Half floats are enough to look at; Float32 keeps every bit.
  const asset::Asset asset{scene, transfer::encode(field->value, transfer::Encoding::Float16)};

  // Now relight. Each light costs 25 multiplications per vertex and channel, and no ray.
  Rgb underTheBall = Rgb::Zero(), inTheOpen = Rgb::Zero();
  for (const double elevation : {80.0, 30.0}) {
    const double a = elevation * kPi / 180.0;
    const Vec3 direction(float(std::cos(a)), float(std::sin(a)), 0);
    const auto sun = light::Environment::disc(direction, 0.5, Rgb::Constant(10));
    const std::vector<Rgb> floor = shade::exitRadiance(asset, 0, sun.project(5));
    underTheBall = floor[floor.size() / 2];  // the middle of the 41 × 41 vertices
    inTheOpen = floor[0];                    // a corner
    std::printf("sun at %2.0f degrees: floor in the open %.3f, under the ball %.3f\n", elevation,
                inTheOpen[1], underTheBall[1]);
  }

  // Under an even sky the floor beside the ball is tinted by it: colour bleeds.
  const auto sky = light::Environment::uniform(Rgb::Constant(1)).project(5);
  const std::vector<Rgb> floor = shade::exitRadiance(asset, 0, sky);
  const Rgb beside = floor[20 * 41 + 24];
  std::printf("even sky, floor beside the ball: %.3f %.3f %.3f\n", beside[0], beside[1], beside[2]);
  return underTheBall[1] < inTheOpen[1] && beside[0] > beside[1] ? 0 : 1;
}
