// How texels are spread. Where the mean squared error of a chart is k d⁻ᵖ at a density of d texels
// a metre, the sum of error times area over all charts is least, for a given number of texels,
// where d ∝ k^(1/(p+2)). The error of a step in the light falls with p = 1, that of a curve with p
// = 4; penumbras lie between them, and rounds are few: p = 2.
#include "lambent/texel_layout/lay_out.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <string>
#include <utility>

#include "lambent/atlas/charted_surface.h"
#include "lambent/macro/interpolation_error.h"
#include "lambent/scene/shapes.h"
#include "lambent/scene/sheets.h"
#include "lambent/texel_layout/beyond_borders.h"

namespace lambent::texel_layout {

namespace {

constexpr float kMaximumStretch = 1.5f;
constexpr int kRounds = 3;         ///< in which densities follow the error
constexpr double kCoarse = 0.125;  ///< share of the budget that the first grids get
constexpr double kPower = 2.0;     ///< p
constexpr double kMostFiner = 8.0, kMostCoarser = 0.5;  ///< than in the round before
constexpr double kLeastOfFirst = 0.5;  ///< of the first grids' density, whatever the error
constexpr double kUsed = 0.68;         ///< share of a grid that charts cover, but for their gutters
constexpr double kLeastOfChart = 36.0;          ///< texels of a grid, with its gutter
constexpr int kSmallest = 4, kLargest = 16384;  ///< sides of grids
constexpr int kMostAttempts = 3;                ///< at packings of one round
constexpr int kMostAgain = 32;                  ///< with smallest sides that grow each time
/// So many places speak for a chart's error by the whole mesh's, where it has few of its own.
constexpr double kOfWholeMesh = 1.0;
/// The share of its places that a chart is judged by: those where it errs most.
constexpr double kWorst = 0.125;

/// A mesh on its way.
struct Laying {
  std::uint32_t mesh = 0;
  scene::Mesh source;  ///< what is laid out of it: its front, where it has backs
  int sides = 1;       ///< that lie beside each other in its grid
  atlas::ChartedSurface charted;
  std::vector<double> densities;  ///< [chart], texels a metre: wanted, and then as packed
  atlas::Atlas packed;
  int size = 0;
  int smallest = kSmallest;  ///< side that has room for all charts, as far as is known
  double margin = 0.0;       ///< texels a side that gutters take, as far as is known

  /// Texels that its charts cover at these densities.
  double texels(const std::vector<double>& at) const {
    double sum = 0.0;
    for (std::size_t c = 0; c < at.size(); ++c) sum += charted.charts[c].area * at[c] * at[c];
    return sum;
  }
  double gridOf(double side) const { return sides * side * side; }  ///< texels
  double sideFor(double texels) const {
    return std::max(double(smallest), margin + std::sqrt(texels / kUsed));
  }
};

/// What was found at places of a chart: e².
class ChartError {
 public:
  void add(double squared) { squares_.push_back(squared); }
  double sum() const { return std::accumulate(squares_.begin(), squares_.end(), 0.0); }
  double count() const { return double(squares_.size()); }
  /// The mean where it is largest: a shadow at the foot of a thing is not to be outvoted by a floor
  /// around it. Where few places speak, `otherwise` speaks too.
  double worst(double otherwise) const {
    std::vector<double> largest = squares_;
    std::sort(largest.begin(), largest.end(), std::greater<>());
    largest.resize(std::size_t(std::ceil(kWorst * count())));
    const double sum = std::accumulate(largest.begin(), largest.end(), 0.0);
    return std::max(0.0, sum + kOfWholeMesh * otherwise) / (double(largest.size()) + kOfWholeMesh);
  }

 private:
  std::vector<double> squares_;
};

double meanOf(const std::vector<ChartError>& charts) {
  double sum = 0.0, count = 0.0;
  for (const ChartError& chart : charts) sum += chart.sum(), count += chart.count();
  return std::max(0.0, sum) / std::max(1.0, count);
}

/// The same beyond the borders of the back, in a grid that is twice as wide.
std::vector<transport::TexelBeyond> onBothSides(const std::vector<transport::TexelBeyond>& front,
                                                std::uint32_t size) {
  std::vector<transport::TexelBeyond> both;
  for (const auto& [texel, point] : front) {
    const std::uint32_t there = texel / size * 2 * size + texel % size;
    both.push_back({there, point});
    both.push_back({there + size, point});
    both.back().point.normal = -point.normal;
    both.back().point.geometricNormal = -point.geometricNormal;
  }
  return both;
}

class Layout {
 public:
  Layout(const scene::Scene& scene, const trace::RayScene& rays, const LayoutOptions& options,
         const Progress& progress)
      : scene_(scene), rays_(rays), options_(options), progress_(progress) {}

