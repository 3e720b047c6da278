// This work is based on:
// - penndorf1957tables; preetham2003modeling, "Rayleigh scattering" (its depolarisation, .0035, is
//   ten times too small; its coefficients in the text are not what its formula gives) and "Mie
//   scattering" (Junge's law, whose lengths we take for centimetres: in metres its concentrations
//   would make a clear sky of thickness 9); angstrom1929atmospheric.
#include "lambent/sky/medium.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/types.h"
#include "lambent/radiometry/spectra.h"

namespace lambent::sky {
namespace {

/// preetham2003modeling: 8π³(n² − 1)²/(3Nλ⁴) · (6 + 3p)/(6 − 7p).
double rayleighFormula(double nm, double refractiveIndex, double molecules, double depolarisation) {
  const double lambda = nm * 1e-9, square = refractiveIndex * refractiveIndex - 1;
  return 8 * kPi * kPi * kPi * square * square / (3 * molecules * std::pow(lambda, 4)) *
         (6 + 3 * depolarisation) / (6 - 7 * depolarisation);
}

/// edlen1953dispersion, eq. 1: air at 15 °C and 1013.25 hPa; vacuum wavelengths.
double refractiveIndexOfAir(double nm) {
  const double k2 = 1e6 / (nm * nm);
  return 1 + 1e-8 * (6432.8 + 2949810 / (146 - k2) + 25540 / (41 - k2));
}

double rayleighCoefficient(Atmosphere::Rayleigh law, double nm) {
  switch (law) {
    case Atmosphere::Rayleigh::Penndorf:
      return radiometry::penndorf15C(nm);
    case Atmosphere::Rayleigh::Formula:
      return rayleighFormula(nm, refractiveIndexOfAir(nm), 2.54743e25, 0.035);
    case Atmosphere::Rayleigh::Seed:
      return rayleighFormula(nm, 1.0003, 2.545e25, 0.0035);
  }
  return 0;
}

struct AerosolExtinction {
  double nm;
  double column;  ///< ∫ density dh, m
  double operator()(const Atmosphere::Angstrom& law) const {
    return law.thicknessAt1um * std::pow(nm / 1000, -law.exponent) / column;
  }
  double operator()(const Atmosphere::Junge& law) const {
    // .434 c π (2π/λ)^(v−2) K, in 1/cm with λ in cm; K from .656 at 400 nm to .69 at 770 nm.
    const double k = 0.656 + (0.69 - 0.656) * std::clamp((nm - 400) / 370, 0.0, 1.0);
    return 100 * 0.434 * law.concentration * kPi *
           std::pow(2 * kPi / (nm * 1e-7), law.exponent - 2) * k;
  }
};

}  // namespace

Medium mediumOf(const Atmosphere& atmosphere, std::span<const double> wavelengths) {
  Medium medium{.shell = {atmosphere.planetRadius, atmosphere.height},
                .wavelengths = {wavelengths.begin(), wavelengths.end()},
                .profiles = {atmosphere.air, atmosphere.aerosolProfile, atmosphere.ozoneProfile},
                .aerosolPhase = atmosphere.aerosolPhase,
                .scattering = {},
                .extinction = {},
                .albedo = {},
                .solarIrradiance = {}};
  const double aerosolColumn = atmosphere.aerosolProfile.column(atmosphere.height);
  const double ozoneColumn = atmosphere.ozoneProfile.column(atmosphere.height);
  for (const double nm : wavelengths) {
    const double air = rayleighCoefficient(atmosphere.rayleigh, nm);
    const double aerosol =
        aerosolColumn > 0 ? std::visit(AerosolExtinction{nm, aerosolColumn}, atmosphere.aerosols)
                          : 0;
    const double ozone = ozoneColumn > 0 ? atmosphere.ozone * radiometry::kDobsonUnit *
                                               radiometry::ozoneCrossSection(nm) / ozoneColumn
                                         : 0;
    medium.scattering[kAir].push_back(air);
    medium.extinction[kAir].push_back(air);
    medium.scattering[kAerosol].push_back(aerosol * atmosphere.singleScatteringAlbedo);
    medium.extinction[kAerosol].push_back(aerosol);
    medium.scattering[kOzone].push_back(0);
    medium.extinction[kOzone].push_back(ozone);
    medium.albedo.push_back(atmosphere.groundAlbedo.at(nm));
    medium.solarIrradiance.push_back(atmosphere.solarIrradiance ? atmosphere.solarIrradiance->at(nm)
                                                                : radiometry::solarIrradiance(nm));
  }
  return medium;
}

}  // namespace lambent::sky
