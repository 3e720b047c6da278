// Many paths → means with error bars. The paths of a pixel or point come in batches; paths of one
// batch are stratified against each other, batches are independent, and the variance of the mean is
// taken between batches: stratification can only make it smaller than it would be between paths,
// and never makes it lie.
//
// Every pixel and every point has its own random numbers and its own sums, so the result has the
// same bytes whatever the number of threads.
#include "lambent/reference/path_tracer.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <limits>
#include <mutex>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "lambent/reference/integrator.h"
#include "lambent/trace/ray_scene.h"

namespace lambent::reference {
namespace {

// Few enough for strata to help, enough for the variance to be known within some 37 percent.
constexpr int kBatches = 16;
constexpr int kBlock = 64;  ///< pixels or points that a thread takes at a time

struct Plan {
  int batches, pathsPerBatch;
};

/// Below two paths for each batch there is nothing to stratify, and every path is a batch.
Plan plan(int samples) {
  if (samples < 2 * kBatches) return {samples, 1};
  return {kBatches, (samples + kBatches - 1) / kBatches};
}

/// Mean and variance of the mean over batches.
template <int N>
class BatchMoments {
 public:
  using Value = Eigen::Array<double, N, 1>;
  void add(const Value& x) {
    ++count_;
    const Value delta = x - mean_;
    mean_ += delta / count_;
    squares_ += delta * (x - mean_);
  }
  Value mean() const { return mean_; }
  Value varianceOfMean() const {
    if (count_ < 2) return Value::Constant(std::numeric_limits<double>::infinity());
    return squares_ / (double(count_ - 1) * count_);
  }

 private:
  int count_ = 0;
  Value mean_ = Value::Zero(), squares_ = Value::Zero();
};

/// Runs body(i) for i in 0 … count−1 in parallel; false if the listener asked to stop.
template <class Body>
bool forAll(std::int64_t count, std::string_view unit, int threads, const Progress& progress,
            const Body& body) {
  using Clock = std::chrono::steady_clock;
  std::atomic<std::int64_t> done = 0;
  std::atomic<bool> stop = false;
  std::mutex speaking;
  Clock::time_point spoken = Clock::now();
  const auto say = [&](std::int64_t finished) {
    if (!progress({.stage = "path tracing",
                   .done = std::uint64_t(finished),
                   .total = std::uint64_t(count),
                   .unit = unit}))
      stop = true;
  };
  const auto run = [&] {
    tbb::parallel_for(std::int64_t(0), (count + kBlock - 1) / kBlock, [&](std::int64_t block) {
      if (stop) return;
      {
        const trace::FlushDenormals flush;
        const std::int64_t end = std::min(count, (block + 1) * kBlock);
        for (std::int64_t i = block * kBlock; i < end; ++i) body(i);
        done += end - block * kBlock;
      }
      if (!progress) return;
      const std::unique_lock lock(speaking, std::try_to_lock);
      if (!lock.owns_lock() || Clock::now() - spoken < std::chrono::milliseconds(100)) return;
      say(done);
      spoken = Clock::now();
    });
  };
  if (progress) say(0);
  if (stop) return false;
  const int most = tbb::info::default_concurrency();
  tbb::task_arena(threads > 0 ? std::min(threads, most) : most).execute(run);
  if (progress && !stop) say(count);
  return !stop;
}

Status check(const PathTraceOptions& options) {
  if (options.samples < 1)
    return report::badUsage("path tracing needs at least 1 sample, for example 64");
  if (options.bounces < 0)
    return report::badUsage("the number of bounces cannot be negative; 0 is direct light only");
  return Status::ok();
}

}  // namespace

Result<Picture> picture(const scene::Scene& scene, const trace::RayScene& rays,
                        const light::Environment& environment, const scene::Camera& camera,
                        int width, int height, const PathTraceOptions& options,
                        const Progress& progress) {
  if (const Status status = check(options); !status) return status.error();
  constexpr int kLargest = 1 << 15;
  if (width < 1 || height < 1 || width > kLargest || height > kLargest)
    return report::badUsage("a picture's width and height are from 1 to 32768 pixels");
  const auto [batches, pathsPerBatch] = plan(options.samples);
  const Integrator integrator(scene, rays, environment, options);
  Picture out{image::Image(width, height), image::Image(width, height)};
  out.mean.alpha.resize(out.mean.pixels.size());

  const bool whole = forAll(
      std::int64_t(width) * height, "pixels", options.threads, progress, [&](std::int64_t pixel) {
        const auto x = float(pixel % width), y = float(pixel / width);
        BatchMoments<3> radiance;
        double coverage = 0;
        for (int batch = 0; batch < batches; ++batch) {
          Eigen::Array3d sum = Eigen::Array3d::Zero();
          for (int path = 0; path < pathsPerBatch; ++path) {
            Sampler sampler(options.seed, std::uint64_t(pixel), std::uint64_t(batch),
                            std::uint32_t(path));
            const Vec2 place = sampler.next();
            const scene::Ray ray =
                scene::cameraRay(camera, width, height, x + place.x(), y + place.y());
            const Integrator::Seen seen = integrator.seen(ray, sampler);
            sum += seen.radiance.cast<double>();
            coverage += double(seen.coverage);
          }
          radiance.add(sum / pathsPerBatch);
        }
        const auto at = std::size_t(pixel);
        out.mean.pixels[at] = radiance.mean().cast<float>();
        out.variance.pixels[at] = radiance.varianceOfMean().cast<float>();
        out.mean.alpha[at] = float(coverage / (double(batches) * pathsPerBatch));
      });
  if (!whole) return report::cancelled();
  if (options.background) out.mean.alpha.clear();
  return out;
}

Result<std::vector<Estimate>> exitRadiance(const scene::Scene& scene, const trace::RayScene& rays,
                                           const light::Environment& environment,
                                           std::span<const Probe> probes,
                                           const PathTraceOptions& options,
                                           const Progress& progress) {
  if (const Status status = check(options); !status) return status.error();
  const auto [batches, pathsPerBatch] = plan(options.samples);
  const Integrator integrator(scene, rays, environment, options);
  std::vector<Estimate> out(probes.size());
  const bool whole =
      forAll(std::int64_t(probes.size()), "points", options.threads, progress, [&](std::int64_t i) {
        const Probe& probe = probes[std::size_t(i)];
        BatchMoments<3> radiance;
        for (int batch = 0; batch < batches; ++batch) {
          Eigen::Array3d sum = Eigen::Array3d::Zero();
          for (int path = 0; path < pathsPerBatch; ++path) {
            Sampler sampler(options.seed, std::uint64_t(i), std::uint64_t(batch),
                            std::uint32_t(path));
            sum += integrator.leaving(probe.point, probe.toViewer, sampler).cast<double>();
          }
          radiance.add(sum / pathsPerBatch);
        }
        out[std::size_t(i)] = {radiance.mean().cast<float>(),
                               radiance.varianceOfMean().cast<float>()};
      });
  if (!whole) return report::cancelled();
  return out;
}

}  // namespace lambent::reference
