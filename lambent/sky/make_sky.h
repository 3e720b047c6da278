// From what a person says of a sky to the sky.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "lambent/report/finding.h"
#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/atmosphere.h"
#include "lambent/sky/dome.h"
#include "lambent/sky/sky_table.h"

namespace lambent::sky {

enum class Model { Exact, Fast, Preetham, Perez, AsrcCie, CieOvercast, CieClear, CieGeneral };

struct SkyOptions {
  Model model = Model::Fast;
  int cieType = 12;  ///< of CieGeneral, 1 … 15 (ISO 15469:2004)
  /// What the air is made of, for Exact and Fast; the others take its turbidity, if it says one.
  Atmosphere atmosphere = *preset("clear");
  double sunElevation = 0;  ///< of the disc's centre as it is seen, rad, −18° … 90°
  double sunDistance = 1;   ///< astronomical units
  double altitude = 0;      ///< of the viewer above the ground, m
  std::vector<double>
      wavelengths;  ///< nm, 340 … 740, at which spectra will be asked for; empty: every 10 nm
  /// Of Perez and AsrcCie, W m⁻²; nothing: what the clear sky of this turbidity gives.
  std::optional<double> directNormalIrradiance, diffuseHorizontalIrradiance;
  /// Where tables are kept between runs (see cacheFolder()); empty: nowhere.
  std::filesystem::path cache;
  int refine = 0;  ///< of Exact: each step makes the discretisation finer
};

/// The wavelengths of the options, or every 10 nm of 340 … 740.
std::vector<double> spectrumWavelengths(const SkyOptions& options);

/// Makes skies, one after another: what is expensive and the same for the next one is kept.
class SkyMaker {
 public:
  /// BadUsage names what is out of its range and the range.
  Result<WithFindings<Sky>> make(const SkyOptions& options, const Progress& progress = {});

 private:
  Result<SkyTable> tableOf(const SkyOptions& options, Findings& findings, const Progress& progress);
  struct Kept {
    Atmosphere atmosphere;
    SkyTable table;
  };
  std::optional<Kept> kept_;
};

/// One sky.
Result<WithFindings<Sky>> makeSky(const SkyOptions& options, const Progress& progress = {});

/// lambent/ in XDG_CACHE_HOME or ~/.cache; empty where neither is known.
std::filesystem::path cacheFolder();

/// What reaches a horizontal surface at the viewer.
struct Horizontal {
  radiometry::Xyzv direct, diffuse;  ///< X, Y, Z in lx, and scotopic lx; of the Sun and of the dome
  std::vector<double> directSpectrum, diffuseSpectrum;  ///< W m⁻² nm⁻¹ at Sky::wavelengths
};
Horizontal onHorizontal(const Sky& sky);

}  // namespace lambent::sky
