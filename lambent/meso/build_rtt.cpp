// This work is based on:
// - sloan2003biscale: §4.2, "Building the RTT": the sampling plane, 2×2 supersampling with a box
//   filter, eq. (5); §5 for the grid of views.
// - shirley1997low: the map of that grid.
// - ward1988ray: final gathering of light that was computed at fewer places before.
//
//   u_p, v_p  position, view          b(u, v, s)  exit radiance per radiance from s, per steradian
//   I_k       `Images`: exit radiance under the k-th light of unit irradiance on a surface facing
//   it
//
// Where we deviate, and why. `Gather` integrates over light in the basis, at each point seen, with
// more directions than the paper has lights and different ones for each sub-sample: no light is
// missed between two of 128, and no images are kept. `Images` follows the paper, but adds I_k y_i
// da to B_i point by point: eq. (5), the box filter and the bounces are linear, so their sequence
// does not matter and the 8192 images never exist.
#include "lambent/meso/build_rtt.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <string>

#include "lambent/math/directions.h"
#include "lambent/math/random.h"
#include "lambent/math/sequences.h"
#include "lambent/meso/bounced_light.h"
#include "lambent/meso/facets.h"
#include "lambent/meso/incident_light.h"
#include "lambent/sh/basis.h"

namespace lambent::meso {

namespace {

Status check(const RttOptions& options) {
  const auto wrong = [](const char* name, long value, long low, long high) {
    return report::badUsage(std::string(name) + " is " + std::to_string(value) + ", not " +
                            std::to_string(low) + " to " + std::to_string(high));
  };
  struct Range {
    const char* name;
    int value, low, high;
  };
  for (const Range& r :
       {Range{"width", options.width, 1, 1024}, Range{"height", options.height, 1, 1024},
        Range{"views", options.views, 1, 32}, Range{"bands", options.bands, 1, sh::kMaxBands},
        Range{"bounces", options.bounces, 0, 64}, Range{"supersampling", options.supersample, 1, 8},
        Range{"directions", options.directions, 16, 16384},
        Range{"lobe directions", options.lobeDirections, 1, 4096},
        Range{"polar lights", options.polarLights, 1, 256},
        Range{"azimuth lights", options.azimuthLights, 1, 256}})
    if (r.value < r.low || r.value > r.high) return wrong(r.name, r.value, r.low, r.high);
  const double numbers = double(options.width) * options.height * options.views * options.views *
                         options.bands * options.bands * 3.0;
  if (numbers > 2e9)
    return report::badUsage("the RTT would have " +
                            std::to_string(static_cast<long long>(numbers / 1e6)) +
                            " million numbers; ask for fewer positions, views or bands");
  return Status::ok();
}

/// A sub-sample's place in its position's cell, and what it gathers with.
struct SubSample {
  Vec2 offset;  ///< in the cell, 0 … 1
  std::unique_ptr<Lattice> lattice;
  std::vector<Vec2> lobe;  ///< points of the unit square for the directions of a glossy lobe
};

struct Scratch {
  Scratch(int bands, std::size_t rowLength)
      : irradiance(bands),
        direct(rowLength),
        bounced(rowLength),
        lobe(rowLength),
        seen(rowLength),
        y(static_cast<std::size_t>(sh::coefficientCount(bands))) {}

