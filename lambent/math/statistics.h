// Mean and variance of numbers as they come.
#pragma once

#include <cmath>
#include <cstdint>

namespace lambent::math {

/// Welford's running mean and variance (welford1962note); merge() joins two runs
/// (chan1983algorithms eq. 2.1), so that parts may be made in parallel and joined in a fixed
/// sequence.
class RunningMoments {
 public:
  void add(double x) {
    ++count_;
    const double delta = x - mean_;
    mean_ += delta / static_cast<double>(count_);
    squares_ += delta * (x - mean_);
  }
  void merge(const RunningMoments& other) {
    if (other.count_ == 0) return;
    const double total = static_cast<double>(count_ + other.count_);
    const double delta = other.mean_ - mean_;
    squares_ += other.squares_ + delta * delta * static_cast<double>(count_) *
                                     static_cast<double>(other.count_) / total;
    mean_ += delta * static_cast<double>(other.count_) / total;
    count_ += other.count_;
  }
  std::uint64_t count() const { return count_; }
  double mean() const { return mean_; }
  /// Unbiased estimate of the variance of one number; 0 for fewer than two.
  double variance() const { return count_ < 2 ? 0 : squares_ / static_cast<double>(count_ - 1); }
  /// Standard error of the mean.
  double standardError() const {
    return count_ < 2 ? 0 : std::sqrt(variance() / static_cast<double>(count_));
  }

 private:
  std::uint64_t count_ = 0;
  double mean_ = 0, squares_ = 0;
};

}  // namespace lambent::math
