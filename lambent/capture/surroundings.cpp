#include "lambent/capture/surroundings.h"

#include <algorithm>

#include "lambent/scene/shapes.h"

namespace lambent::capture {

MovingScene demoSurroundings(const scene::Box& object) {
  const Vec3 center = object.empty() ? Vec3::Zero() : object.center();
  // Half the diagonal: whatever stays outside of this sphere never touches the object.
  const float reach = object.diagonal() > 0 ? 0.5f * object.diagonal() : 1.0f;
  const float lampRadius = 0.22f * reach;

  struct Lamp {
    const char* name;
    Rgb radiance;
    float distance, height;  // in units of `reach`
    double period, phase;    // seconds, turns
  };
  // A lamp of radius r at distance D lights a surface that faces it with π (r/D)² of its radiance.
  const Lamp lamps[] = {
      {"warm lamp", Rgb(34, 9, 0.8f), 1.5f, 0.3f, 9, 0.0},
      {"cool lamp", Rgb(0.8f, 9, 34), 1.6f, -0.05f, -13, 0.45},
      {"violet lamp", Rgb(16, 0.8f, 22), 1.75f, 0.85f, 21, 0.7},
  };
  MovingScene scene;
  for (const Lamp& lamp : lamps) {
    Body body;
    body.name = lamp.name;
    body.mesh = scene::icosphere(lampRadius, 3);
    body.radiance = lamp.radiance;
    body.motion.place = center + reach * Vec3(lamp.distance, lamp.height, 0);
    body.motion.orbit = {Vec3::UnitY(), center, lamp.period, lamp.phase};
    scene.bodies.push_back(std::move(body));
  }
  Body bar;
  bar.name = "bar";
  bar.mesh = scene::box(reach * Vec3(0.25f, 2.0f, 0.08f));
  bar.radiance = Rgb::Constant(0.02f);
  bar.motion.place = center - Vec3(0, 0, 1.15f * reach);  // behind, as most views have it
  bar.motion.swing = {Vec3(1.4f * reach, 0, 0), 7, 0};
  scene.bodies.push_back(std::move(bar));
  return scene;
}

}  // namespace lambent::capture
