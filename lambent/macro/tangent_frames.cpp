// Matrices turned from the world into tangent frames: M_local = D M, D the rotation of harmonics by
// tangentFromWorld (sloan2003biscale §3: "M_p includes a rotation of the lighting from a global
// coordinate frame into a local frame").

#include <Eigen/Geometry>

#include "lambent/macro/simulation.h"
#include "lambent/sh/rotation.h"
#include "lambent/work/parallel_for.h"

namespace lambent::macro {

namespace {

/// Rows: tangent, normal × tangent, normal, made exactly orthonormal about the normal.
Mat3d tangentFromWorld(const Vec3& tangent, const Vec3& normal) {
  const Vec3d n = normal.cast<double>().normalized();
  const Vec3d along = tangent.cast<double>();
  const Vec3d t = (along - n * n.dot(along)).normalized();
  Mat3d rows;
  rows << t.transpose(), n.cross(t).transpose(), n.transpose();
  return rows;
}

}  // namespace

std::vector<float> inTangentFrames(const Simulation& simulation,
                                   const PlacedReceivers::PerMesh& place, const float* matrices,
                                   int channels) {
  const std::size_t rows = simulation.outCount, columns = simulation.inCount;
  std::vector<float> turned(std::size_t(place.count) * channels * rows * columns);
  work::parallelRanges(place.count, 64, [&](std::size_t begin, std::size_t end) {
    std::vector<double> sum(columns);
    for (std::size_t k = begin; k < end; ++k) {
      const std::vector<double> d = sh::rotationMatrix(
          simulation.outBands, tangentFromWorld(place.local->tangents[k],
                                                simulation.receivers.normals[place.first + k]));
      for (int c = 0; c < channels; ++c)
        for (std::size_t i = 0; i < rows; ++i) {
          // The rotation is block-diagonal: row i looks at its own band alone.
          const int l = sh::bandOf(int(i));
          std::fill(sum.begin(), sum.end(), 0.0);
          for (std::size_t r = std::size_t(l) * l; r < std::size_t(l + 1) * (l + 1); ++r) {
            const float* from =
                matrices + k * simulation.matrixStride() + r * simulation.rowStride + c * columns;
            for (std::size_t j = 0; j < columns; ++j) sum[j] += d[i * rows + r] * from[j];
          }
          float* to = turned.data() + ((k * channels + c) * rows + i) * columns;
          for (std::size_t j = 0; j < columns; ++j) to[j] = float(sum[j]);
        }
    }
  });
  return turned;
}

}  // namespace lambent::macro
