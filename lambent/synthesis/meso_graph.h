// Which vertices of a meso-mesh's level are next to each other, and how one gets from each to the
// next, both ways: of nearest neighbours, one may be the other's and not the other way round.
#pragma once

#include <algorithm>
#include <cstdint>
#include <queue>
#include <span>
#include <vector>

#include "lambent/synthesis/manifold.h"
#include "lambent/synthesis/meso_mesh.h"
#include "lambent/synthesis/similar_places.h"

namespace lambent::synthesis {

struct MesoGraph {
  struct Edge {
    std::uint32_t to;
    Vec2 offset;   ///< as of offsetsOf
    float length;  ///< metres
  };
  std::vector<std::uint32_t> begin;
  std::vector<Edge> edges;

  /// `offsets` as of offsetsOf; of each vertex's neighbours, the `nearest` count.
  MesoGraph(const MesoMesh& mesh, std::size_t level, std::span<const Vec2> offsets,
            std::uint32_t nearest = kNone);

  std::uint32_t size() const { return std::uint32_t(begin.size()) - 1; }
  /// By rising length.
  std::span<const Edge> of(std::uint32_t vertex) const {
    return {edges.data() + begin[vertex], begin[vertex + 1] - begin[vertex]};
  }

  /// Where the patch lies at a vertex by those next to it of which placeOf(vertex) gives a place,
  /// a pointer, or else null: the mean of what those expect that agree with the nearest to a tenth
  /// of a period. One of them must have a place.
  template <class PlaceOf>
  Vec2 continuedTo(std::uint32_t vertex, const PlaceOf& placeOf) const {
    constexpr float kAgree = 0.1f;
    const Vec2* first = nullptr;
    Vec2 nearest = Vec2::Zero(), sum = Vec2::Zero();
    float count = 0.0f;
    for (const Edge& e : of(vertex)) {
      const Vec2* there = placeOf(e.to);
      if (!there) continue;
      const Vec2 expected = *there - e.offset;
      if (!first) first = there, nearest = expected;
      const Vec2 d = wrapped(expected - nearest);
      if (d.cwiseAbs().maxCoeff() > kAgree) continue;
      sum += d, count += 1.0f;
    }
    return nearest + sum / count;
  }

  /// Visits vertices by rising distance over the edges: visit(vertex, from, distance) says whether
  /// to go on from there; `from` is the vertex that it was reached from, or kNone.
  class Sweep {
   public:
    explicit Sweep(const MesoGraph& graph) : graph_(graph), seen_(graph.size(), 0) {}

    /// From those given, with distance 0. Vertices that an earlier run of this sweep has visited are
    /// visited again only after forget().
    template <class Visit>
    void run(std::span<const std::uint32_t> from, const Visit& visit) {
      for (const std::uint32_t v : from) queue_.push({0.0f, v, kNone});
      while (!queue_.empty()) {
        const Reached at = queue_.top();
        queue_.pop();
        if (seen_[at.vertex] == now_) continue;
        seen_[at.vertex] = now_;
        if (!visit(at.vertex, at.from, at.distance)) continue;
        for (const Edge& e : graph_.of(at.vertex))
          if (seen_[e.to] != now_) queue_.push({at.distance + e.length, e.to, at.vertex});
      }
    }
    bool seen(std::uint32_t vertex) const { return seen_[vertex] == now_; }
    void forget() { ++now_; }

   private:
    struct Reached {
      float distance;
      std::uint32_t vertex, from;
      bool operator<(const Reached& other) const {  // the queue's top is its greatest
        return distance != other.distance ? distance > other.distance : vertex > other.vertex;
      }
    };
    const MesoGraph& graph_;
    std::vector<std::uint32_t> seen_;  ///< the run in which a vertex was visited
    std::uint32_t now_ = 1;
    std::priority_queue<Reached> queue_;
  };
};

}  // namespace lambent::synthesis
