// Simulate → factorise → round: logarithms of colours at all nodes of the tables are a matrix with a
// row for each turbidity and Sun, and a column for each direction, part and primary. Its singular
// vectors fall off fast, for what the Sun's height does to a sky is smooth.
#include "web/sky_data/compact_table.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Dense>

#include "lambent/radiometry/spectra.h"
#include "lambent/sky/asrc_cie.h"
#include "lambent/sky/make_sky.h"
#include "lambent/sky/perez_tables.h"
#include "lambent/sky/sun_above.h"
#include "web/sky_data/factors.h"
#include "web/sky_data/packed_numbers.h"

namespace lambent::page {
namespace {

constexpr double kFloor = 0.01;                // beside which aerosols' share does not show
constexpr double kNoHaze = 0.04586 / 0.04608;  // sky::withTurbidity: the turbidity of no aerosols
constexpr double kGroundWeight = 20;  // of its three columns, which stand for all of the ground
constexpr int kSunNodes = 128;
constexpr double kSunStep = 1e-3;  // to which logarithms of the Sun's light are rounded

double safeLog(double value) {
  return std::log(std::max(value, 1e-20));
}

std::vector<double> fineWavelengths() {
  std::vector<double> nm;
  for (double at = 340; at <= 740; at += 5) nm.push_back(at);
  return nm;
}

std::vector<double> rowOf(const TurbidSky& sky, double elevation) {
  const sky::SkyTable& table = sky.table;
  // Of which there are in proportion to this: what is left depends little on turbidity.
  const double haze = *sky.atmosphere.turbidity - kNoHaze;
  const std::vector<sky::SkyTable::NodeColor> colors = table.nodeColors(elevation);
  const std::size_t nodes = std::size_t(table.view().above) * std::size_t(table.view().azimuths);
  std::vector<double> row;
  for (int part = 0; part < 2; ++part)
    for (int c = 0; c < 3; ++c)
      for (std::size_t n = 0; n < nodes; ++n) {
        const double rest = std::max(colors[n].rest[c], 1e-20);
        row.push_back(part == 0 ? std::log(rest)
                                : std::log(colors[n].aerosols[c] / rest / haze + kFloor));
      }
  const std::vector<double> nm = fineWavelengths();
  const radiometry::Xyzv ground =
      radiometry::xyzvOf(nm, table.light(elevation, 1, nm).groundDiffuse);
  for (int c = 0; c < 3; ++c) row.push_back(safeLog(ground[c]));
  return row;
}

/// Below the horizon the Sun's light counts as on it, in the tables as in the analytic models.
double discElevation(int node) {
  const double t = double(node) / (kSunNodes - 1);
  return kPi / 2 * t * t;
}

/// The numbers of the models that know a sky by its irradiances.
std::string measuredSkies() {
  const auto list = [](const auto& table) {
    const auto* first = reinterpret_cast<const double*>(&table);
    return fmt::format("[{}]", fmt::join(first, first + sizeof(table) / sizeof(double), ","));
  };
  const sky::AsrcKnots knots;
  return fmt::format(
      R"({{"borders":{},"pattern":{},"diffuse":{},"direct":{},"knots":[{},{},{},{},{}]}})",
      list(sky::kPerezBorders), list(sky::kPerezTable), list(sky::kPerezDiffuseEfficacy),
      list(sky::kPerezDirectEfficacy), knots.overcastUntil, knots.intermediateAt,
      knots.cloudlessFrom, knots.clearUntil, knots.turbidFrom);
}

}  // namespace

double turbidityWithoutHaze() {
  return kNoHaze;
}

std::vector<double> turbidityNodes() {
  std::vector<double> nodes;
  for (int i = 0; i <= 10; ++i) nodes.push_back(std::pow(10.0, i / 10.0));
  return nodes;
}

Result<std::string> compactTable(const std::vector<TurbidSky>& skies,
                                 const CompactOptions& options) {
  const std::vector<double> elevations = skies.front().table.sunElevations();
  std::vector<std::vector<double>> rows;
  for (const TurbidSky& each : skies)
    for (const double elevation : elevations) rows.push_back(rowOf(each, elevation));
  Eigen::MatrixXd m(Eigen::Index(rows.size()), Eigen::Index(rows.front().size()));
  for (Eigen::Index r = 0; r < m.rows(); ++r)
    m.row(r) = Eigen::Map<const Eigen::RowVectorXd>(rows[std::size_t(r)].data(), m.cols());
  FactorOptions rounded{options.components, options.step, Eigen::RowVectorXd::Ones(m.cols()), {}};
  rounded.ofColumns.tail(3).setConstant(kGroundWeight);
  auto factors = factorise(std::move(m), rounded);
  if (!factors) return factors.error();
  std::string& arrays = factors->arrays;
  const std::vector<double> nm = fineWavelengths();
  std::vector<double> logs;
  for (const TurbidSky& each : skies)
    for (int c = 0; c < 3; ++c)
      for (int e = 0; e < kSunNodes; ++e)
        logs.push_back(
            safeLog(radiometry::xyzvOf(nm, each.table.light(discElevation(e), 1, nm).sun)[c]));
  packNumbers(logs, 1 / kSunStep, arrays);
  logs.clear();
  for (const TurbidSky& each : skies) {
    std::vector<radiometry::Xyzv> suns;
    for (int e = 0; e < kSunNodes; ++e) {
      sky::SkyOptions asked;
      asked.model = sky::Model::Preetham;
      asked.atmosphere = each.atmosphere;
      asked.sunElevation = discElevation(e);
      const auto made = sky::makeSky(asked);
      if (!made) return made.error();
      suns.push_back(made->value.sun.irradiance / made->value.sun.visible);
    }
    for (int c = 0; c < 3; ++c)
      for (const radiometry::Xyzv& sun : suns) logs.push_back(safeLog(sun[c]));
  }
  packNumbers(logs, 1 / kSunStep, arrays);

  const sky::ViewGrid& view = skies.front().table.view();
  const std::string header = fmt::format(
      R"({{"turbidities":{},"logTurbidityStep":{},"suns":{},"above":{},"azimuths":{},)"
      R"("step":{},"weightSteps":[{:.6g}],"floor":{},"noHaze":{},"sunNodes":{},"sunStep":{},)"
      R"("sunElevations":[{:.7f}],"measured":{}}})",
      skies.size(), std::log(10.0) / 10, elevations.size(), view.above, view.azimuths, options.step,
      fmt::join(factors->weightSteps, ","), kFloor, kNoHaze, kSunNodes, kSunStep,
      fmt::join(elevations, ","), measuredSkies());
  return packedFile("lambsky1", header, arrays);
}

}  // namespace lambent::page
