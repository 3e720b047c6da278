// Tables of one atmosphere at several turbidities as a few numbers: what a page has of a sky.
#pragma once

#include <string>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/sky/sky_table.h"

namespace lambent::page {

/// 10^(i/10): even steps of the logarithm, from no aerosols on.
std::vector<double> turbidityNodes();
/// That of no aerosols: what they scatter is in proportion to turbidity less this.
double turbidityWithoutHaze();

struct CompactOptions {
  int components = 60;  ///< of the factorisation
  double step = 0.002;  ///< to which logarithms are rounded
};

/// What one turbidity holds: its table, and the Sun of the analytic models.
struct TurbidSky {
  sky::Atmosphere atmosphere;
  sky::SkyTable table;
};

/// "lambsky1", header and arrays as packed_numbers.h has them: those of Factors with rows
/// [turbidity][Sun], and
///   sun, plainSun      [turbidity][X, Y, Z][elevation], times sunStep: log of the irradiance (lx) of a
///                      surface that faces the Sun with all of its disc above the horizon, of the
///                      simulation and of the analytic models
/// Columns of Factors are logarithms, natural as all here:
///   [part][X, Y, Z][row][azimuth]: part 0 is luminance (cd m⁻²) but for that which aerosols
///   scattered once; part 1 is log(r + floor), r that light without its phase function over part 0
///   and over (turbidity − noHaze);
///   then [X, Y, Z] of the dome's irradiance of the ground (lx).
/// Rows and azimuths are those of ViewGrid above the horizon, and Suns those of
/// SkyTable::sunElevations(). Elevation e of the n = sunNodes of `sun` and `plainSun` is
/// π/2 (e/(n − 1))². The header's `measured` has the tables of Perez's sky (perez_tables.h) row after
/// row, and the knots of ASRC-CIE's in the sequence of AsrcKnots.
Result<std::string> compactTable(const std::vector<TurbidSky>& skies,
                                 const CompactOptions& options);

}  // namespace lambent::page
