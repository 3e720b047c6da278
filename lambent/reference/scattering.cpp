// This work is based on:
// - sloan2002precomputed: §4.2, the kernel G(s, R, r), a Phong-like lobe of unit integral.
// - phong1975illumination: the lobe.
#include "lambent/reference/scattering.h"

#include "lambent/math/directions.h"

namespace lambent::reference {

static float luminance(const Rgb& c) {
  return 0.2126f * c[0] + 0.7152f * c[1] + 0.0722f * c[2];
}

Scattering::Scattering(const scene::SurfacePoint& point, const Vec3& toViewer, Horizon horizon)
    : normal_(point.normal),
      reflected_(math::reflectAbout(toViewer, point.normal)),
      diffuse_(point.diffuse),
      glossy_(point.glossy),
      exponent_(point.lobeExponent),
      horizon_(horizon) {
  const float diffuse = luminance(diffuse_), glossy = luminance(glossy_);
  black_ = !(diffuse + glossy > 0);
  if (!black_) diffuseShare_ = diffuse / (diffuse + glossy);
}

Rgb Scattering::value(const Vec3& direction) const {
  const float cosine = normal_.dot(direction);
  if (!(cosine > 0) && horizon_ == Horizon::Blocks) return Rgb::Zero();
  Rgb value = diffuse_ * math::cosineHemispherePdf(cosine);
  if (diffuseShare_ < 1)
    value += glossy_ * math::phongLobePdf(reflected_.dot(direction), exponent_);
  return value;
}

float Scattering::pdf(const Vec3& direction) const {
  float pdf = 0;
  if (diffuseShare_ > 0) pdf += diffuseShare_ * math::cosineHemispherePdf(normal_.dot(direction));
  if (diffuseShare_ < 1)
    pdf += (1 - diffuseShare_) * math::phongLobePdf(reflected_.dot(direction), exponent_);
  return pdf;
}

Vec3 Scattering::draw(const Vec2& u, float chooseLobe) const {
  if (chooseLobe < diffuseShare_)
    return (math::worldFromTangent(normal_) * math::cosineHemisphere(u)).normalized();
  return (math::worldFromTangent(reflected_) * math::phongLobe(u, exponent_)).normalized();
}

}  // namespace lambent::reference
