// The inner loop of all that is simulated here: light added up along one ray, for several
// wavelengths side by side. Plain declarations only: compiled once for each instruction set.
//
// What a ray passes is split in nodes of a quadrature. A node knows where it is (geometry, which no
// wavelength changes); the tables know how the air there scatters.
#pragma once

namespace lambent::sky {

inline constexpr int kLanes = 16;  ///< wavelengths side by side

/// One node of a ray's quadrature.
struct MarchNode {
  float weight;        ///< of the quadrature, m
  float density[3];    ///< of each Part
  float length[3];     ///< optical lengths of each Part from the ray's origin to here, m
  float sunLength[3];  ///< and from here to the Sun
  float sunVisible;    ///< how much of the Sun's disc is above the horizon from here
  /// Cells of (Sun's zenith angle, altitude) that the tables are interpolated from.
  int cellCount;
  int cell[16];
  float cellWeight[16];
  /// The first of 4 × 4 directions (zenith angle × azimuth from the Sun) within a cell.
  int direction;
  float zenithWeight[4], azimuthWeight[4];
  /// 1 + ω ω of the ray's direction in the frame of the place: what Rayleigh's phase function asks
  /// of the second moments of radiance.
  float moment[4];
};

/// Scattered radiance by place and direction; each pointer is to kLanes floats for every item.
struct MarchTables {
  const float* extinction[3];  ///< of each Part at density 1, 1/m
  const float* scattering[2];  ///< of air and aerosol
  const float* logScale;       ///< [cell]: what the rest of the cell is to be multiplied by
  const float* moments;        ///< [cell][4]: ∫ radiance (xx, yy, zz, xy)
  const float* aerosol;        ///< [cell][direction]: ∫ radiance · phase of aerosols
  int directions;              ///< in a cell
  int azimuthStride;           ///< directions of one zenith angle
};

/// What comes of it; kLanes each, for a Sun of irradiance 1.
struct MarchSums {
  float air[kLanes];       ///< light scattered once, by air
  float aerosol[kLanes];   ///< and by aerosol, both without the phase function
  float multiple[kLanes];  ///< all that the tables hold, scattered once more
};

using MarchKernel = void (*)(const MarchTables& tables, const MarchNode* nodes, int count,
                             bool once, bool again, MarchSums& sums);

/// exp of kLanes numbers, good to 2 units in the last place of a float; 0 below −87.
using ExpKernel = void (*)(const float* x, float* out);

/// out[r] = Σ weights[r · count + i] · in[i], kLanes for every item.
using WeighKernel = void (*)(const float* weights, int rows, int count, const float* in,
                             float* out);

struct MarchKernels {
  MarchKernel march;
  ExpKernel exp;
  WeighKernel weigh;
};

namespace baseline {
MarchKernels marchKernels();
}
namespace avx2 {
MarchKernels marchKernels();
}
namespace avx512 {
MarchKernels marchKernels();
}

}  // namespace lambent::sky
