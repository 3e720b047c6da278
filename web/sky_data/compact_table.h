// Tables of one atmosphere at several turbidities as a few numbers: what a page has of a sky.
#pragma once

#include <string>
#include <vector>

#include "lambent/report/result.h"
#include "lambent/sky/sky_table.h"

namespace lambent::page {

/// 10^(i/10): even steps of the logarithm, from no aerosols on.
std::vector<double> turbidityNodes();

struct CompactOptions {
  int components = 56;  ///< of the factorisation
  double step = 0.002;  ///< to which logarithms are rounded
};

/// What one turbidity holds: its table, and the Sun of the analytic models.
struct TurbidSky {
  sky::Atmosphere atmosphere;
  sky::SkyTable table;
};

/// "lambsky1", the length of a header (uint32, little-endian), the header (JSON), and arrays of whole
/// numbers, each of which is the difference from the one before it in its array (the first: from 0)
/// as a varint: 2 d, or −2 d − 1 if it is negative, by 7 bits to a byte, the lowest first, the eighth
/// bit set in all but the last.
///   mean               [column], times step
///   for each component
///     basis            [column], times step
///     weights          [turbidity][Sun], times weightSteps[component]
///   sun, plainSun      [turbidity][X, Y, Z][elevation], times sunStep: log of the irradiance (lx) of a
///                      surface that faces the Sun with all of its disc above the horizon, of the
///                      simulation and of the analytic models
/// mean + Σ weight · basis are logarithms, natural as all here; columns are
///   [part][X, Y, Z][row][azimuth]: part 0 is luminance (cd m⁻²) but for that which aerosols
///   scattered once; part 1 is log(r + floor), r that light without its phase function over part 0
///   and over (turbidity − noHaze);
///   then [X, Y, Z] of the dome's irradiance of the ground (lx).
/// Rows and azimuths are those of ViewGrid above the horizon, and Suns those of
/// SkyTable::sunElevations(). Elevation e of the n = sunNodes of `sun` and `plainSun` is
/// π/2 (e/(n − 1))².
Result<std::string> compactTable(const std::vector<TurbidSky>& skies,
                                 const CompactOptions& options);

}  // namespace lambent::page
