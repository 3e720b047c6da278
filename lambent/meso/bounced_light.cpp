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
#include <atomic>
#include <string>

#include "lambent/sh/coefficients.h"

namespace lambent::meso {

namespace {

constexpr std::size_t kFacetsPerRow = 64;  ///< that a thread takes at a time

/// What a chunk of facets met.
struct KeptHits {
  std::vector<std::uint32_t> end;    ///< of every facet of the chunk
  std::vector<std::uint32_t> facet;  ///< who lights
  std::vector<float> weight;         ///< (n·s) · 4π/directions

  std::size_t bytes() const { return 4 * (end.size() + facet.size() + weight.size()); }
};

struct Scratch {
  PeriodicCast cast;
  Irradiance irradiance;
  std::vector<double> sum;
  KeptHits again;  ///< of a chunk that was not kept
};

class Bounces {
 public:
  Bounces(const PeriodicScene& scene, const Facets& facets, const Lattice& lattice,
          const BounceOptions& options, ParallelRows& rows)
      : scene_(scene), facets_(facets), lattice_(lattice), options_(options), rows_(rows) {
    count_ = static_cast<std::size_t>(sh::coefficientCount(options.bands));
    light_.channels = facets.grey() ? 1 : 3;
    light_.stride = transport::paddedRow(light_.channels * count_);
    directStride_ = transport::paddedRow(count_);
    chunks_ = (facets.size() + kFacetsPerRow - 1) / kFacetsPerRow;
  }

  Result<FacetLight> run() {
    if (options_.bounces == 0) return std::move(light_);
    if (!direct()) return report::cancelled();
    for (int bounce = 1; bounce < options_.bounces; ++bounce)
      if (!bounceOnce(bounce, /*last=*/false)) return report::cancelled();
    if (options_.wantBounced && !bounceOnce(options_.bounces, /*last=*/true))
      return report::cancelled();
    light_.rays = raysCast_;
    return std::move(light_);
  }

 private:
  Scratch scratch() const {
    const std::size_t wide = std::max(directStride_, light_.stride);
    return {{}, Irradiance(options_.bands), std::vector<double>(wide), {}};
  }
  /// Facets of the chunk, first to last + 1.
  std::pair<std::uint32_t, std::uint32_t> range(std::size_t chunk) const {
    return {static_cast<std::uint32_t>(chunk * kFacetsPerRow),
            static_cast<std::uint32_t>(std::min((chunk + 1) * kFacetsPerRow, facets_.size()))};
  }
  void castFrom(std::uint32_t facet, PeriodicCast& cast, KeptHits& hits) const {
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
  bool direct();
  bool bounceOnce(int bounce, bool last);
  /// ρ/π (E_direct + Σ) into a facet's row of `exit`; Σ has all channels, E_direct one.
  void store(std::uint32_t facet, const double* sum, float* exit) const;

  const PeriodicScene& scene_;
  const Facets& facets_;
  const Lattice& lattice_;
  const BounceOptions& options_;
  ParallelRows& rows_;
  std::size_t count_ = 0, directStride_ = 0, chunks_ = 0;
  FacetLight light_;
  std::vector<float> direct_;  ///< [facet][directStride_]: E_direct
  std::vector<KeptHits> kept_;
  std::atomic<std::uint64_t> raysCast_{0};
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

bool Bounces::direct() {
  direct_.assign(facets_.size() * directStride_, 0.0f);
  light_.exit.assign(facets_.size() * light_.stride, 0.0f);
  kept_.resize(chunks_);
  std::atomic<std::size_t> keptBytes{0};
  const std::uint64_t raysPerChunk = kFacetsPerRow * lattice_.directions.size() / 2;
  return rows_.run(
      "light inside the patch", chunks_, raysPerChunk, "rays", scratch(),
      [&](std::size_t chunk, Scratch& s) {
        const auto [begin, end] = range(chunk);
        KeptHits& hits = kept_[chunk];
        for (std::uint32_t f = begin; f < end; ++f) {
          const std::uint64_t before = s.cast.rays;
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
          raysCast_ += s.cast.rays - before;
        }
        const std::size_t bytes = hits.bytes();
        if (keptBytes.fetch_add(bytes) + bytes > options_.hitMemory) {
          keptBytes -= bytes;
          hits = {};
        }
      });
}

bool Bounces::bounceOnce(int bounce, bool last) {
  std::vector<float> next(light_.exit.size());
  const bool finished = rows_.run(
      "bounce " + std::to_string(bounce), chunks_, kFacetsPerRow, "facets", scratch(),
      [&](std::size_t chunk, Scratch& s) {
        const auto [begin, end] = range(chunk);
        const KeptHits* hits = &kept_[chunk];
        if (hits->end.empty()) {
          s.again.end.clear(), s.again.facet.clear(), s.again.weight.clear();
          for (std::uint32_t f = begin; f < end; ++f) castFrom(f, s.cast, s.again);
          hits = &s.again;
        }
        std::size_t from = 0;
        for (std::uint32_t f = begin; f < end; ++f) {
          const std::size_t to = hits->end[f - begin];
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
      });
  (last ? light_.bounced : light_.exit) = std::move(next);
  return finished;
}

}  // namespace

Result<FacetLight> bouncedLight(const PeriodicScene& scene, const Facets& facets,
                                const Lattice& lattice, const BounceOptions& options,
                                ParallelRows& rows) {
  return Bounces(scene, facets, lattice, options, rows).run();
}

}  // namespace lambent::meso