  PeriodicCast cast;
  Irradiance irradiance;
  std::vector<double> direct, bounced, lobe, seen;  ///< rows
  std::vector<float> y, weights;
  std::vector<std::uint32_t> ids;
  std::uint32_t backs = 0;            ///< views of one position that met no front
  std::vector<double> sums;           ///< [coefficient][view][channel] of one position
  std::vector<std::uint8_t> heights;  ///< [view] of one position, as transfer::Rtt has them
  sh::ZonalMoments moments;
  float momentsOf = -1.0f;  ///< the exponent that `moments` belong to
};

class Builder {
 public:
  Builder(const PeriodicScene& scene, const Facets& facets, const RttOptions& options)
      : scene_(scene),
        facets_(facets),
        options_(options),
        count_(static_cast<std::size_t>(sh::coefficientCount(options.bands))),
        viewCount_(static_cast<std::size_t>(options.views) * options.views) {
    const int n = options.supersample;
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        SubSample sub;
        const auto number = static_cast<std::uint64_t>(j * n + i);
        sub.offset = Vec2((i + 0.5f) / n, (j + 0.5f) / n);
        sub.lattice = std::make_unique<Lattice>(
            options.directions, math::hashCombine(options.seed, number + 1), options.bands);
        for (int k = 0; k < options.lobeDirections; ++k)
          sub.lobe.push_back(math::sobol2(
              static_cast<std::uint32_t>(k),
              static_cast<std::uint32_t>(math::hashCombine(options.seed + 1, number))));
        subSamples_.push_back(std::move(sub));
      }
    if (options.method == RttMethod::Images)
      lights_ =
          std::make_unique<LightRows>(options.polarLights, options.azimuthLights, options.bands);
    for (int y = 0; y < options.views; ++y)
      for (int x = 0; x < options.views; ++x) views_.push_back(viewDirection(options.views, x, y));
  }

  Status run(const work::Runner& runner, transfer::SimulatedRtt& rtt, RttCost& cost,
             Findings& findings);

 private:
  void position(int x, int y, Scratch& scratch) const;
  void shade(const scene::SurfacePoint& point, const PeriodicHit& hit, const SubSample& sub,
             std::size_t view, Scratch& scratch) const;
  void addGlossy(const scene::SurfacePoint& point, const SubSample& sub, std::size_t view,
                 Scratch& scratch) const;
  double* sums(std::size_t view, Scratch& scratch) const { return scratch.sums.data() + view * 3; }
  /// Adds weight·value to coefficient i of a view.
  void add(double* sums, std::size_t i, const Rgb& weight, double value) const {
    for (int c = 0; c < 3; ++c) sums[i * viewCount_ * 3 + c] += weight[c] * value;
  }

