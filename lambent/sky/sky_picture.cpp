#include "lambent/sky/sky_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "lambent/sky/sun_coverage.h"
#include "lambent/work/runner.h"

namespace lambent::sky {

namespace {

constexpr std::size_t kMostValues = std::size_t(1) << 28;
/// Along a pixel's side through which the horizon runs.
constexpr int kSubpixels = 4;

/// X, Y, Z and V′ are darkened towards the limb as the wavelengths at which these functions have
/// their centroids, nm.
constexpr std::array<double, 4> kCentroids{596, 560, 453, 502};

/// What goes into the channels: colours first, then the spectrum.
class Painter {
 public:
  Painter(const Sky& sky, const SkyPictureOptions& options)
      : sky_(sky), options_(options), radius_(pixelRadius(options.shape)) {
    if (options.quantity == Quantity::Spectral) wavelengths_ = options.wavelengths;
    if (!options.sun) return;
    std::vector<double> exponents;
    for (const double nm : kCentroids) exponents.push_back(limbDarkening(nm));
    for (const double nm : wavelengths_) exponents.push_back(limbDarkening(nm));
    sun_.emplace(sky.sun, sky.horizon, std::move(exponents));
    if (!sun_->isVisible()) sun_.reset();
  }

  std::size_t size() const { return 4 + wavelengths_.size(); }

  /// X, Y, Z, V and the spectrum of a pixel; false if it looks nowhere.
  bool paint(int x, int y, std::vector<double>& values) const {
    std::fill(values.begin(), values.end(), 0.0);
    const std::optional<Vec3d> world = directionOfPixel(options_.shape, x, y);
    if (!world) return false;
    const Vec3d centre = inSunFrame(*world);
    const double fromHorizon = std::asin(std::clamp(centre.y(), -1.0, 1.0)) - sky_.horizon;
    if (std::abs(fromHorizon) < radius_)
      addSubpixels(x, y, centre, values);
    else
      addSeen(centre, 1.0, values);
    if (sun_ && centre.dot(sun_->centre()) > std::cos(sun_->angularRadius() + radius_))
      addSun(x, y, values);
    return true;
  }

 private:
  Vec3d inSunFrame(const Vec3d& world) const {
    return (options_.worldFromSun.transpose() * world).normalized();
  }

  void addSeen(const Vec3d& direction, double weight, std::vector<double>& values) const {
    const radiometry::Xyzv color = colorSeen(sky_, options_.below, direction);
    for (int i = 0; i < 4; ++i) values[std::size_t(i)] += weight * color[i];
    if (wavelengths_.empty()) return;
    std::vector<double> spectrum(wavelengths_.size());
    spectrumSeen(sky_, options_.below, direction, wavelengths_, spectrum);
    for (std::size_t i = 0; i < spectrum.size(); ++i) values[4 + i] += weight * spectrum[i];
  }

  void addSubpixels(int x, int y, const Vec3d& centre, std::vector<double>& values) const {
    constexpr double kWeight = 1.0 / (kSubpixels * kSubpixels);
    for (int j = 0; j < kSubpixels; ++j) {
      for (int i = 0; i < kSubpixels; ++i) {
        const auto world =
            directionOf(options_.shape, {x + (i + 0.5) / kSubpixels, y + (j + 0.5) / kSubpixels});
        addSeen(world ? inSunFrame(*world) : centre, kWeight, values);
      }
    }
  }

  void addSun(int x, int y, std::vector<double>& values) const {
    // So many that a side's parts are as short as the disc is wide.
    const double parts = std::clamp(radius_ / sun_->angularRadius(), 4.0, 64.0);
    std::vector<Vec3d> outline = outlineOf(options_.shape, x, y, int(std::ceil(parts)));
    for (Vec3d& direction : outline) direction = inSunFrame(direction);
    std::vector<double> shares(values.size());
    sun_->shares(outline, shares);
    const double perSolidAngle = 1 / solidAngleOf(options_.shape, x, y);
    for (int i = 0; i < 4; ++i)
      values[std::size_t(i)] += sky_.sun.irradiance[i] * shares[std::size_t(i)] * perSolidAngle;
    for (std::size_t i = 0; i < wavelengths_.size(); ++i)
      values[4 + i] += spectrumAt(sky_, sky_.sun.spectralIrradiance, wavelengths_[i]) *
                       shares[4 + i] * perSolidAngle;
  }

