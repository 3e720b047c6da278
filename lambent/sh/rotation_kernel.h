// The rotation of one vector, compiled for several instruction sets. Internal to this room;
// includes nothing that has inline functions (see lambent_isa_kernels in cmake/LambentRoom.cmake).
#pragma once

namespace lambent::sh {

/// q: a rotation, 3×3, column-major. in, out: bands² each, which may be the same.
using RotationKernel = void (*)(const float* q, const float* in, float* out);

struct RotationKernels {
  RotationKernel forBands[11];  ///< [1] … [10]
};

namespace baseline {
RotationKernels rotationKernels();
}
namespace avx2 {
RotationKernels rotationKernels();
}
namespace avx512 {
RotationKernels rotationKernels();
}

}  // namespace lambent::sh
