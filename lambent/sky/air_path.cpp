#include "lambent/sky/air_path.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "lambent/math/quadrature.h"
#include "lambent/media/optical_length.h"

namespace lambent::sky {
namespace {

/// A rule on [0, 1], and the integrals from 0 to each node of the polynomials through its nodes.
struct Rule {
  math::Quadrature rule;
  std::vector<double> upTo;  ///< [node][polynomial]
};

Rule makeRule(int n) {
  Rule made{math::gaussLegendre(n, 0, 1), std::vector<double>(std::size_t(n) * n)};
  const math::Quadrature fine = math::gaussLegendre(8, 0, 1);
  const std::vector<double>& x = made.rule.nodes;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      for (std::size_t k = 0; k < fine.nodes.size(); ++k) {
        const double at = fine.nodes[k] * x[i];
        double value = 1;
        for (int m = 0; m < n; ++m)
          if (m != j) value *= (at - x[m]) / (x[j] - x[m]);
        made.upTo[std::size_t(i) * n + j] += fine.weights[k] * x[i] * value;
      }
  return made;
}

const Rule& ruleOf(int n) {
  static const std::array<Rule, 9> kRules = {Rule(),      makeRule(1), makeRule(2),
                                             makeRule(3), makeRule(4), makeRule(5),
                                             makeRule(6), makeRule(7), makeRule(8)};
  return kRules[std::size_t(std::clamp(n, 1, 8))];
}

}  // namespace

double altitudeRise(double altitude, double height) {
  return std::pow(std::clamp(altitude / height, 0.0, 1.0), 0.4);
}

double altitudeOfRise(double rise, double height) {
  return height * std::pow(rise, 2.5);
}

AirPath airPath(const Medium& medium, const PathSplit& split, double altitude, double cosine,
                double end, const std::vector<double>& breaks) {
  const media::Shell& shell = medium.shell;
  AirPath path{.nodes = {}, .altitude = altitude, .cosine = cosine, .end = end};
  if (const auto ground = shell.toGround(altitude, cosine); ground && *ground <= path.end) {
    path.end = *ground;
    path.hitsGround = true;
  } else if (!ground) {
    path.end = std::min(path.end, shell.exitAt(shell.height, altitude, cosine).value_or(0));
  }
  std::vector<double> ends = media::smoothPieces(shell, altitude, cosine, path.end, split.levels);
  for (const double place : breaks)
    if (place > 0 && place < path.end) ends.push_back(place);
  std::sort(ends.begin(), ends.end());

  double thickest[kParts] = {}, thinnest[kParts] = {};
  for (int part = 0; part < kParts; ++part) {
    const auto& extinction = medium.extinction[part];
    thickest[part] = *std::max_element(extinction.begin(), extinction.end());
    thinnest[part] = *std::min_element(extinction.begin(), extinction.end());
  }
  const Rule& rule = ruleOf(split.nodes);
  const int n = int(rule.rule.nodes.size());
  double passed[kParts] = {};
  const auto depthOf = [&](const double(&lengths)[kParts], const double(&extinction)[kParts]) {
    double depth = 0;
    for (int part = 0; part < kParts; ++part) depth += lengths[part] * extinction[part];
    return depth;
  };
  for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
    const double span = ends[p + 1] - ends[p];
    if (!(span > 0)) continue;
    double guess[kParts] = {};
    for (const double t : {0.1127, 0.5, 0.8873}) {  // Gauss-Legendre of three nodes
      const double h = shell.altitudeAlong(altitude, cosine, ends[p] + t * span);
      for (int part = 0; part < kParts; ++part)
        guess[part] += (t == 0.5 ? 4.0 / 9 : 2.5 / 9) * span * medium.profiles[part].at(h);
    }
    const int pieces = std::clamp(int(std::ceil(depthOf(guess, thickest) / split.depth)), 1, 400);
    for (int piece = 0; piece < pieces; ++piece) {
      if (depthOf(passed, thinnest) > split.opaque) {
        path.end = ends[p] + span * piece / pieces;
        path.hitsGround = false;
        goto done;
      }
      const double from = ends[p] + span * piece / pieces, length = span / pieces;
      const std::size_t first = path.nodes.size();
      for (int i = 0; i < n; ++i) {
        AirPath::Node node{};
        node.distance = from + rule.rule.nodes[i] * length;
        node.altitude = std::max(0.0, shell.altitudeAlong(altitude, cosine, node.distance));
        node.weight = rule.rule.weights[i] * length;
        node.rise = altitudeRise(node.altitude, shell.height);
        node.horizon = std::acos(shell.horizonCosine(node.altitude));
        for (int part = 0; part < kParts; ++part)
          node.density[part] = float(medium.profiles[part].at(node.altitude));
        path.nodes.push_back(node);
      }
      for (int i = 0; i < n; ++i)
        for (int part = 0; part < kParts; ++part) {
          double upTo = 0;
          for (int j = 0; j < n; ++j)
            upTo += rule.upTo[std::size_t(i) * n + j] * double(path.nodes[first + j].density[part]);
          path.nodes[first + i].length[part] = float(passed[part] + upTo * length);
        }
      for (int i = 0; i < n; ++i)
        for (int part = 0; part < kParts; ++part)
          passed[part] +=
              rule.rule.weights[i] * length * double(path.nodes[first + i].density[part]);
    }
  }
done:
  for (int part = 0; part < kParts; ++part) path.length[part] = float(passed[part]);
  return path;
}

}  // namespace lambent::sky
