// This work is based on:
// - sloan2003biscale: §4.2, "conventional global illumination" inside of the patch.
// - sloan2002precomputed: §5, the diffuse rule of the interreflection passes,
//     (M_p)^b_i += (ρ_p/π) (1−V_p) (M_q)^{b−1}_i H_N(s_d),
//   here in sums: exit_b = ρ/π (E_direct + K exit_{b−1}), which needs no row for each bounce.
//
// Where we deviate, and why. Light is kept on facets instead of vertices: a hit then names its row
// by itself, and corners where walls meet need no normal. In bounces a glossy surface counts as a
// diffuse one that reflects as much; its lobe is traced only where the eye sees it.
#include "lambent/meso/bounced_light.h"

#include <algorithm>
#include <numeric>
#include <string>

#include "lambent/sh/coefficients.h"
#include "lambent/transport/kept_hits.h"

namespace lambent::meso {

namespace {

constexpr std::size_t kFacetsPerChunk = 64;  ///< that a thread takes at a time

/// What a chunk of facets met.
struct FacetHits {
  std::vector<std::uint32_t> end;    ///< of every facet of the chunk
  std::vector<std::uint32_t> facet;  ///< who lights
  std::vector<float> weight;         ///< (n·s) · 4π/directions

  std::size_t bytes() const { return 4 * (end.size() + facet.size() + weight.size()); }
  void shrink() { end.shrink_to_fit(), facet.shrink_to_fit(), weight.shrink_to_fit(); }
  void clear() { end.clear(), facet.clear(), weight.clear(); }
};
using KeptHits = transport::KeptHits<FacetHits>;

struct BounceScratch {
  PeriodicCast cast;
  Irradiance irradiance;
  std::vector<double> sum;
  FacetHits again;  ///< of a chunk that was not kept
};

class Bounces {
 public:
  Bounces(const PeriodicScene& scene, const Facets& facets, const Lattice& lattice,
          const BounceOptions& options, const work::Runner& runner)
      : scene_(scene),
        facets_(facets),
        lattice_(lattice),
        options_(options),
        runner_(runner),
        chunks_(facets.size(), kFacetsPerChunk),
        kept_(chunks_.range(), options.hitMemory) {
    count_ = static_cast<std::size_t>(sh::coefficientCount(options.bands));
    light_.channels = facets.grey() ? 1 : 3;
    light_.stride = transport::paddedRow(light_.channels * count_);
    directStride_ = transport::paddedRow(count_);
  }

  Result<FacetLight> run() {
    if (options_.bounces == 0) return std::move(light_);
    if (Status done = direct(); !done) return done.error();
    for (int bounce = 1; bounce < options_.bounces; ++bounce)
      if (Status done = bounceOnce(bounce, /*last=*/false); !done) return done.error();
    if (options_.wantBounced)
      if (Status done = bounceOnce(options_.bounces, /*last=*/true); !done) return done.error();
    return std::move(light_);
  }

 private:
  BounceScratch scratch() const {
    const std::size_t wide = std::max(directStride_, light_.stride);
    return {{}, Irradiance(options_.bands), std::vector<double>(wide), {}};
  }
  void castFrom(std::uint32_t facet, PeriodicCast& cast, FacetHits& hits) const {
    const scene::SurfacePoint& point = facets_.point(facet);
    scene_.castClosest(lattice_.directions, origin(point), point.normal, cast);
    const auto weight = static_cast<float>(lattice_.directions.weight());
    for (std::size_t k = 0; k < cast.hits.size(); ++k) {
      hits.facet.push_back(facets_.at(cast.hits[k]));
      hits.weight.push_back(weight * point.normal.dot(lattice_.directions[cast.lit[k]]));
    }
    hits.end.push_back(static_cast<std::uint32_t>(hits.facet.size()));
  }
  Vec3 origin(const scene::SurfacePoint& point) const {
    return point.position + scene_.offset() * point.geometricNormal;
  }
  Status direct();
  Status bounceOnce(int bounce, bool last);
  /// ρ/π (E_direct + Σ) into a facet's row of `exit`; Σ has all channels, E_direct one.
  void store(std::uint32_t facet, const double* sum, float* exit) const;

