// Simulate → factorise → round, as compact_table.cpp.
#include "web/sky_data/compact_air.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Dense>

#include "lambent/radiometry/spectra.h"
#include "lambent/sky/aerial_table.h"
#include "web/sky_data/compact_table.h"
#include "web/sky_data/factors.h"
#include "web/sky_data/packed_numbers.h"

namespace lambent::page {
namespace {

constexpr double kAirFloor = 0.05;  // beside which a part does not show
constexpr int kAzimuths = 5, kRows = 10, kDistances = 9;
constexpr int kBelowStep = 3;  // of the rows below the horizon: those that are kept
constexpr int kBelow = (kRows - 1) / kBelowStep + 1;

using sky::AirTable;

Mat3d xyzFromRgb() {
  Mat3d rgbFromXyz;
  for (int c = 0; c < 3; ++c) {
    radiometry::Xyzv unit = radiometry::Xyzv::Zero();
    unit[c] = 1;
    rgbFromXyz.col(c) = radiometry::linearRgbOf(unit).matrix();
  }
  return rgbFromXyz.inverse();
}

/// Rows of a table's elevations that are kept: below the horizon, then above it.
std::vector<int> keptRows() {
  std::vector<int> rows;
  for (int i = 0; i < kBelow; ++i) rows.push_back(i * kBelowStep);
  for (int i = 0; i < kRows; ++i) rows.push_back(kRows + i);
  return rows;
}

double metresTo(const sky::AirTableAxes& axes, int row, int distance) {
  const bool above = row >= kRows;
  const double elevation = axes.elevationOf(above, double(row % kRows) / (kRows - 1));
  const double place =
      std::pow(double(distance) / (kDistances - 1), sky::AirTableAxes::kDistancePower);
  const double first = 1e-3 * std::pow(1.0 / (kDistances - 1), sky::AirTableAxes::kDistancePower);
  return axes.reach(above, elevation) * (distance > 0 ? place : first);
}

/// What is lost of a channel on the way to a node.
double lostAt(const AirTable& table, int row, int distance, int channel) {
  const auto at = std::size_t(distance * 2 * kRows + row) * 3 + std::size_t(channel);
  return -std::expm1(-metresTo(table.axes(), row, distance) *
                     std::exp(double(table.extinction()[at])));
}

std::vector<double> airRowOf(const AirTable& table, double haze) {
  static const Mat3d toXyz = xyzFromRgb();
  const std::vector<int> rows = keptRows();
  const std::size_t nodes = std::size_t(kDistances) * rows.size() * kAzimuths;
  std::vector<double> columns(9 * nodes);
  std::size_t node = 0;
  for (int k = 0; k < kDistances; ++k)
    for (const int row : rows) {
      const Vec3d lost(lostAt(table, row, k, 0), lostAt(table, row, k, 1),
                       lostAt(table, row, k, 2));
      for (int i = 0; i < kAzimuths; ++i, ++node) {
        const std::size_t at = (std::size_t(k * 2 * kRows + row) * kAzimuths + std::size_t(i)) * 3;
        const auto source = [&](AirTable::Source of) {
          Vec3d rgb;
          for (std::size_t c = 0; c < 3; ++c)
            rgb[Eigen::Index(c)] = double(table.scale()) * double(table.source(of)[at + c]);
          return Vec3d(toXyz * (rgb.array() * lost.array() / lost[1]).matrix());
        };
        const Vec3d multiple = source(AirTable::Multiple).cwiseMax(1e-20);
        const Vec3d air = source(AirTable::Air).cwiseMax(0.0);
        const Vec3d aerosol = source(AirTable::Aerosol).cwiseMax(0.0);
        for (int c = 0; c < 3; ++c) {
          const auto part = [&](int p) -> double& {
            return columns[std::size_t(3 * p + c) * nodes + node];
          };
          part(0) = std::log(multiple[c]);
          part(1) = std::log(air[c] / multiple[c] + kAirFloor);
          part(2) = std::log(aerosol[c] / multiple[c] / haze + kAirFloor);
        }
      }
    }
  for (int c = 0; c < 3; ++c)
    for (int k = 0; k < kDistances; ++k)
      for (const int row : rows)
        columns.push_back(
            double(table.extinction()[std::size_t(k * 2 * kRows + row) * 3 + std::size_t(c)]));
  return columns;
}

std::vector<double> everyOther(const std::vector<double>& values) {
  std::vector<double> kept;
  for (std::size_t i = 0; i < values.size(); i += 2) kept.push_back(values[i]);
  return kept;
}

/// What errors count: of light scattered once by its share in all of it, and of extinction by what it
/// does to f.
Eigen::RowVectorXd importanceOfColumns(const Eigen::MatrixXd& m, const sky::AirTableAxes& axes) {
  constexpr double kTypicalPhase[] = {1, 0.06, 0.16};
  constexpr double kOfExtinction = 3, kLeast = 0.03;
  const auto rows = Eigen::Index(keptRows().size());
  const Eigen::Index part = 3 * kDistances * rows * kAzimuths;
  Eigen::RowVectorXd importance = Eigen::RowVectorXd::Ones(m.cols());
  for (Eigen::Index i = 0; i < part; ++i) {
    const auto light = [&](Eigen::Index p) {
      return (kTypicalPhase[p] * m.col(p * part + i).array().exp()).eval();
    };
    const Eigen::ArrayXd air = light(1), aerosols = light(2), all = 1 + air + aerosols;
    importance[part + i] = std::max(kLeast, std::sqrt((air / all).square().mean()));
    importance[2 * part + i] = std::max(kLeast, std::sqrt((aerosols / all).square().mean()));
  }
  for (Eigen::Index i = 3 * part; i < m.cols(); ++i) {
    const auto node = int((i - 3 * part) % (kDistances * rows));
    const int distance = node / int(rows), row = keptRows()[std::size_t(node % int(rows))];
    const double metres = metresTo(axes, row, std::max(distance, 1));
    const double most = m.col(i)
                            .unaryExpr([&](double log) { return metres * std::exp(log); })
                            .unaryExpr([](double depth) { return depth * std::exp(1 - depth); })
                            .maxCoeff();
    importance[i] = kOfExtinction * std::max(kLeast, most);
  }
  return importance;
}

/// Deep in twilight errors count less: there is hardly any light.
double importanceOfSun(double elevation) {
  const double below = std::clamp((-elevation * 180 / kPi - 2) / 4, 0.0, 1.0);
  return 1 - 0.7 * below;
}

}  // namespace

Result<std::string> compactAir(const std::vector<double>& allSuns,
                               const CompactAirOptions& options) {
  std::vector<double> nm;
  for (int i = 0; i <= 15; ++i) nm.push_back(380 + i * 24.0);
  const std::vector<double> suns = everyOther(allSuns);
  const std::vector<double> turbidities = turbidityNodes();
  const double noHaze = turbidityWithoutHaze();
  std::vector<std::vector<double>> rows;
  sky::AirTableAxes axes;
  double asymmetry = 0;
  for (const double turbidity : turbidities) {
    const sky::Atmosphere atmosphere = sky::withTurbidity(*sky::preset("clear"), turbidity);
    const auto solved =
        sky::Scattering::solve(sky::mediumOf(atmosphere, nm), sky::Resolution::fast());
    if (!solved) return solved.error();
    for (const double sun : suns) {
      const AirTable table(*solved, atmosphere, {0, sun, 1}, {2 * kRows, kAzimuths, kDistances, 4});
      axes = table.axes();
      asymmetry = std::get<media::CornetteShanks>(table.aerosolPhase()).g;
      rows.push_back(airRowOf(table, turbidity - noHaze));
    }
    fmt::print(stderr, "air of turbidity {:.2f}\n", turbidity);
  }
  Eigen::MatrixXd m(Eigen::Index(rows.size()), Eigen::Index(rows.front().size()));
  for (Eigen::Index r = 0; r < m.rows(); ++r)
    m.row(r) = Eigen::Map<const Eigen::RowVectorXd>(rows[std::size_t(r)].data(), m.cols());
  FactorOptions rounded{options.components, options.step, importanceOfColumns(m, axes),
                        Eigen::VectorXd(m.rows())};
  for (Eigen::Index r = 0; r < m.rows(); ++r)
    rounded.ofRows[r] = importanceOfSun(suns[std::size_t(r) % suns.size()]);
  const auto factors = factorise(std::move(m), rounded);
  if (!factors) return factors.error();
  const std::string header = fmt::format(
      R"({{"turbidities":{},"logTurbidityStep":{},"suns":{},"azimuths":{},"below":{},"above":{},)"
      R"("distances":{},"step":{},"weightSteps":[{:.6g}],"floor":{},"noHaze":{},"radius":{},)"
      R"("height":{},"asymmetry":{}}})",
      turbidities.size(), std::log(10.0) / 10, suns.size(), kAzimuths, kBelow, kRows, kDistances,
      options.step, fmt::join(factors->weightSteps, ","), kAirFloor, noHaze, axes.radius,
      axes.height, asymmetry);
  return packedFile("lambair1", header, factors->arrays);
}

}  // namespace lambent::page