  const Sky& sky_;
  const SkyPictureOptions& options_;
  double radius_;
  std::vector<double> wavelengths_;
  std::optional<SunCoverage> sun_;
};

/// The channels of a quantity, empty.
image::ChannelImage canvas(const SkyPictureOptions& options) {
  image::ChannelImage picture(options.shape.width, options.shape.height);
  const auto add = [&](std::initializer_list<const char*> names) {
    for (const char* name : names) picture.add(name);
  };
  switch (options.quantity) {
    case Quantity::Radiance:
      add({"R", "G", "B"});
      picture.attributes = {{"radianceUnits", "W.m^-2.sr^-1"}};
      break;
    case Quantity::Luminance:
      add({"Y"});
      picture.attributes = {{"luminanceUnits", "cd.m^-2"}};
      break;
    case Quantity::Xyzv:
      add({"X", "Y", "Z", "V"});
      picture.attributes = {{"luminanceUnits", "cd.m^-2"}};
      break;
    case Quantity::Spectral:
      add({"R", "G", "B"});
      for (const double nm : options.wavelengths) picture.add(spectralChannel(nm));
      picture.attributes = {{"spectralLayoutVersion", "1.0"},
                            {"emissiveUnits", "W.m^-2.sr^-1.nm^-1"}};
      break;
  }
  return picture;
}

/// Into channels of `canvas`, in its sequence, at pixel `at`.
void store(Quantity quantity, const std::vector<double>& values, image::ChannelImage& picture,
           std::size_t at) {
  const auto put = [&](std::size_t channel, double value) {
    picture.channels[channel].values[at] = float(value);
  };
  const radiometry::Xyzv xyzv(values[0], values[1], values[2], values[3]);
  switch (quantity) {
    case Quantity::Luminance:
      return put(0, xyzv[1]);
    case Quantity::Xyzv:
      for (int i = 0; i < 4; ++i) put(std::size_t(i), xyzv[i]);
      return;
    default: {
      const Rgb rgb = radianceRgb(xyzv);
      for (int i = 0; i < 3; ++i) put(std::size_t(i), double(rgb[i]));
      for (std::size_t i = 4; quantity == Quantity::Spectral && i < values.size(); ++i)
        put(i - 1, values[i]);
    }
  }
}

}  // namespace

std::string spectralChannel(double nanometres) {
  std::string number = fmt::format("{:.6f}", nanometres);
  std::replace(number.begin(), number.end(), '.', ',');
  return fmt::format("S0.{}nm", number);
}

Result<image::ChannelImage> drawSky(const Sky& sky, const SkyPictureOptions& options,
                                    const Progress& progress) {
  const PictureShape& shape = options.shape;
  if (Status fits = checkShape(shape); !fits) return fits.error();
  const std::size_t pixels = std::size_t(shape.width) * std::size_t(shape.height);
  const Painter painter(sky, options);
  if (pixels * painter.size() > kMostValues)
    return report::badUsage(fmt::format(
        "{}x{} pixels with {} channels are {} values, and the most are {}: ask for a smaller "
        "picture or fewer wavelengths",
        shape.width, shape.height, painter.size(), pixels * painter.size(), kMostValues));
  image::ChannelImage picture = canvas(options);
  std::vector<float> alpha(pixels, 0.0f);
  const work::Runner runner(progress);
  const Status done =
      runner.run({"sky", "pixels", std::uint64_t(shape.width)},
                 work::Chunks(std::size_t(shape.height)), std::vector<double>(painter.size()),
                 [&](const work::Chunk& row, std::vector<double>& values) {
                   for (int x = 0; x < shape.width; ++x) {
                     const std::size_t at = row.index * std::size_t(shape.width) + std::size_t(x);
                     if (!painter.paint(x, int(row.index), values)) continue;
                     alpha[at] = 1.0f;
                     store(options.quantity, values, picture, at);
                   }
                 });
  if (!done) return done.error();
  if (std::find(alpha.begin(), alpha.end(), 0.0f) != alpha.end())
    picture.add("A").values = std::move(alpha);
  return picture;
}

}  // namespace lambent::sky