  const PeriodicScene& scene_;
  const Facets& facets_;
  const Lattice& lattice_;
  const BounceOptions& options_;
  const work::Runner& runner_;
  work::Chunks chunks_;
  std::size_t count_ = 0, directStride_ = 0;
  FacetLight light_;
  std::vector<float> direct_;  ///< [facet][directStride_]: E_direct
  KeptHits kept_;
};

void Bounces::store(std::uint32_t facet, const double* sum, float* exit) const {
  const Rgb albedo = facets_.albedo(facet);
  const float* direct = direct_.data() + facet * directStride_;
  float* row = exit + facet * light_.stride;
  for (int c = 0; c < light_.channels; ++c)
    for (std::size_t i = 0; i < count_; ++i) {
      const double gathered = direct[i] + (sum ? sum[c * count_ + i] : 0.0);
      row[c * count_ + i] = static_cast<float>(albedo[c] / kPi * gathered);
    }
}

Status Bounces::direct() {
  direct_.assign(facets_.size() * directStride_, 0.0f);
  light_.exit.assign(facets_.size() * light_.stride, 0.0f);
  const work::Stage stage{"light inside the patch", "rays",
                          static_cast<std::uint64_t>(lattice_.directions.size()) / 2};
  const auto gather = [&](const work::Chunk& chunk, BounceScratch& s) {
    FacetHits hits;
    const std::uint64_t before = s.cast.rays;
    for (auto f = static_cast<std::uint32_t>(chunk.begin); f < chunk.end; ++f) {
      const scene::SurfacePoint& point = facets_.point(f);
      castFrom(f, s.cast, hits);
      if (options_.lights) {
        scene_.castOcclusion(options_.lights->directions, origin(point), point.normal, s.cast);
        s.irradiance.fromLights(*options_.lights, point.normal, s.cast, s.sum.data());
      } else {
        s.irradiance.fromLattice(lattice_, point.normal, s.cast, s.sum.data());
      }
      for (std::size_t i = 0; i < count_; ++i)
        direct_[f * directStride_ + i] = static_cast<float>(s.sum[i]);
      store(f, nullptr, light_.exit.data());
    }
    kept_.keep(chunk.index, std::move(hits));
    return s.cast.rays - before;
  };
  const auto rays = runner_.map(stage, chunks_, scratch(), gather);
  if (!rays) return rays.error();
  light_.rays = std::accumulate(rays->begin(), rays->end(), std::uint64_t(0));
  return Status::ok();
}

Status Bounces::bounceOnce(int bounce, bool last) {
  std::vector<float> next(light_.exit.size());
  const std::string name = "bounce " + std::to_string(bounce);
  const auto gather = [&](const work::Chunk& chunk, BounceScratch& s) {
    const FacetHits* hits = kept_.of(chunk.index);
    if (!hits) {
      s.again.clear();
      for (auto f = static_cast<std::uint32_t>(chunk.begin); f < chunk.end; ++f)
        castFrom(f, s.cast, s.again);
      hits = &s.again;
    }
    std::size_t from = 0;
    for (auto f = static_cast<std::uint32_t>(chunk.begin); f < chunk.end; ++f) {
      const std::size_t to = hits->end[f - chunk.begin];
      std::fill(s.sum.begin(), s.sum.end(), 0.0);
      transport::addRows({light_.exit.data(), light_.stride},
                         std::span(hits->facet).subspan(from, to - from),
                         std::span(hits->weight).subspan(from, to - from), s.sum.data());
      from = to;
      if (!last) {
        store(f, s.sum.data(), next.data());
        continue;
      }
      for (std::size_t k = 0; k < light_.stride; ++k)
        next[f * light_.stride + k] = static_cast<float>(s.sum[k]);
    }
  };
  const Status finished = runner_.run({name, "facets"}, chunks_, scratch(), gather);
  (last ? light_.bounced : light_.exit) = std::move(next);
  return finished;
}

}  // namespace

Result<FacetLight> bouncedLight(const PeriodicScene& scene, const Facets& facets,
                                const Lattice& lattice, const BounceOptions& options,
                                const work::Runner& runner) {
  return Bounces(scene, facets, lattice, options, runner).run();
}

}  // namespace lambent::meso
