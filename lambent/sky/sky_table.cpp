// Simulate → tabulate → look up: Scattering is marched through once for every place of the Sun and
// every node of a ViewGrid; one Sun's sky is a slice of that, refined to a map in which a look-up is
// bilinear.
//
// This work is based on:
// - bruneton2008precomputed: §4, aerosols' single scattering apart, so that its phase function stays
//   as sharp as it is.
#include "lambent/sky/sky_table.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>

#include <fmt/format.h>

#include "lambent/math/types.h"
#include "lambent/sky/interpolation.h"
#include "lambent/sky/scattering_tables.h"
#include "lambent/sky/sky_light.h"
#include "lambent/sky/spectral_weights.h"
#include "lambent/sky/sun_above.h"
#include "lambent/work/runner.h"

namespace lambent::sky {
namespace {

constexpr int kHeld = 2;  // what a direction holds: all else, and what aerosols scattered once
constexpr int kBands = 10, kHarmonics = kBands * kBands;
constexpr int kRefined = 4;
constexpr double kTwilightSuns = 1.6;  // to a degree
// Light that aerosols scattered once is left out of the sum where it is this much fainter.
constexpr float kFaint = -11.5f;

}  // namespace

struct SkyTable::Impl {
  double altitude = 0;
  Atmosphere atmosphere;
  Medium medium;
  Grid suns;  // only its Sun's axis
  ViewGrid view;
  ColorUnderSun color;
  SunLengths lengths;
  // Along the Sun's axis all are coefficients of splines.
  /// [sun][view row][azimuth][part][lane], logarithms.
  std::vector<float> radiance;
  std::vector<float> groundDiffuse;  ///< [sun][lane], logarithms
  /// [sun][XYZ][harmonic] of what is above the horizon, divided by [sun] logScale's exponential.
  /// Empty until the rest is there.
  std::vector<float> harmonics, logScale;

  /// What is kept on disk.
  std::array<std::vector<float>*, 4> stored() {
    return {&radiance, &groundDiffuse, &harmonics, &logScale};
  }
  std::array<const std::vector<float>*, 4> stored() const {
    return {&radiance, &groundDiffuse, &harmonics, &logScale};
  }
  std::size_t perSun() const { return std::size_t(view.nodes()) * kHeld * kLanes; }
  Taps sunTaps(double elevation) const {
    return splineTaps(suns.sunCoordinate(kPi / 2 - std::max(elevation, kLowestSun)), suns.suns);
  }
};

namespace {

/// One Sun's slice of the table.
class TableDome final : public Dome {
 public:
  TableDome(std::shared_ptr<const SkyTable::Impl> table, double sunElevation, double nearness)
      : table_(std::move(table)),
        taps_(table_->sunTaps(sunElevation)),
        sun_(std::cos(sunElevation), std::sin(sunElevation), 0),
        nearness_(nearness) {}

  radiometry::Xyzv color(const Vec3d& direction) const override {
    const Map& map = colors();
    const auto [row, column, rowPart, columnPart] = place(map.grid, direction);
    float sum[8] = {};
    for (int i = 0; i < 2; ++i)
      for (int j = 0; j < 2; ++j) {
        const float w = float((i ? rowPart : 1 - rowPart) * (j ? columnPart : 1 - columnPart));
        const float* at = &map.values[(std::size_t(row + i) * map.grid.azimuths + column + j) * 8];
        for (int c = 0; c < 8; ++c) sum[c] += w * at[c];
      }
    const double phase = media::evaluate(table_->medium.aerosolPhase, direction.dot(sun_));
    radiometry::Xyzv out;
    for (int c = 0; c < 4; ++c) out[c] = double(sum[c]) + phase * double(sum[4 + c]);
    return out;
  }