  const PeriodicScene& scene_;
  const Facets& facets_;
  const RttOptions& options_;
  std::size_t count_, viewCount_;
  std::vector<Vec3> views_;
  std::vector<SubSample> subSamples_;
  std::unique_ptr<LightRows> lights_;  ///< Images
  FacetLight facetLight_;
  Vec2 size_;
};

Status Builder::run(const work::Runner& runner, transfer::SimulatedRtt& rtt, RttCost& cost,
                    Findings& findings) {
  size_ = rtt.size;
  const Lattice facetLattice(options_.directions, math::hashCombine(options_.seed, 0),
                             options_.bands);
  BounceOptions bounces;
  bounces.bands = options_.bands;
  bounces.bounces = options_.bounces;
  bounces.wantBounced = bounces.bounces > 0 && options_.method == RttMethod::Images;
  bounces.lights = lights_.get();
  Result<FacetLight> light = bouncedLight(scene_, facets_, facetLattice, bounces, runner);
  if (!light) return light.error();
  facetLight_ = std::move(*light);

  rtt.values.assign(count_ * rtt.planeSize(), 0.0f);
  if (viewCount_ > 1) rtt.heights.assign(rtt.positionCount() * viewCount_, 0);
  const std::size_t samples = viewCount_ * subSamples_.size();
  std::atomic<std::uint64_t> lightRays{facetLight_.rays}, backs{0};
  const Scratch prototype(options_.bands,
                          std::max(facetLight_.stride, transport::paddedRow(count_)));
  const Status finished = runner.run(
      {"views", "samples", samples}, work::Chunks(rtt.positionCount()), prototype,
      [&](const work::Chunk& chunk, Scratch& scratch) {
        const std::size_t at = chunk.index;
        const int x = static_cast<int>(at % rtt.width), y = static_cast<int>(at / rtt.width);
        scratch.cast.rays = 0;
        position(x, y, scratch);
        lightRays += scratch.cast.rays;
        const double share = 1.0 / static_cast<double>(subSamples_.size());
        for (std::size_t i = 0; i < count_; ++i) {
          const double* from = scratch.sums.data() + i * viewCount_ * 3;
          float* to = rtt.values.data() + i * rtt.planeSize() + at * viewCount_ * 3;
          for (std::size_t k = 0; k < viewCount_ * 3; ++k)
            to[k] = static_cast<float>(share * from[k]);
        }
        if (viewCount_ > 1)
          std::copy(scratch.heights.begin(), scratch.heights.end(),
                    rtt.heights.begin() + std::ptrdiff_t(at * viewCount_));
        backs += scratch.backs;
      });
  if (!finished) return finished.error();
  cost = {rtt.positionCount() * samples, lightRays, facets_.size(), scene_.tilesAcross()};
  if (backs * 100 > cost.viewRays)
    findings.push_back(
        {Severity::Warning, "back-faces-seen",
         std::to_string(backs * 100 / cost.viewRays) +
             "% of the views meet the back of a surface, or nothing, and are black there: the "
             "patch may be open or turned inside out, or want a backing",
         backs});
  return Status::ok();
}

void Builder::position(int x, int y, Scratch& scratch) const {
  scratch.sums.assign(count_ * viewCount_ * 3, 0.0);
  const Extent& extent = scene_.extent();
  // Above everything, by more than rounding.
  const float start = extent.highest + 0.01f * extent.depth() + scene_.offset();
  scratch.backs = 0;
  scratch.heights.assign(viewCount_, 0);
  for (std::size_t view = 0; view < viewCount_; ++view) {
    const Vec3& v = views_[view];
    float height = 0.0f;
    for (const SubSample& sub : subSamples_) {
      const Vec3 through((x + sub.offset.x()) / options_.width * size_.x(),
                         (y + sub.offset.y()) / options_.height * size_.y(), extent.middle());
      const float back = (start - extent.middle()) / v.z();
      PeriodicHit hit;
      hit.distance = (start - extent.lowest) / v.z();  // if nothing is met
      const RayEnd end = scene_.trace(through + back * v, -v, hit);
      height += start - hit.distance * v.z();
      if (end != RayEnd::Lit) {
        ++scratch.backs;
        continue;
      }
      shade(scene_.surfaceAt(hit), hit, sub, view, scratch);
    }
    height = height / static_cast<float>(subSamples_.size()) - extent.lowest;
    scratch.heights[view] = static_cast<std::uint8_t>(
        std::lround(255.0f * std::clamp(height / std::max(extent.depth(), 1e-30f), 0.0f, 1.0f)));
  }
}

/// Adds the exit radiance of a point that is seen.
void Builder::shade(const scene::SurfacePoint& point, const PeriodicHit& hit, const SubSample& sub,
                    std::size_t view, Scratch& scratch) const {
  double* out = sums(view, scratch);
  const Vec3 origin = point.position + scene_.offset() * point.geometricNormal;
  const Rgb diffuse = point.diffuse / static_cast<float>(kPi);
  const bool bouncing = !facetLight_.exit.empty();
  const int channels = facetLight_.channels;
  if (lights_) {
    scene_.castOcclusion(lights_->directions, origin, point.normal, scratch.cast);
    scratch.irradiance.fromLights(*lights_, point.normal, scratch.cast, scratch.direct.data());
    for (std::size_t i = 0; i < count_; ++i) add(out, i, diffuse, scratch.direct[i]);
    if (bouncing) {
      const float* row = facetLight_.bounced.data() + facets_.at(hit) * facetLight_.stride;
      for (std::size_t i = 0; i < count_; ++i)
        for (int c = 0; c < 3; ++c)
          out[i * viewCount_ * 3 + c] += diffuse[c] * row[(channels == 1 ? 0 : c) * count_ + i];
    }
  } else {
    if (bouncing)
      scene_.castClosest(sub.lattice->directions, origin, point.normal, scratch.cast);
    else
      scene_.castOcclusion(sub.lattice->directions, origin, point.normal, scratch.cast);
    scratch.irradiance.fromLattice(*sub.lattice, point.normal, scratch.cast, scratch.direct.data());
    for (std::size_t i = 0; i < count_; ++i) add(out, i, diffuse, scratch.direct[i]);
    if (bouncing) {
      const PeriodicCast& cast = scratch.cast;
      const auto weight = static_cast<float>(sub.lattice->directions.weight());
      scratch.ids.resize(cast.hits.size()), scratch.weights.resize(cast.hits.size());
      for (std::size_t k = 0; k < cast.hits.size(); ++k) {
        scratch.ids[k] = facets_.at(cast.hits[k]);
        scratch.weights[k] = weight * point.normal.dot(sub.lattice->directions[cast.lit[k]]);
      }
      std::fill(scratch.bounced.begin(), scratch.bounced.end(), 0.0);
      transport::addRows({facetLight_.exit.data(), facetLight_.stride}, scratch.ids,
                         scratch.weights, scratch.bounced.data());
      for (std::size_t i = 0; i < count_; ++i)
        for (int c = 0; c < 3; ++c)
          out[i * viewCount_ * 3 + c] +=
              diffuse[c] * scratch.bounced[(channels == 1 ? 0 : c) * count_ + i];
    }
  }
  if (point.glossy.maxCoeff() > 0.0f) addGlossy(point, sub, view, scratch);
}

/// k ∫ L(s) G(s, R) ds. Directions are drawn in proportion to G, so each counts k/N. What leaves is
/// summed, or what does not is taken from the whole lobe's harmonics ĝ_l y_i(R), whichever is less.
void Builder::addGlossy(const scene::SurfacePoint& point, const SubSample& sub, std::size_t view,
                        Scratch& scratch) const {
  double* out = sums(view, scratch);
  const Vec3 mirrored = math::reflectAbout(views_[view], point.normal).normalized();
  const float r = point.lobeExponent;
  if (lights_) {
    // scratch.cast still holds the lights that reach the point.
    const PeriodicCast& cast = scratch.cast;
    scratch.weights.resize(cast.visible.size());
    for (std::size_t k = 0; k < cast.visible.size(); ++k)
      scratch.weights[k] =
          math::phongLobePdf(mirrored.dot(lights_->directions[cast.visible[k]]), r);
    std::fill(scratch.lobe.begin(), scratch.lobe.end(), 0.0);
    transport::addRows(lights_->rows(), cast.visible, scratch.weights, scratch.lobe.data());
    for (std::size_t i = 0; i < count_; ++i) add(out, i, point.glossy, scratch.lobe[i]);
    if (facetLight_.exit.empty()) return;
  }
  const Mat3 frame = math::worldFromTangent(mirrored);
  const Vec3 origin = point.position + scene_.offset() * point.geometricNormal;
  const float each = 1.0f / static_cast<float>(sub.lobe.size());
  std::fill(scratch.lobe.begin(), scratch.lobe.end(), 0.0);  // what leaves
  std::fill(scratch.seen.begin(), scratch.seen.end(), 0.0);  // what does not
  scratch.ids.clear();
  std::size_t escaped = 0;
  for (const Vec2& u : sub.lobe) {
    const Vec3 s = (frame * math::phongLobe(u, r)).normalized();
    sh::evaluate(options_.bands, s, std::span<float>(scratch.y));
    RayEnd end = RayEnd::Blocked;
    if (s.dot(point.normal) > 0.0f) {
      PeriodicHit hit;
      end = scene_.trace(origin, s, hit);
      ++scratch.cast.rays;
      if (end == RayEnd::Lit) scratch.ids.push_back(facets_.at(hit));
    }
    std::vector<double>& side = end == RayEnd::Escaped ? scratch.lobe : scratch.seen;
    for (std::size_t i = 0; i < count_; ++i) side[i] += each * scratch.y[i];
    escaped += end == RayEnd::Escaped;
  }
  if (!lights_) {
    if (2 * escaped > sub.lobe.size()) {
      if (scratch.momentsOf != r) {
        scratch.moments = sh::phongLobe(options_.bands, r);
        scratch.momentsOf = r;
      }
      sh::turnTo(scratch.moments, Vec3d(mirrored.cast<double>().normalized()),
                 std::span<double>(scratch.lobe.data(), count_));
      for (std::size_t i = 0; i < count_; ++i) scratch.lobe[i] -= scratch.seen[i];
    }
    for (std::size_t i = 0; i < count_; ++i) add(out, i, point.glossy, scratch.lobe[i]);
  }
  if (facetLight_.exit.empty()) return;
  scratch.weights.assign(scratch.ids.size(), each);
  std::fill(scratch.bounced.begin(), scratch.bounced.end(), 0.0);
  transport::addRows({facetLight_.exit.data(), facetLight_.stride}, scratch.ids, scratch.weights,
                     scratch.bounced.data());
  for (std::size_t i = 0; i < count_; ++i)
    for (int c = 0; c < 3; ++c)
      out[i * viewCount_ * 3 + c] +=
          point.glossy[c] * scratch.bounced[(facetLight_.channels == 1 ? 0 : c) * count_ + i];
}

}  // namespace

