// This work is based on:
// - ford1956flow: the least cost is that of the largest flow from nodes that are cheaper on the
//   first side to those that are cheaper on the second.
// - dinitz1970flow: that is found in rounds, each of which uses up all ways that are shortest.
#include "lambent/math/min_cut.h"

#include <algorithm>
#include <cassert>

namespace lambent::math {
namespace {

double sane(double cost) {
  return cost > 0.0 ? cost : 0.0;
}

}  // namespace

MinCut::MinCut(std::uint32_t nodes) : surplus_(nodes, 0.0) {}

void MinCut::addNode(std::uint32_t node, double onFirst, double onSecond) {
  assert(node < surplus_.size());
  onFirst_ += sane(onFirst);
  surplus_[node] += sane(onSecond) - sane(onFirst);
}

void MinCut::addLink(std::uint32_t a, std::uint32_t b, double ab, double ba) {
  assert(a < surplus_.size() && b < surplus_.size() && a != b);
  ends_.insert(ends_.end(), {a, b});
  costs_.insert(costs_.end(), {sane(ab), sane(ba)});
}

void MinCut::makeArcs() {
  begin_.assign(surplus_.size() + 1, 0);
  for (const std::uint32_t end : ends_) ++begin_[end + 1];
  for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
  arcs_.resize(ends_.size());
  std::vector<std::uint32_t> fill(begin_.begin(), begin_.end() - 1);
  for (std::size_t k = 0; k < ends_.size(); k += 2) {
    const std::uint32_t i = fill[ends_[k]]++, j = fill[ends_[k + 1]]++;
    arcs_[i] = {ends_[k + 1], j, costs_[k]};
    arcs_[j] = {ends_[k], i, costs_[k + 1]};
  }
}

/// Measures the way from all nodes that have something to give; whether one that takes is reached.
bool MinCut::reachEnds() {
  std::fill(depth_.begin(), depth_.end(), -1);
  queue_.clear();
  for (std::uint32_t v = 0; v < surplus_.size(); ++v)
    if (surplus_[v] > 0.0) depth_[v] = 0, queue_.push_back(v);
  bool reached = false;
  for (std::size_t k = 0; k < queue_.size(); ++k) {
    const std::uint32_t v = queue_[k];
    reached = reached || surplus_[v] < 0.0;
    for (std::uint32_t i = begin_[v]; i < begin_[v + 1]; ++i) {
      const Arc& arc = arcs_[i];
      if (arc.left > 0.0 && depth_[arc.to] < 0)
        depth_[arc.to] = depth_[v] + 1, queue_.push_back(arc.to);
    }
  }
  return reached;
}

/// Sends what `start` has along ways that lead away from where all began, until it has nothing left
/// or there is none; returns how much.
double MinCut::pushFrom(std::uint32_t start) {
  double pushed = 0.0;
  path_.clear();
  std::uint32_t v = start;
  while (surplus_[start] > 0.0) {
    if (surplus_[v] < 0.0) {
      double flow = std::min(surplus_[start], -surplus_[v]);
      for (const std::uint32_t i : path_) flow = std::min(flow, arcs_[i].left);
      surplus_[start] -= flow, surplus_[v] += flow, pushed += flow;
      // On from before the first arc that is used up.
      std::size_t kept = path_.size();
      for (std::size_t k = path_.size(); k-- > 0;) {
        Arc& arc = arcs_[path_[k]];
        arc.left -= flow, arcs_[arc.back].left += flow;
        if (!(arc.left > 0.0)) kept = k;
      }
      if (kept < path_.size()) v = arcs_[arcs_[path_[kept]].back].to, path_.resize(kept);
      continue;
    }
    std::uint32_t& i = next_[v];
    while (i < begin_[v + 1] && !(arcs_[i].left > 0.0 && depth_[arcs_[i].to] == depth_[v] + 1)) ++i;
    if (i < begin_[v + 1]) {
      path_.push_back(i);
      v = arcs_[i].to;
    } else if (path_.empty()) {
      break;
    } else {  // a dead end
      v = arcs_[arcs_[path_.back()].back].to;
      path_.pop_back();
      ++next_[v];
    }
  }
  return pushed;
}

double MinCut::solve() {
  makeArcs();
  depth_.resize(surplus_.size());
  double cost = onFirst_;
  for (const double s : surplus_) cost += std::min(s, 0.0);
  while (reachEnds()) {
    next_.assign(begin_.begin(), begin_.end() - 1);
    for (const std::uint32_t v : std::vector<std::uint32_t>(queue_))
      if (depth_[v] == 0) cost += pushFrom(v);
  }
  return cost;
}

}  // namespace lambent::math