  void spectrum(const Vec3d& direction, std::span<const double> wavelengths,
                std::span<double> radiance) const override {
    const std::vector<float>& logs = slice();
    const ViewGrid& grid = table_->view;
    const auto [above, rowAt] = grid.rowOf(std::asin(std::clamp(direction.y(), -1.0, 1.0)));
    const int offset = above ? 0 : grid.above;
    const Taps rows = cubicTaps(rowAt, above ? grid.above : grid.below);
    const Taps columns = cubicTaps(grid.columnOf(azimuthOf(direction)), grid.azimuths);
    float sum[kHeld * kLanes] = {};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) {
        const float w = float(rows.weight[i] * columns.weight[j]);
        const float* at =
            &logs[(std::size_t(offset + rows.first + i) * grid.azimuths + columns.first + j) *
                  kHeld * kLanes];
        for (int l = 0; l < kHeld * kLanes; ++l) sum[l] += w * at[l];
      }
    const double phase = media::evaluate(table_->medium.aerosolPhase, direction.dot(sun_));
    for (std::size_t i = 0; i < wavelengths.size(); ++i) {
      const SpectralTaps taps(SkyTable::wavelengths(), wavelengths[i]);
      radiance[i] = nearness_ * solarIrradianceOf(table_->atmosphere, wavelengths[i]) *
                    (std::exp(double(taps(sum))) + phase * std::exp(double(taps(sum + kLanes))));
    }
  }

  bool harmonics(double, int bands, std::span<double> xyz) const override {
    if (table_->harmonics.empty()) return false;
    double scale = 0;
    for (int k = 0; k < 4; ++k)
      scale += taps_.weight[k] * double(table_->logScale[std::size_t(taps_.first + k)]);
    scale = std::exp(scale) * nearness_;
    const std::size_t count = std::size_t(bands) * std::size_t(bands);
    for (std::size_t c = 0; c < 3; ++c)
      for (std::size_t i = 0; i < count; ++i) {
        double sum = 0;
        for (int k = 0; k < 4; ++k)
          sum += taps_.weight[k] *
                 double(table_->harmonics[(std::size_t(taps_.first + k) * 3 + c) * kHarmonics + i]);
        xyz[c * count + i] = scale * sum;
      }
    return true;
  }

 private:
  struct Map {
    ViewGrid grid;
    std::vector<float> values;  ///< [row][azimuth][8]: X, Y, Z, V′ of each part
  };
  struct Place {
    int row, column;
    double rowPart, columnPart;
  };

  static double azimuthOf(const Vec3d& direction) {
    return std::atan2(std::abs(direction.z()), direction.x());
  }
  static Place place(const ViewGrid& grid, const Vec3d& direction) {
    const auto [above, at] = grid.rowOf(std::asin(std::clamp(direction.y(), -1.0, 1.0)));
    const int rows = above ? grid.above : grid.below;
    const int row = std::min(int(at), rows - 2);
    const double across = grid.columnOf(azimuthOf(direction));
    const int column = std::min(int(across), grid.azimuths - 2);
    return {row + (above ? 0 : grid.above), column, at - row, across - column};
  }

  const std::vector<float>& slice() const {
    std::call_once(sliced_, [this] {
      const std::size_t count = table_->perSun();
      slice_.assign(count, 0);
      for (int k = 0; k < 4; ++k) {
        const float w = float(taps_.weight[k]);
        const float* at = &table_->radiance[std::size_t(taps_.first + k) * count];
        for (std::size_t i = 0; i < count; ++i) slice_[i] += w * at[i];
      }
    });
    return slice_;
  }

