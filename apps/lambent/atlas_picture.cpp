#include "apps/lambent/atlas_picture.h"

#include "lambent/image/io.h"
#include "lambent/math/random.h"

namespace lambent::tool {

namespace {

constexpr int kLargestHalf = 1024;  ///< a side of each half
constexpr std::uint32_t kOutside = atlas::kNoChart;

Rgb chartColour(std::uint32_t chart) {
  math::Random random(0x636861727473, chart);
  return Rgb(0.15f, 0.15f, 0.15f) +
         0.75f * Rgb(random.uniform(), random.uniform(), random.uniform());
}

}  // namespace

Status writeAtlasPicture(const atlas::Atlas& atlas, const asset::Asset& asset, std::uint32_t mesh,
                         const std::filesystem::path& path) {
  const auto& biScale = std::get<transfer::BiScale<transfer::Numbers>>(asset.transfer.meshes[mesh]);
  const transfer::IdMap& map = *biScale.patch.idMap();
  const int side = std::min(kLargestHalf, map.width);
  const std::vector<std::uint32_t> charts = atlas::chartOfTexel(atlas, map.width);
  image::Image picture(2 * side, side);
  for (int y = 0; y < side; ++y)
    for (int x = 0; x < side; ++x) {
      const int column = int(std::int64_t(x) * map.width / side);
      const int row = int(std::int64_t(y) * map.height / side);
      const std::uint32_t chart = charts[std::size_t(row) * map.width + column];
      picture.at(x, y) = chart == kOutside ? Rgb(Rgb::Constant(0.02f)) : chartColour(chart);
      const Vec2 q = map.at(column, row);
      picture.at(side + x, y) = Rgb(q.x(), q.y(), 0.25f) * (chart == kOutside ? 0.3f : 1.0f);
    }
  return image::write(picture, path);
}

}  // namespace lambent::tool
