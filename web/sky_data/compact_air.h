// What the air does before things that are seen through it, as a few numbers: the AirTable of a viewer
// on the ground at several turbidities and places of the Sun, at coarse nodes.
#pragma once

#include <string>
#include <vector>

#include "lambent/report/result.h"

namespace lambent::page {

struct CompactAirOptions {
  int components = 16;
  double step = 0.006;  ///< to which logarithms are rounded
};

/// "lambair1", header and arrays as packed_numbers.h has them: those of Factors with rows
/// [turbidity][Sun], turbidities as in the sky's file and every other one of its Suns. Columns are logarithms:
///   [part][X, Y, Z][distance][elevation][azimuth]: part 0 is log of the source of light scattered more
///   than once; 1 and 2 are log(r + floor), r the source of air over that, and that of aerosols over
///   that and over (turbidity − noHaze);
///   then [red, green, blue][distance][elevation]: AirTable::extinction.
/// A source here is a radiance (cd m⁻²) over what is lost of green, both of AirTable. Nodes are even
/// places of AirTableAxes: `below` of elevation from the horizon down to the nadir, `above` from it up to
/// the zenith; `distances`; `azimuths` from 0 to π.
///
/// @param suns elevations of the Sun in the sky's file
Result<std::string> compactAir(const std::vector<double>& suns, const CompactAirOptions& options);

}  // namespace lambent::page
