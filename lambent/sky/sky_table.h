// The sky of one atmosphere from one altitude, for every place of the Sun: tabulated once, looked up
// in microseconds.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lambent/report/progress.h"
#include "lambent/report/result.h"
#include "lambent/sky/dome.h"
#include "lambent/sky/scattering.h"
#include "lambent/sky/view_grid.h"

namespace lambent::sky {

/// The lowest Sun of the tables, rad: −18° and a little more for its neighbours.
inline constexpr double kLowestSun = -18.6 * kPi / 180;

/// Logarithms of radiance for a Sun of irradiance 1 above the air, at tableWavelengths(): of all
/// light but that which aerosols scattered once, and of that without its phase function.
class SkyTable {
 public:
  struct Impl;
  /// nm, over 340 … 740: as many as the kernels have lanes. What is spoken of most often, 450, 550,
  /// 650 and 720 nm, is among them.
  static const std::array<double, kLanes>& wavelengths();

  /// Solves the atmosphere and looks at its sky from `altitude` (m).
  static Result<SkyTable> make(const Atmosphere& atmosphere, double altitude,
                               const Progress& progress = {});

  /// With the Sun's centre at an elevation ≥ kLowestSun, as it stands without refraction.
  /// `nearness`: (1 AU / distance of the Sun)². The dome lasts as long as it is held, whatever
  /// becomes of the table.
  std::shared_ptr<const Dome> dome(double sunElevation, double nearness = 1) const;
  /// Irradiance of the ground, and of a surface at the viewer that faces the Sun as if all of its
  /// disc were above the horizon; W m⁻² nm⁻¹ at `wavelengths` (nm).
  struct Light {
    std::vector<double> groundDiffuse, groundDirect, sun;
  };
  Light light(double sunElevation, double nearness, std::span<const double> wavelengths) const;

  double altitude() const;
  double horizon() const;  ///< its elevation, rad, ≤ 0

  /// Of whoever makes something smaller of the table: where its nodes lie along the Sun's elevation
  /// (rad, falling from π/2 to kLowestSun or just below it), in directions, and what they hold.
  std::vector<double> sunElevations() const;
  const ViewGrid& view() const;
  /// X, Y, Z in cd m⁻² at every node of view(), [row][azimuth]: of all light but that which aerosols
  /// scattered once, and of that without its phase function.
  struct NodeColor {
    radiometry::Xyzv rest, aerosols;
  };
  std::vector<NodeColor> nodeColors(double sunElevation) const;

  /// As bytes that begin with tableKey(), and back: nothing if they are of another length, or of
  /// another atmosphere or altitude.
  std::vector<std::byte> bytes() const;
  static std::optional<SkyTable> fromBytes(std::span<const std::byte> bytes,
                                           const Atmosphere& atmosphere, double altitude);

 private:
  explicit SkyTable(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
  std::shared_ptr<const Impl> impl_;
};

/// All that a table is of, and the version of how it is made.
std::string tableKey(const Atmosphere& atmosphere, double altitude);

}  // namespace lambent::sky