Vec3 viewDirection(int views, int viewX, int viewY) {
  return math::hemisphereFromSquare(Vec2((viewX + 0.5f) / views, (viewY + 0.5f) / views));
}

Result<WithFindings<transfer::SimulatedRtt>> buildRtt(const Patch& patch, const RttOptions& options,
                                                      const Progress& progress, RttCost* cost) {
  if (Status sane = check(options); !sane) return sane.error();
  Result<Findings> sound = check(patch);
  if (!sound) return sound.error();
  Findings findings = std::move(*sound);
  // Measured on a weave (docs/reproduction.md): at 20° above a surface 0.29 of the period deep, 8
  // views a side, read by their heights, are 3% off. Fewer lie so far apart that what one shows is
  // hidden from the next.
  const float relief = extentOf(patch).depth() / patch.size.minCoeff();
  if (options.views > 1 && options.views < 8 && relief > 0.2f)
    findings.push_back({Severity::Note, "few-views",
                        "the patch is " + std::to_string(int(std::lround(100.0f * relief))) +
                            "% of its period deep: seen at grazing angles, " +
                            std::to_string(options.views) + "x" + std::to_string(options.views) +
                            " views of it blur into each other. 8x8 would not, for more memory",
                        1});
  const Result<PeriodicScene> scene = PeriodicScene::build(patch, options.blockTriangles);
  if (!scene) return scene.error();

  transfer::SimulatedRtt rtt;
  rtt.name = patch.name;
  rtt.width = options.width, rtt.height = options.height;
  rtt.views = options.views, rtt.bands = options.bands;
  rtt.size = patch.size;
  rtt.depth = extentOf(patch).depth();
  // Light that is gathered once more may lie coarser than light that is seen as it lies.
  const float spacing = (options.method == RttMethod::Gather ? 2.0f : 1.0f) *
                        std::min(patch.size.x() / options.width, patch.size.y() / options.height);
  const Facets facets(*scene, spacing);
  const work::Runner runner(progress, options.threads);
  Builder builder(*scene, facets, options);
  RttCost ignored;
  if (Status done = builder.run(runner, rtt, cost ? *cost : ignored, findings); !done)
    return done.error();
  return WithFindings<transfer::SimulatedRtt>{std::move(rtt), std::move(findings)};
}

}  // namespace lambent::meso