  Result<WithFindings<LaidOutScene>> run(std::span<const std::uint32_t> meshes) {
    for (const std::uint32_t m : meshes) {
      Laying laying;
      laying.mesh = m;
      laying.source = scene_.meshes[m];
      laying.source.texelUvs.clear();
      if (scene::hasBacks(laying.source)) {
        laying.sides = 2;
        laying.source.triangles.resize(laying.source.triangles.size() / 2);
        scene::dropUnusedVertices(laying.source);
      }
      const scene::Mesh& source = laying.source;
      auto charted =
          atlas::chartedSurface(source, smoothSurface(source), kMaximumStretch, progress_);
      // Of facets each would be a chart: better a crease in a chart than no room.
      if (charted && double(charted->charts.size()) * kLeastOfChart * double(meshes.size()) >
                         double(options_.budget))
        charted =
            atlas::chartedSurface(source, atlas::weldedSurface(source), kMaximumStretch, progress_);
      if (!charted) return charted.error();
      laying.charted = std::move(*charted);
      layings_.push_back(std::move(laying));
    }
    if (Status s = begin(); !s) return s.error();
    for (int round = 0; options_.error && round < kRounds && !layings_.empty(); ++round) {
      const auto errors = measure();
      if (!errors) return errors.error();
      follow(*errors);
      if (Status s = packAll(double(options_.budget)); !s) return s.error();
    }
    LaidOutScene out;
    if (options_.error && !layings_.empty()) {
      const auto errors = measure();
      if (!errors) return errors.error();
      double sum = 0.0, count = 0.0, worst = 0.0;
      for (const auto& charts : *errors)
        for (const ChartError& chart : charts) {
          sum += chart.sum(), count += chart.count();
          worst = std::max(worst, chart.worst(meanOf(charts)));
        }
      out.error = std::sqrt(std::max(0.0, sum / std::max(1.0, count)));
      out.worst = std::sqrt(worst);
    }
    auto [laid, grids] = place();
    out.scene = std::move(laid), out.grids = std::move(grids);
    out.spent = spent_;
    for (const Laying& laying : layings_) {
      const auto [low, high] =
          std::minmax_element(laying.densities.begin(), laying.densities.end());
      out.meshes.push_back({laying.mesh, laying.packed.charts, laying.size, *high, *low});
      out.texels += std::size_t(laying.gridOf(laying.size));
    }
    return WithFindings<LaidOutScene>{std::move(out), std::move(findings_)};
  }

 private:
  /// The same density everywhere: coarsely, where the error is asked next.
  Status begin() {
    double area = 0.0;
    for (const Laying& laying : layings_) area += laying.sides * laying.charted.surface.area;
    const double budget = double(options_.budget) * (options_.error ? kCoarse : 1.0);
    const double density = std::sqrt(kUsed * budget / area);
    for (Laying& laying : layings_)
      laying.margin = options_.gutter * (1.0 + std::sqrt(double(laying.charted.charts.size())));
    for (Laying& laying : layings_) laying.densities.assign(laying.charted.charts.size(), density);
    leastDensity_ = kLeastOfFirst * density;
    return packAll(budget);
  }

  /// Packs `laying` on a grid of that side, or of the next larger one that has room. False if the
  /// whole budget has none.
  Result<bool> packOne(Laying& laying, int size) {
    for (size = std::clamp(size, laying.smallest, kLargest);;
         size = std::min(kLargest, size + std::max(1, size / 4))) {
      if (laying.gridOf(size) > double(options_.budget)) return false;
      auto packed = atlas::packedAtlas(laying.source, laying.charted, laying.densities,
                                       {size, options_.gutter}, progress_);
      if (packed) {
        laying.packed = std::move(*packed), laying.size = size;
        return true;
      }
      if (packed.error().kind != ErrorKind::BadUsage || size >= kLargest) return packed.error();
      laying.smallest = size + 1;
    }
  }

  static double sideOf(const Laying& l, double share) {
    return l.sideFor(share * l.texels(l.densities));
  }
  /// How much of what densities want fits into `budget`, at most all.
  double shareWithin(double budget) const {
    const auto total = [&](double share) {
      double sum = 0.0;
      for (const Laying& l : layings_) sum += l.gridOf(std::floor(sideOf(l, share)));
      return sum;
    };
    if (total(1.0) <= budget) return 1.0;
    double low = 0.0, high = 1.0;
    for (int k = 0; k < 40; ++k) {
      const double middle = 0.5 * (low + high);
      (total(middle) > budget ? high : low) = middle;
    }
    return low;
  }
  double packedTexels() const {
    double sum = 0.0;
    for (const Laying& l : layings_) sum += l.gridOf(l.size);
    return sum;
  }

