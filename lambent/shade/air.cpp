#include "lambent/shade/air.h"

#include "lambent/sky/aerial_table.h"

namespace lambent::shade {

Rgb Air::seen(const Vec3& direction, float distance, const Rgb& radiance) const {
  const sky::AirBetween between =
      table->at(sunFromAsset * direction.cast<double>(), double(distance) * metresPerUnit);
  return between.seen(radiance.cast<double>()).cast<float>();
}

}  // namespace lambent::shade