  const Map& colors() const {
    std::call_once(colored_, [this] {
      const std::vector<float>& logs = slice();
      const ViewGrid& coarse = table_->view;
      // Logarithms of colours at the nodes, then cubic between them.
      std::vector<float> nodes(std::size_t(coarse.nodes()) * 8);
      for (std::size_t n = 0; n < std::size_t(coarse.nodes()); ++n)
        for (std::size_t part = 0; part < kHeld; ++part) {
          const radiometry::Xyzv color = table_->color(&logs[(n * kHeld + part) * kLanes]);
          for (int c = 0; c < 4; ++c)
            nodes[n * 8 + part * 4 + std::size_t(c)] =
                float(std::log(std::max(nearness_ * color[c], 1e-30)));
        }
      map_.grid = coarse.refined(kRefined);
      map_.values.resize(std::size_t(map_.grid.nodes()) * 8);
      std::vector<float> row(std::size_t(coarse.azimuths) * 8);
      for (int r = 0; r < map_.grid.rows(); ++r) {
        const bool above = r < map_.grid.above;
        const int offset = above ? 0 : coarse.above;
        const Taps rows = cubicTaps(double(above ? r : r - map_.grid.above) / kRefined,
                                    above ? coarse.above : coarse.below);
        std::fill(row.begin(), row.end(), 0.0f);
        for (int k = 0; k < 4; ++k) {
          const float w = float(rows.weight[k]);
          const float* at =
              &nodes[std::size_t(offset + rows.first + k) * std::size_t(coarse.azimuths) * 8];
          for (std::size_t i = 0; i < row.size(); ++i) row[i] += w * at[i];
        }
        for (int a = 0; a < map_.grid.azimuths; ++a) {
          const Taps columns = cubicTaps(double(a) / kRefined, coarse.azimuths);
          float* out = &map_.values[(std::size_t(r) * map_.grid.azimuths + a) * 8];
          for (int c = 0; c < 8; ++c) {
            float sum = 0;
            for (int k = 0; k < 4; ++k)
              sum += float(columns.weight[k]) * row[std::size_t(columns.first + k) * 8 + c];
            out[c] = std::exp(sum);
          }
        }
      }
    });
    return map_;
  }

  std::shared_ptr<const SkyTable::Impl> table_;
  Taps taps_;
  Vec3d sun_;
  double nearness_;
  mutable std::once_flag sliced_, colored_;
  mutable std::vector<float> slice_;
  mutable Map map_;
};

}  // namespace

const std::array<double, kLanes>& SkyTable::wavelengths() {
  static const std::array<double, kLanes> kNodes = {340, 370, 400, 425, 450, 475, 500, 525,
                                                    550, 575, 600, 625, 650, 685, 720, 740};
  return kNodes;
}

namespace {

/// What follows from atmosphere and altitude alone.
std::shared_ptr<SkyTable::Impl> emptyTable(const Atmosphere& atmosphere, double altitude) {
  auto impl = std::make_shared<SkyTable::Impl>();
  impl->altitude = altitude;
  impl->atmosphere = atmosphere;
  impl->medium = mediumOf(atmosphere, SkyTable::wavelengths());
  impl->suns.twilight = kTwilightSuns;
  impl->suns.first = impl->suns.sunCoordinate(0);
  impl->suns.suns = 1 + int(std::ceil(impl->suns.sunCoordinate(kPi / 2 - kLowestSun)));
  impl->view.horizon = std::asin(impl->medium.shell.horizonCosine(altitude));
  impl->color = ColorUnderSun(SkyTable::wavelengths(), atmosphere);
  impl->lengths = SunLengths(impl->medium);
  const std::size_t suns = std::size_t(impl->suns.suns);
  impl->radiance.resize(suns * impl->perSun());
  impl->groundDiffuse.resize(suns * kLanes);
  return impl;
}

float safeLog(double value) {
  return float(std::log(std::max(value, 1e-30)));
}

}  // namespace

