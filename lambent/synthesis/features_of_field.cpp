#include "lambent/synthesis/features_of_field.h"

#include <algorithm>
#include <numeric>

#include "lambent/synthesis/feature_lines.h"

namespace lambent::synthesis {

std::vector<Feature> featuresOf(const scene::Mesh& mesh, const Manifold& m,
                                const TangentPlanes& p) {
  std::vector<Feature> features;
  for (const FeatureLine& line : featureLines(mesh, m)) {
    Feature& feature = features.emplace_back();
    feature.length = line.length;
    for (const auto& [h, reversed] : line.steps) {
      const auto place = [&](std::uint32_t corner) {
        return mesh.positions[mesh.triangles[corner / 3][corner % 3]];
      };
      const double half = 0.5 * double((place(Manifold::next(h)) - place(h)).norm());
      const double back = reversed ? kPi : 0.0;
      feature.ends.push_back({m.vertexOfCorner[h], p.atTail(h) + back, half});
      feature.ends.push_back({m.vertexOfCorner[Manifold::next(h)], p.atHead(m, h) + back, half});
    }
  }
  return features;
}

Choice choiceOf(const Feature& feature, const TangentPlanes& p, const Eigen::VectorXcd& base) {
  Choice choice;
  double best = -2.0, next = -2.0;
  for (int quarters = 0; quarters < 4 / std::gcd(4, p.turns); ++quarters) {
    double agreement = 0.0;
    for (const Feature::End& end : feature.ends) {
      const std::complex<double> wanted =
          std::polar(1.0, p.turns * (end.angle + 0.5 * kPi * quarters));
      agreement += end.share * (std::conj(wanted) * unitOf(base[end.vertex])).real();
    }
    agreement /= feature.length;
    next = std::max(next, std::min(agreement, best));
    if (agreement > best) best = agreement, choice.quarters = quarters;
  }
  choice.margin = best - next;
  return choice;
}

}  // namespace lambent::synthesis