  /// Packs all on grids as large as densities want, within `budget`; larger only where gutters
  /// leave no choice, and within the whole budget always: what has no room there is left out.
  /// Densities become what came of it.
  Status packAll(double budget) {
    for (int attempt = 0, again = 0; !layings_.empty();) {
      std::vector<std::vector<double>> wanted;
      for (const Laying& l : layings_) wanted.push_back(l.densities);
      const double share = shareWithin(budget);
      std::size_t without = layings_.size();  // the one that has no room
      for (std::size_t i = 0; i < layings_.size() && without == layings_.size(); ++i) {
        const auto packed = packOne(layings_[i], static_cast<int>(sideOf(layings_[i], share)));
        if (!packed) return packed.error();
        if (!*packed) without = i;
      }
      const bool tooMany = packedTexels() > double(options_.budget);
      if (without == layings_.size() && tooMany && shareWithin(double(options_.budget)) == 0.0)
        without = std::size_t(std::max_element(layings_.begin(), layings_.end(),
                                               [](const Laying& a, const Laying& b) {
                                                 return a.smallest < b.smallest;
                                               }) -
                              layings_.begin());
      if (without < layings_.size()) {
        leaveOut(without);
        continue;
      }
      if (tooMany && ++again < kMostAgain) continue;  // with what is known now of the smallest
      double least = 1.0;  // how dense the worst came out, of what was to be
      for (std::size_t i = 0; i < layings_.size(); ++i) {
        Laying& l = layings_[i];
        const double texels = setDensities(l);
        l.margin = l.size - std::sqrt(texels / kUsed);
        least = std::min(least, std::sqrt(texels / (share * l.texels(wanted[i]))));
      }
      if (share < 1.0 || least > 0.97 || ++attempt >= kMostAttempts) return Status::ok();
      for (std::size_t i = 0; i < layings_.size(); ++i) layings_[i].densities = wanted[i];
    }
    return Status::ok();
  }

  void leaveOut(std::size_t laying) {
    const Laying& left = layings_[laying];
    const std::string& name = left.source.name;
    findings_.push_back(
        {Severity::Note, "texels-no-room",
         (name.empty() ? "mesh " + std::to_string(left.mesh) : "mesh \"" + name + "\"") + " has " +
             std::to_string(left.charted.charts.size()) +
             " charts, for which there is no room with their gutters: it is baked at its vertices; "
             "allow more texels",
         left.charted.charts.size()});
    layings_.erase(layings_.begin() + std::ptrdiff_t(laying));
  }

  /// Of the packed charts; the texels that they cover.
  static double setDensities(Laying& l) {
    std::vector<double> flat(l.charted.charts.size(), 0.0);
    const scene::Mesh& mesh = l.packed.mesh;
    for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
      if (!l.charted.surface.hasArea(t)) continue;
      const auto [i, j, k] = mesh.triangles[t];
      const Vec2d e = (mesh.uvs[j] - mesh.uvs[i]).cast<double>() * l.size;
      const Vec2d f = (mesh.uvs[k] - mesh.uvs[i]).cast<double>() * l.size;
      flat[l.packed.chartOfTriangle[t]] += 0.5 * std::abs(e.x() * f.y() - e.y() * f.x());
    }
    double sum = 0.0;
    for (std::size_t c = 0; c < flat.size(); ++c) {
      l.densities[c] = std::sqrt(std::max(flat[c], 1e-6) / l.charted.charts[c].area);
      sum += flat[c];
    }
    return sum;
  }

  /// The scene with what was packed, and its grids.
  std::pair<scene::Scene, std::vector<transport::TexelGrid>> place() const {
    std::pair<scene::Scene, std::vector<transport::TexelGrid>> out;
    out.first = scene_;
    for (const Laying& l : layings_) {
      const scene::Mesh& from = l.source;
      scene::Mesh& to = out.first.meshes[l.mesh];
      to = l.packed.mesh;
      if (!from.uvs.empty()) {
        to.texelUvs = std::move(to.uvs);
        to.uvs.clear();
        for (const std::uint32_t v : l.packed.sourceVertex) to.uvs.push_back(from.uvs[v]);
      } else if (to.source.uvSet = -1; scene::materialOf(out.first, to).baseColorTexture >= 0) {
        // Without coordinates the texture was not there: it must not come with those of texels.
        scene::Material bare = scene::materialOf(out.first, to);
        bare.baseColorTexture = -1;
        to.material = int(out.first.materials.size());
        out.first.materials.push_back(std::move(bare));
      }
      transport::TexelGrid& grid = out.second.emplace_back();
      grid.mesh = l.mesh, grid.width = l.sides * l.size, grid.height = l.size;
      grid.beyond = beyondBorders(out.first, l.mesh, l.charted.surface, l.size);
      if (l.sides == 1) continue;
      grid.beyond = onBothSides(grid.beyond, static_cast<std::uint32_t>(l.size));
      to = scene::withBacks(std::move(to));
      scene::layOutBacks(to);
    }
    return out;
  }