Result<SkyTable> SkyTable::make(const Atmosphere& atmosphere, double altitude,
                                const Progress& progress) {
  const std::shared_ptr<Impl> impl = emptyTable(atmosphere, altitude);
  Impl& t = *impl;
  const auto scattering = Scattering::solve(t.medium, Resolution::fast(), progress);
  if (!scattering) return scattering.error();
  const work::Runner runner(progress);
  const work::Chunks suns(std::size_t(t.suns.suns), 1);
  const Status ran =
      runner.run({.name = "sky", .unit = "Suns"}, suns, [&](const work::Chunk& chunk) {
        const std::size_t sun = chunk.index;
        const double sunZenith = t.suns.sunZenith(int(sun));
        float* out = &t.radiance[sun * t.perSun()];
        for (int row = 0; row < t.view.rows(); ++row)
          for (int column = 0; column < t.view.azimuths; ++column, out += kHeld * kLanes) {
            const double elevation = t.view.elevation(row), azimuth = t.view.azimuth(column);
            const RayInAir ray{altitude, std::sin(elevation), sunZenith,
                               std::sin(elevation) * std::cos(sunZenith) +
                                   std::cos(elevation) * std::sin(sunZenith) * std::cos(azimuth)};
            const AirLight light = scattering->along(ray);
            const double air = media::evaluate(media::RayleighPhase{}, ray.towardsSun);
            for (std::size_t l = 0; l < kLanes; ++l) {
              out[l] = safeLog(air * light.air[l] + light.multiple[l] + light.ground[l]);
              out[kLanes + l] = std::max(safeLog(light.aerosol[l]), out[l] + kFaint);
            }
          }
        const GroundLight ground = scattering->onGround(sunZenith);
        for (std::size_t l = 0; l < kLanes; ++l)
          t.groundDiffuse[sun * kLanes + l] = safeLog(ground.diffuse[l]);
      });
  if (!ran) return ran.error();
  makeSplines(t.radiance, std::size_t(t.suns.suns));
  makeSplines(t.groundDiffuse, std::size_t(t.suns.suns));
  // Harmonics of the finished slices.
  std::vector<float> harmonics(std::size_t(t.suns.suns) * 3 * kHarmonics),
      logScale(std::size_t(t.suns.suns));
  const Status projected =
      runner.run({.name = "harmonics", .unit = "Suns"}, suns, [&](const work::Chunk& chunk) {
        const std::size_t sun = chunk.index;
        const TableDome dome(impl, kPi / 2 - t.suns.sunZenith(int(sun)), 1);
        const std::vector<double> xyz = projectDome(dome, t.view.horizon, kBands);
        const double scale = std::max(xyz[kHarmonics], 1e-30);  // the mean of Y
        logScale[sun] = float(std::log(scale));
        for (std::size_t i = 0; i < xyz.size(); ++i)
          harmonics[sun * 3 * kHarmonics + i] = float(xyz[i] / scale);
      });
  if (!projected) return projected.error();
  makeSplines(harmonics, std::size_t(t.suns.suns));
  makeSplines(logScale, std::size_t(t.suns.suns));
  t.harmonics = std::move(harmonics);
  t.logScale = std::move(logScale);
  return SkyTable(impl);
}

std::shared_ptr<const Dome> SkyTable::dome(double sunElevation, double nearness) const {
  return std::make_shared<TableDome>(impl_, std::max(sunElevation, kLowestSun), nearness);
}

