// An atmosphere as a person describes it: molecules, aerosols, ozone, ground, Sun.
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "lambent/media/density_profile.h"
#include "lambent/media/phase_function.h"
#include "lambent/report/result.h"

namespace lambent::sky {

/// A quantity at some wavelengths: linear between them, constant beyond. One entry: grey.
struct Spectral {
  std::vector<double> wavelengths;  ///< nm, rising
  std::vector<double> values;

  static Spectral constant(double value) { return {{550}, {value}}; }
  double at(double nanometres) const;
  bool operator==(const Spectral&) const = default;
};

/// Everything in SI units but for wavelengths, which are in nm. Coefficients are per metre at the
/// ground, where every density profile counts 1.
struct Atmosphere {
  /// How molecules scatter.
  enum class Rayleigh {
    Penndorf,  ///< penndorf1957tables: 15 °C, 1013 hPa
    Formula,   ///< preetham2003modeling with its numbers put right: n(λ) by edlen, p = .035
    Seed,      ///< preetham2003modeling to the letter: n = 1.0003, p = .0035
  };
  /// How thick the aerosols are.
  struct Angstrom {
    double thicknessAt1um = 0.04;  ///< vertical optical thickness at 1 µm
    double exponent = 0.8;
    bool operator==(const Angstrom&) const = default;
  };
  /// preetham2003modeling, "Mie scattering".
  struct Junge {
    double concentration = 6e-17;  ///< its c, cm^(v−3): 6e-17 clear … 25e-17 overcast
    double exponent = 4;           ///< its v
    bool operator==(const Junge&) const = default;
  };

  std::string name = "clear";
  double planetRadius = 6.36e6;  ///< m
  double height = 1e5;           ///< of its top above the ground, m

  Rayleigh rayleigh = Rayleigh::Penndorf;
  media::DensityProfile air = media::DensityProfile::exponential(8000);

  std::variant<Angstrom, Junge> aerosols = Angstrom{};
  double singleScatteringAlbedo = 0.9;
  media::PhaseFunction aerosolPhase = media::CornetteShanks{0.7};
  media::DensityProfile aerosolProfile = media::DensityProfile::exponential(1200);

  double ozone = 300;  ///< column, Dobson units
  media::DensityProfile ozoneProfile =
      media::DensityProfile::tabulated({{0, 0}, {10e3, 0}, {25e3, 1}, {40e3, 0}, {60e3, 0}});

  Spectral groundAlbedo = Spectral::constant(0.1);
  /// W m⁻² nm⁻¹ above the air at 1 AU; nothing: ASTM G173, means over 10 nm.
  std::optional<Spectral> solarIrradiance;

  /// The turbidity that made the aerosols, if one did (see withTurbidity).
  std::optional<double> turbidity;

  bool operator==(const Atmosphere&) const = default;
};

/// W m⁻² nm⁻¹ above the air at 1 AU, at a wavelength in nm.
double solarIrradianceOf(const Atmosphere& atmosphere, double nanometres);

/// preetham1999practical, appendix 1: aerosols with Ångström exponent 1.3 and thickness .04608 T − .04586 at
/// 1 µm. 1 ≤ turbidity ≤ 10 (1: no aerosols).
Atmosphere withTurbidity(Atmosphere atmosphere, double turbidity);

/// "clear", "reference", "hazy", …: the names, and the atmosphere of one.
std::span<const std::string_view> presets();
std::optional<Atmosphere> preset(std::string_view name);

/// A JSON atmosphere (docs/atmospheres.md). BadInput names the file, the key and its range. `name`
/// stands in messages for the file.
Result<Atmosphere> parseAtmosphere(std::string_view json, const std::string& name);
/// The same from a file of 1 MiB at most.
Result<Atmosphere> readAtmosphere(const std::filesystem::path& path);
/// Every key, lengths in m, numbers with as many digits as bring them back: what parseAtmosphere()
/// makes of it is equal to `atmosphere`, if that is in the ranges. Equal atmospheres give the same
/// bytes. A number that is not finite becomes null, which parseAtmosphere() refuses.
std::string toJson(const Atmosphere& atmosphere);

}  // namespace lambent::sky