  /// [laid-out mesh][chart]
  Result<std::vector<std::vector<ChartError>>> measure() {
    auto [laid, grids] = place();
    const transport::Placement placement{std::move(grids), {}};
    const auto receivers = transport::placeReceivers(laid, placement, rays_.offset());
    if (!receivers) return receivers.error();
    std::vector<bool> isLookedAt(scene_.meshes.size(), false);
    std::vector<std::size_t> layingOf(scene_.meshes.size(), 0);
    std::size_t charts = 0;
    std::vector<std::vector<ChartError>> errors;
    for (std::size_t i = 0; i < layings_.size(); ++i) {
      isLookedAt[layings_[i].mesh] = true, layingOf[layings_[i].mesh] = i;
      charts += layings_[i].charted.charts.size();
      errors.emplace_back(layings_[i].charted.charts.size());
    }
    macro::InterpolationErrorOptions look;
    look.samples = std::clamp<std::size_t>(8 * charts, 2048, 8192);
    look.seed = options_.seed, look.threads = options_.threads, look.withNormals = true;
    const auto places = macro::placeErrors(laid, rays_, *receivers, isLookedAt, look, progress_);
    if (!places) return places.error();
    for (const macro::PlaceError& place : *places) {
      const std::size_t i = layingOf[place.mesh];
      const auto& chartOf = layings_[i].charted.chartOfTriangle;  // of the front
      const std::uint32_t chart = chartOf[place.triangle % chartOf.size()];
      if (!place.squared || chart == atlas::kNoTriangle) continue;
      errors[i][chart].add(*place.squared);
    }
    return errors;
  }

  /// Densities by the error at those that there are.
  void follow(const std::vector<std::vector<ChartError>>& errors) {
    struct Chart {
      std::size_t laying;
      double* density;
      double area, weight, least, most;
    };
    std::vector<Chart> charts;
    for (std::size_t i = 0; i < layings_.size(); ++i) {
      Laying& l = layings_[i];
      const double mean = meanOf(errors[i]);
      for (std::size_t c = 0; c < l.densities.size(); ++c) {
        const double squared = errors[i][c].worst(mean), density = l.densities[c];
        const double wanted = std::pow(squared / (*options_.error * *options_.error), 1.0 / kPower);
        charts.push_back({i, &l.densities[c], l.charted.charts[c].area,
                          std::pow(squared * std::pow(density, kPower), 1.0 / (kPower + 2.0)),
                          std::min(density, leastDensity_),
                          density * std::clamp(wanted, kMostCoarser, kMostFiner)});
        charts.back().most = std::max(charts.back().least, charts.back().most);
      }
    }
    const auto densityAt = [](const Chart& chart, double factor) {
      return std::clamp(factor * chart.weight, chart.least, chart.most);
    };
    const auto texelsAt = [&](double factor) {
      std::vector<double> covered(layings_.size(), 0.0);
      for (const Chart& chart : charts)
        covered[chart.laying] += chart.area * std::pow(densityAt(chart, factor), 2);
      double sum = 0.0;
      for (std::size_t i = 0; i < layings_.size(); ++i)
        sum += layings_[i].gridOf(layings_[i].sideFor(covered[i]));
      return sum;
    };
    double low = 1e-6, high = 1e12;
    spent_ = texelsAt(high) > double(options_.budget);
    for (int k = 0; spent_ && k < 100; ++k) {
      const double middle = std::sqrt(low * high);
      (texelsAt(middle) > double(options_.budget) ? high : low) = middle;
    }
    for (const Chart& chart : charts) *chart.density = densityAt(chart, spent_ ? low : high);
  }

  const scene::Scene& scene_;
  const trace::RayScene& rays_;
  const LayoutOptions& options_;
  const Progress& progress_;
  std::vector<Laying> layings_;
  double leastDensity_ = 0.0;  ///< texels a metre
  bool spent_ = false;
  Findings findings_;
};

}  // namespace

Result<WithFindings<LaidOutScene>> layOut(const scene::Scene& scene,
                                          std::span<const std::uint32_t> meshes,
                                          const trace::RayScene& rays, const LayoutOptions& options,
                                          const Progress& progress) {
  if (options.budget < std::size_t(kSmallest) * kSmallest)
    return report::badUsage("a budget of " + std::to_string(options.budget) +
                            " texels has room for nothing");
  if (options.error && !(*options.error > 0.0 && std::isfinite(*options.error)))
    return report::badUsage("the error to lay out to is " + std::to_string(*options.error) +
                            ", not above 0");
  if (options.gutter < 2 || options.gutter > 256)
    return report::badUsage("gutters of texels must be 2 to 256 wide");
  return Layout(scene, rays, options, progress).run(meshes);
}

}  // namespace lambent::texel_layout
