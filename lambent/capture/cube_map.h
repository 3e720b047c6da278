// Radiance in the six pictures of a cube, and their projection to harmonics
// (sloan2002precomputed §6.2).
//
// Faces and their axes are OpenGL's (its specification, "Cube Map Texture Selection"): 0 … 5 are
// +x, −x, +y, −y, +z, −z. Texel (i, j) of a face of n×n is at s = (i + ½)/n along the face's s axis
// and t = (j + ½)/n along its t axis. A picture of the face that GL draws has row 0 at t = 0.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "lambent/math/types.h"
#include "lambent/sh/coefficients.h"

namespace lambent::capture {

/// The axes of a face as unit vectors: the cube's surface is forward + (2s − 1) right +
/// (2t − 1) up. right × up = −forward: a camera that looks along `forward`, with `up` up.
struct CubeFace {
  Vec3d forward, right, up;
};
const std::array<CubeFace, 6>& cubeFaces();

/// The unit direction to a place of a face, s and t in [0, 1].
Vec3d cubeDirection(int face, double s, double t);

/// The solid angle of the rectangle [s0, s1] × [t0, t1] of any face, exactly; sr.
double cubeSolidAngle(double s0, double s1, double t0, double t1);

struct CubeSize {
  int size = 16;          ///< texels along the edge of a face, as they are projected
  int supersampling = 2;  ///< each is the mean of this many texels a side as they are drawn

  int drawn() const { return size * supersampling; }  ///< texels along an edge as they are drawn
  int texels() const { return 6 * size * size; }
};

/// Radiance at the middle of every texel as drawn: [face][j][i], (size · supersampling)² to a face.
struct CubePicture {
  CubeSize shape;
  std::vector<Rgb> texels;
};

/// What a sub-texel weighs: its own solid angle, or, as the paper has it, its area times the
/// differential solid angle at its middle, (1 + x² + y²)^(−3/2). Exact angles sum to 4π, so that
/// uniform light is captured exactly; differential ones are somewhat better for smooth functions.
enum class SolidAngles { Exact, Differential };

/// The basis functions weighted by solid angle: B_i(texel) = Σ y_i(s) ds over the texel's
/// sub-texels: [texel][coefficient], texels as [face][j][i].
std::vector<double> cubeWeights(const CubeSize& shape, int bands,
                                SolidAngles angles = SolidAngles::Exact);

/// Calls visit(texel, subTexel, direction, exact solid angle) for every sub-texel, by index into
/// what is projected and what is drawn.
template <class Visit>
void forAllSubTexels(const CubeSize& shape, const Visit& visit) {
  const int n = shape.size, f = shape.supersampling, drawn = shape.drawn();
  const double step = 1.0 / drawn;
  for (int face = 0; face < 6; ++face)
    for (int j = 0; j < drawn; ++j)
      for (int i = 0; i < drawn; ++i)
        visit(std::size_t((face * n + j / f) * n + i / f),
              std::size_t((face * drawn + j) * drawn + i),
              cubeDirection(face, (i + 0.5) * step, (j + 0.5) * step),
              cubeSolidAngle(i * step, (i + 1) * step, j * step, (j + 1) * step));
}

/// L_i = Σ_texels B_i · (mean of the texel's sub-texels): the light's coefficients. The oracle for
/// the same sum on the GPU.
sh::RgbCoefficients project(const CubePicture& picture, int bands);
/// The same with cubeWeights of the picture's shape made beforehand.
sh::RgbCoefficients project(const CubePicture& picture, std::span<const double> weights);

}  // namespace lambent::capture
