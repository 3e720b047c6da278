// The linear-algebra names that every room uses. Eigen does the work.
#pragma once

#include <Eigen/Core>

namespace lambent {

using Vec2 = Eigen::Vector2f;
using Vec3 = Eigen::Vector3f;
using Mat3 = Eigen::Matrix3f;
/// 4×4 without Eigen's alignment promise, so that the library and a program compiled with another
/// -march agree on the layout of every struct that holds one.
using Mat4 = Eigen::Matrix<float, 4, 4, Eigen::DontAlign>;
/// Linear RGB, Rec. 709 primaries: a radiance (W m⁻² sr⁻¹ per channel), or a reflectance in [0, 1].
using Rgb = Eigen::Array3f;

using Vec2d = Eigen::Vector2d;
using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;

inline constexpr double kPi = 3.14159265358979323846;

}  // namespace lambent
