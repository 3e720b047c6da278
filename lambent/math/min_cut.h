// The cheapest way to part the nodes of a graph in two.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lambent::math {

/// Every node falls to one of two sides. It costs what each node costs on its side and, of each
/// link whose ends fall to different sides, what that costs. Costs are finite; NaN and those below 0
/// count as 0.
class MinCut {
 public:
  explicit MinCut(std::uint32_t nodes);

  /// Adds to what `node` costs on the first and on the second side.
  void addNode(std::uint32_t node, double onFirst, double onSecond);
  /// `ab`: where a falls to the first side and b to the second; `ba`: the other way round.
  void addLink(std::uint32_t a, std::uint32_t b, double ab, double ba);
  /// The least cost. To be asked once, after all that was added.
  double solve();
  /// After solve(). Of several cheapest ways, that with the fewest nodes on the first side.
  bool isOnFirst(std::uint32_t node) const { return depth_[node] >= 0; }

 private:
  void makeArcs();
  bool reachEnds();
  double pushFrom(std::uint32_t start);

  double onFirst_ = 0.0;             ///< were all on the first side, without links
  std::vector<double> surplus_;      ///< of each node: what more the second side costs
  std::vector<std::uint32_t> ends_;  ///< a, b of each link
  std::vector<double> costs_;        ///< ab, ba of each link
  /// From each node on, [begin_[node], begin_[node + 1]): what may still flow along a link, and
  /// which arc is its way back.
  struct Arc {
    std::uint32_t to, back;
    double left;
  };
  std::vector<std::uint32_t> begin_;
  std::vector<Arc> arcs_;
  std::vector<std::uint32_t> next_;  ///< of each node, the first arc not yet used up in a round
  std::vector<int> depth_;           ///< steps from where something may still flow from; −1: none
  std::vector<std::uint32_t> queue_, path_;  ///< buffers: nodes; arcs
};

}  // namespace lambent::math
