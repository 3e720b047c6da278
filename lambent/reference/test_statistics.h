// How far a simulation may be from the truth before its tests fail.
#pragma once

namespace lambent::reference {

/// Of its own standard errors: one test in two million fails by chance.
inline constexpr double kLargestZ = 5.0;

}  // namespace lambent::reference