SkyTable::Light SkyTable::light(double sunElevation, double nearness,
                                std::span<const double> wavelengths) const {
  const Impl& t = *impl_;
  const Taps taps = t.sunTaps(sunElevation);
  float diffuse[kLanes] = {};
  for (int k = 0; k < 4; ++k)
    for (std::size_t l = 0; l < kLanes; ++l)
      diffuse[l] +=
          float(taps.weight[k]) * t.groundDiffuse[std::size_t(taps.first + k) * kLanes + l];
  const auto towardsSun = [&](double altitude, float(&logs)[kLanes]) {
    float lengths[kParts];
    t.lengths.at(altitude, kPi / 2 - sunElevation, lengths);
    for (int part = 0; part < kParts; ++part)
      for (std::size_t l = 0; l < kLanes; ++l)
        logs[l] -= float(t.medium.extinction[std::size_t(part)][l]) * lengths[part];
  };
  float onGround[kLanes] = {}, atViewer[kLanes] = {};
  towardsSun(0, onGround);
  towardsSun(t.altitude, atViewer);
  Light light;
  for (const double nm : wavelengths) {
    const SpectralTaps spectral(SkyTable::wavelengths(), nm);
    const double above = nearness * solarIrradianceOf(t.atmosphere, nm);
    light.groundDiffuse.push_back(above * std::exp(double(spectral(diffuse))));
    light.groundDirect.push_back(above * horizontalShareOfDisc(sunElevation) *
                                 std::exp(double(spectral(onGround))));
    light.sun.push_back(above * std::exp(double(spectral(atViewer))));
  }
  return light;
}

std::string tableKey(const Atmosphere& atmosphere, double altitude) {
  return fmt::format("lambent sky table 2\naltitude {:a}\n{}", altitude,
                     scatteringKey(atmosphere, SkyTable::wavelengths(), Resolution::fast()));
}

std::vector<std::byte> SkyTable::bytes() const {
  const std::string key = tableKey(impl_->atmosphere, impl_->altitude);
  std::vector<std::byte> out(key.size());
  std::memcpy(out.data(), key.data(), key.size());
  for (const std::vector<float>* part : impl_->stored()) {
    const std::size_t at = out.size();
    out.resize(at + part->size() * sizeof(float));
    std::memcpy(out.data() + at, part->data(), part->size() * sizeof(float));
  }
  return out;
}

std::optional<SkyTable> SkyTable::fromBytes(std::span<const std::byte> bytes,
                                            const Atmosphere& atmosphere, double altitude) {
  const std::string key = tableKey(atmosphere, altitude);
  if (bytes.size() < key.size() || std::memcmp(bytes.data(), key.data(), key.size()) != 0)
    return std::nullopt;
  const std::shared_ptr<Impl> impl = emptyTable(atmosphere, altitude);
  impl->harmonics.resize(std::size_t(impl->suns.suns) * 3 * kHarmonics);
  impl->logScale.resize(std::size_t(impl->suns.suns));
  std::size_t at = key.size();
  for (std::vector<float>* part : impl->stored()) {
    const std::size_t size = part->size() * sizeof(float);
    if (bytes.size() - at < size) return std::nullopt;
    std::memcpy(part->data(), bytes.data() + at, size);
    at += size;
  }
  if (at != bytes.size()) return std::nullopt;
  return SkyTable(impl);
}

double SkyTable::altitude() const {
  return impl_->altitude;
}

double SkyTable::horizon() const {
  return impl_->view.horizon;
}

std::vector<double> SkyTable::sunElevations() const {
  std::vector<double> elevations;
  for (int sun = 0; sun < impl_->suns.suns; ++sun)
    elevations.push_back(kPi / 2 - impl_->suns.sunZenith(sun));
  return elevations;
}

const ViewGrid& SkyTable::view() const {
  return impl_->view;
}

std::vector<SkyTable::NodeColor> SkyTable::nodeColors(double sunElevation) const {
  const Taps taps = impl_->sunTaps(sunElevation);
  std::vector<NodeColor> colors;
  for (std::size_t node = 0; node < std::size_t(impl_->view.nodes()); ++node) {
    float logs[kHeld * kLanes] = {};
    for (int k = 0; k < 4; ++k) {
      const float* at = &impl_->radiance[std::size_t(taps.first + k) * impl_->perSun() +
                                         node * std::size_t(kHeld * kLanes)];
      for (int l = 0; l < kHeld * kLanes; ++l) logs[l] += float(taps.weight[k]) * at[l];
    }
    colors.push_back({impl_->color(logs), impl_->color(logs + kLanes)});
  }
  return colors;
}

}  // namespace lambent::sky
