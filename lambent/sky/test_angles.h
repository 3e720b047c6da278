// Angles for tests.
#pragma once

#include "lambent/math/types.h"

namespace lambent::sky::test {

inline constexpr double kDegree = kPi / 180;

}  // namespace lambent::sky::test
