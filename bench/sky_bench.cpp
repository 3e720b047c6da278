// What a sky costs on one thread: its tables, a picture of it, its harmonics. usage:
// lambent_sky_bench [CSV]. Ratios are against what one would take instead, in the same run:
// Preetham's sky for a picture, and the projection of a picture for harmonics.
#include <ctime>
#include <filesystem>

#include "bench/figures_file.h"
#include "lambent/image/project.h"
#include "lambent/light/environment.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sky/sky_picture.h"
#include "lambent/work/thread_limit.h"

namespace lambent::bench {
namespace {

constexpr int kWidth = 512, kHeight = 256;

template <class T>
T orDie(Result<T> result) {
  if (result) return std::move(*result);
  fmt::print(stderr, "sky_bench: {}\n", result.error().message);
  std::exit(1);
}

sky::SkyOptions optionsOf(sky::Model model, double elevationDegrees) {
  sky::SkyOptions options;
  options.model = model;
  options.sunElevation = elevationDegrees * kPi / 180;
  return options;
}

std::vector<Vec3d> directionsOfPixels() {
  std::vector<Vec3d> directions;
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x)
      directions.push_back(
          *image::directionOf({image::MapKind::LatLong, kWidth, kHeight}, {x + .5, y + .5}));
  return directions;
}

/// All directions of a map, ground and all, as linear RGB.
void drawInto(image::Image& picture, const std::vector<Vec3d>& directions, const sky::Dome& dome) {
  for (std::size_t i = 0; i < directions.size(); ++i)
    picture.pixels[i] = radiometry::linearRgbOf(dome.color(directions[i])).cast<float>();
}

/// How long tables take from nothing, and from the disk.
void setUp(const std::filesystem::path& folder) {
  const sky::SkyOptions bare = optionsOf(sky::Model::Fast, 12);
  const double start = now();
  const std::clock_t busy = std::clock();
  const sky::SkyTable table = orDie(sky::SkyTable::make(bare.atmosphere, 0));
  const double made = now() - start;
  const double cpu = double(std::clock() - busy) / CLOCKS_PER_SEC;
  sky::SkyOptions kept = bare;
  kept.cache = folder;
  orDie(sky::makeSky(kept));
  const double read = bestOf(15, {[&] { orDie(sky::makeSky(kept)); }})[0];
  note("sky, tables from nothing", made, "s", "<= 10");
  note("sky, tables from nothing, time of the CPU", cpu, "s", "<= 10");
  note("sky, tables from the disk, and a sky", 1e3 * read, "ms");
  note("sky, tables from the disk over from nothing", read / cpu, "ratio");
  note("sky, size of the tables", double(table.bytes().size()) / 1048576, "MiB", "<= 8");
}

void run() {
  const work::ThreadLimit one(1);
  const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                       fmt::format("lambent-sky-bench-{:x}", long(1e6 * now()));
  setUp(folder);
  sky::SkyMaker maker;
  sky::SkyOptions options = optionsOf(sky::Model::Fast, 12);
  options.cache = folder;
  const sky::Sky fast = orDie(maker.make(options)).value;
  const sky::Sky preetham = orDie(sky::makeSky(optionsOf(sky::Model::Preetham, 12))).value;
  std::filesystem::remove_all(folder);
  options.cache.clear();

  const std::vector<Vec3d> directions = directionsOfPixels();
  image::Image picture(kWidth, kHeight), other(kWidth, kHeight);
  sky::SkyPictureOptions whole;
  whole.shape.width = kWidth, whole.shape.height = kHeight;
  const std::vector<double> pictures =
      bestOf(20, {[&] { drawInto(picture, directions, *fast.dome); },
                  [&] { drawInto(other, directions, *preetham.dome); },
                  [&] { orDie(sky::drawSky(fast, whole)); }});
  note("sky, 512x256 RGB of the simulation", 1e3 * pictures[0], "ms", "<= 30");
  note("sky, 512x256 RGB of Preetham's", 1e3 * pictures[1], "ms");
  note("sky, 512x256 with its horizon and channels, of the simulation", 1e3 * pictures[2], "ms");
  note("sky, a picture of the simulation over one of Preetham's", pictures[0] / pictures[1],
       "ratio");

  // The Sun moves from call to call, as a clock moves it.
  constexpr int kMoments = 40;
  double sum = 0, elevation = 12;
  const auto toHarmonics = [&](sky::Model model) {
    return [&, model] {
      sky::SkyOptions moment = options;
      moment.model = model;
      for (int i = 0; i < kMoments; ++i) {
        moment.sunElevation = (elevation += .001) * kPi / 180;
        const sky::Sky sky = orDie(maker.make(moment)).value;
        sum += double(sky::environmentOf(sky, Mat3d::Identity()).project(5).values[0]);
      }
    };
  };
  const auto domeAlone = [&] {
    for (int i = 0; i < kMoments; ++i) sum += sky::projectDome(*fast.dome, 0, 5)[0];
  };
  const std::vector<double> harmonics = bestOf(
      5, {toHarmonics(sky::Model::Fast), toHarmonics(sky::Model::Preetham), domeAlone,
          [&] { sum += double(image::project(picture, image::MapKind::LatLong, 5).values[0]); }});
  const double each = harmonics[0] / kMoments;
  note("sky, to 5 bands with Sun and ground, the Sun moved", 1e3 * each, "ms", "<= 0.2");
  note("sky, the same of Preetham's", 1e3 * harmonics[1] / kMoments, "ms");
  note("sky, the dome alone to 5 bands", 1e3 * harmonics[2] / kMoments, "ms");
  note("sky, 512x256 RGB to 5 bands", 1e3 * harmonics[3], "ms");
  note("sky, to 5 bands over projecting its picture", each / harmonics[3], "ratio");
  note("sky, to 5 bands over making and projecting its picture",
       each / (pictures[0] + harmonics[3]), "ratio");
  if (sum == 0) fmt::print("dark\n");
}

}  // namespace
}  // namespace lambent::bench

int main(int argc, char** argv) {
  lambent::bench::run();
  lambent::bench::writeFigures(argc > 1 ? argv[1] : "");
  return 0;
}
