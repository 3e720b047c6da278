// The sum of components, and its sampling: a component by its power, a direction by the component,
// and then the density of the whole mixture (the balance heuristic over all components).
//
// This work is based on:
// - veach1997robust: §9.2.2, one-sample multiple importance sampling.
#include "lambent/light/environment.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include "lambent/light/built_in.h"

namespace lambent::light {

struct Environment::Impl {
  std::vector<ComponentPtr> components;
  std::vector<double> probability;  ///< of each component to be drawn

  explicit Impl(std::vector<ComponentPtr> parts) : components(std::move(parts)) {
    double total = 0;
    for (const ComponentPtr& part : components) total += part->power();
    for (const ComponentPtr& part : components)
      probability.push_back(total > 0 ? part->power() / total
                                      : 1.0 / static_cast<double>(components.size()));
  }
};

Environment::Environment() : Environment(uniform(Rgb::Zero())) {}
Environment::Environment(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}

Environment Environment::of(ComponentPtr component) {
  assert(component);
  return Environment(std::make_shared<Impl>(std::vector<ComponentPtr>{std::move(component)}));
}
Environment Environment::uniform(const Rgb& radiance) {
  return of(makeUniform(radiance));
}
Environment Environment::disc(const Vec3& direction, double angularDiameter, const Rgb& radiance) {
  const double sine = std::sin(std::max(angularDiameter, 0.0) / 4);
  return of(makeDisc({direction.cast<double>(), 2 * sine * sine, radiance}));
}
Environment Environment::disc(const LimbDarkened& disc) {
  return of(makeLimbDarkened(disc));
}
Environment Environment::skylight(std::shared_ptr<const Skylight> light, const Mat3& worldFromSky) {
  assert(light);
  return of(makeSkylight(std::move(light), worldFromSky));
}
Environment Environment::ground(const Vec3& up, double horizon, const Rgb& radiance) {
  return of(makeGround(up.cast<double>(), std::sin(horizon), radiance));
}
Environment Environment::disc(const Disc& disc) {
  return of(makeDisc({disc.axis.cast<double>(), disc.versine, disc.radiance, disc.darkening,
                      disc.up.cast<double>(), disc.horizon}));
}
Environment Environment::directional(const Vec3& direction, const Rgb& irradiance) {
  return of(makeDirectional(direction.cast<double>(), irradiance));
}
Environment Environment::clampedCosine(const Vec3& axis, const Rgb& radiance) {
  return of(makeClampedCosine(axis.cast<double>(), radiance));
}
Environment Environment::harmonics(sh::RgbCoefficients coefficients) {
  return of(makeHarmonics(std::move(coefficients)));
}
Environment Environment::latLong(image::Image image) {
  return image.pixels.empty() ? Environment() : of(makeLatLong(std::move(image)));
}

Environment Environment::rotated(const Mat3& dstFromSrc) const {
  std::vector<ComponentPtr> parts;
  for (const ComponentPtr& part : impl_->components) parts.push_back(part->rotated(dstFromSrc));
  return Environment(std::make_shared<Impl>(std::move(parts)));
}

Environment operator+(const Environment& a, const Environment& b) {
  std::vector<ComponentPtr> parts = a.impl_->components;
  parts.insert(parts.end(), b.impl_->components.begin(), b.impl_->components.end());
  return Environment(std::make_shared<Environment::Impl>(std::move(parts)));
}

Rgb Environment::radiance(const Vec3& direction) const {
  Rgb sum = Rgb::Zero();
  for (const ComponentPtr& part : impl_->components) sum += part->radiance(direction);
  return sum;
}

sh::RgbCoefficients Environment::project(int bands) const {
  assert(bands >= 1 && bands <= sh::kMaxBands);
  sh::RgbCoefficients out(bands);
  std::vector<double> sum(out.values.size());
  for (const ComponentPtr& part : impl_->components) part->addProjection(bands, sum);
  for (std::size_t i = 0; i < sum.size(); ++i) out.values[i] = float(sum[i]);
  return out;
}

Environment::Sample Environment::sample(float u1, float u2) const {
  const auto& parts = impl_->components;
  const auto& probability = impl_->probability;
  // The first number chooses the component; what is left of it is uniform again.
  std::size_t chosen = 0;
  double u = u1;
  for (; chosen + 1 < parts.size() && u >= probability[chosen]; ++chosen) u -= probability[chosen];
  while (probability[chosen] <= 0 && chosen > 0) --chosen;  // u1 at the edge of a dark last part
  const double rest = std::clamp(u / probability[chosen], 0.0, 1 - 0x1p-53);

  const Component::Drawn drawn = parts[chosen]->draw(rest, u2);
  if (std::isinf(drawn.pdf))
    return {drawn.direction, drawn.radiance / float(probability[chosen]),
            std::numeric_limits<float>::infinity()};
  Rgb total = drawn.radiance;
  double density = probability[chosen] * drawn.pdf;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k == chosen) continue;
    total += parts[k]->radiance(drawn.direction);
    if (probability[k] > 0) density += probability[k] * parts[k]->pdf(drawn.direction);
  }
  if (!(density > 0)) return {drawn.direction, Rgb::Zero(), 0.0f};
  return {drawn.direction, total * float(1 / density), float(density)};
}

float Environment::pdf(const Vec3& direction) const {
  double density = 0;
  for (std::size_t k = 0; k < impl_->components.size(); ++k)
    if (impl_->probability[k] > 0)
      density += impl_->probability[k] * impl_->components[k]->pdf(direction);
  return float(density);
}

Environment::Parts Environment::parts() const {
  Parts parts;
  for (const ComponentPtr& part : impl_->components)
    if (!part->addTo(parts)) parts.others.push_back(of(part));
  return parts;
}

}  // namespace lambent::light
