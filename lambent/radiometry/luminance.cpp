#include "lambent/radiometry/luminance.h"

namespace lambent::radiometry {

float luminance(const Rgb& linear) {
  return 0.2126f * linear[0] + 0.7152f * linear[1] + 0.0722f * linear[2];
}

}  // namespace lambent::radiometry
