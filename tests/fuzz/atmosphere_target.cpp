// Atmospheres as JSON.
#include <cmath>
#include <vector>

#include "lambent/media/phase_function.h"
#include "lambent/sky/atmosphere.h"
#include "lambent/sky/medium.h"
#include "tests/fuzz/target.h"

namespace lambent::fuzz {
namespace {

void requireAmounts(const std::vector<double>& values) {
  for (const double value : values)
    require(std::isfinite(value) && value >= 0, "a coefficient is finite and not negative");
}

/// What a simulation takes out of it.
void use(const sky::Atmosphere& atmosphere) {
  std::vector<double> wavelengths;
  for (double nm = 340; nm <= 740; nm += 10) wavelengths.push_back(nm);
  const sky::Medium medium = sky::mediumOf(atmosphere, wavelengths);
  for (const auto& scattering : medium.scattering) requireAmounts(scattering);
  for (const auto& extinction : medium.extinction) requireAmounts(extinction);
  requireAmounts(medium.albedo);
  requireAmounts(medium.solarIrradiance);
  for (const auto& profile : medium.profiles) {
    std::vector<double> densities;
    for (const double share : {0.0, 0.01, 0.1, 0.5, 1.0})
      densities.push_back(profile.at(share * atmosphere.height));
    for (const double altitude : profile.breaks()) densities.push_back(profile.at(altitude));
    densities.push_back(profile.column(atmosphere.height));
    requireAmounts(densities);
  }
  for (const double cosine : {-1.0, 0.0, 1.0})
    requireAmounts({media::evaluate(atmosphere.aerosolPhase, cosine)});
}

}  // namespace

void atmosphere(Bytes bytes) {
  const Result<sky::Atmosphere> read = sky::parseAtmosphere(textOf(bytes), "atmosphere.json");
  if (!read)
    return require(read.error().kind == ErrorKind::BadInput, "a bad atmosphere is BadInput");
  const std::string text = sky::toJson(*read);
  const Result<sky::Atmosphere> again = sky::parseAtmosphere(text, "again.json");
  if (!again) std::fprintf(stderr, "%s\n", again.error().message.c_str());
  require(again && *again == *read, "an atmosphere comes back as it was");
  require(sky::toJson(*again) == text, "equal atmospheres are the same bytes");
  use(*read);
}

}  // namespace lambent::fuzz
