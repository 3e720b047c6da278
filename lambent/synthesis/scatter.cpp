// This work is based on:
// - praun2000lapped: pieces of a texture that overlap cover a surface, each grown from its centre.
// - kwatra2003graphcut (§3): where two overlap, the cheapest cut between them is found; what it costs
//   from one vertex to the next is how unlike the two look at both.
// - lempitsky2010fusion: so that what lies on a surface is joined with one proposal after the other.
// - lefebvre2005parallel (§3): randomness enters at coarse levels.
//
// Where we deviate: a cut costs more where it parts a piece of the patch, or where it joins two: two
// halves of pebbles of one colour look alike, and are still halves.
#include "lambent/synthesis/scatter.h"

#include <algorithm>
#include <cmath>

#include "lambent/math/min_cut.h"
#include "lambent/math/random.h"
#include "lambent/work/parallel_for.h"
#include "lambent/work/runner.h"

namespace lambent::synthesis {
namespace {

constexpr float kBeyond = 0.4f;   ///< that a cell reaches beyond its border, of its width
constexpr float kCore = 0.5f;     ///< of the way from its centre to its border that stays its own
constexpr float kLength = 0.02f;  ///< cost of any cut, in standard deviations of the looks
/// Cost of a parted piece, where pieces leave room between them for a way round, and where they lie
/// close: there what is between them would be left in shreds.
constexpr float kParted = 40.0f, kPartedClose = 1.0f;
constexpr int kRounds = 2, kTries = 40;  ///< of mending, and of each place
constexpr float kReach = 0.45f;          ///< of a piece that mends, in periods

struct Member {
  std::uint32_t vertex;
  Vec2 way;  ///< from the centre, in periods
};

/// A piece of the patch and the part of the surface that it is nearest to.
struct Share {
  std::uint32_t centre = 0;
  float reach = 0.0f;  ///< from the centre to the furthest that is nearest to it, metres
  std::vector<Member> members;
  Vec2 place = Vec2::Zero();  ///< of the patch, at the centre
};

/// Which cell every vertex is nearest to, and how far from its centre.
struct Division {
  std::vector<Share> cells;
  std::vector<std::uint32_t> cellOf;
  std::vector<float> distance;
};

double widthOf(const ScatterOptions& options) {
  return std::sqrt(double(options.patchSize.x()) * double(options.patchSize.y())) /
         (2.0 * double(options.randomness));
}

Division cellsOf(const MesoMesh& mesh, std::size_t level, const MesoGraph& graph,
                 const ScatterOptions& options) {
  const double wanted = double(mesh.area) / (widthOf(options) * widthOf(options));
  // The coarsest level that has enough vertices is evenly spread; thinned by chance.
  std::size_t source = 0;
  while (source < level && double(mesh.levelEnd[source]) < wanted) ++source;
  const double chance = wanted / double(mesh.levelEnd[source]);
  std::vector<std::uint32_t> centres;
  for (std::uint32_t v = 0; v < mesh.levelEnd[source]; ++v)
    if (math::Random(options.seed, v, 0xce11u).uniformDouble() < chance) centres.push_back(v);
  Division all;
  all.cellOf.resize(graph.size()), all.distance.resize(graph.size());
  MesoGraph::Sweep sweep(graph);
  const auto visit = [&](std::uint32_t v, std::uint32_t from, float distance) {
    if (from == kNone) all.cells.emplace_back().centre = v;
    const std::uint32_t c = from == kNone ? std::uint32_t(all.cells.size() - 1) : all.cellOf[from];
    all.cellOf[v] = c, all.distance[v] = distance;
    all.cells[c].reach = std::max(all.cells[c].reach, distance);
    return true;
  };
  sweep.run(centres, visit);
  for (std::uint32_t v = 0; v < graph.size(); ++v)  // components without a centre
    if (!sweep.seen(v)) sweep.run({{v}}, visit);
  return all;
}

/// Lays the patch from a vertex on.
class Growth {
 public:
  explicit Growth(const MesoGraph& graph) : graph_(graph), sweep_(graph), way_(graph.size()) {}

  std::vector<Member> from(std::uint32_t centre, float reach) {
    std::vector<Member> members;
    sweep_.forget();
    sweep_.run({{centre}}, [&](std::uint32_t v, std::uint32_t before, float distance) {
      if (distance > reach) return false;
      way_[v] = before == kNone ? Vec2(Vec2::Zero()) : graph_.continuedTo(v, [&](std::uint32_t j) {
        return sweep_.seen(j) ? &way_[j] : nullptr;
      });
      members.push_back({v, way_[v]});
      return true;
    });
    return members;
  }

 private:
  const MesoGraph& graph_;
  MesoGraph::Sweep sweep_;
  std::vector<Vec2> way_;
};

/// Lays every cell's piece, beyond its border.
void grow(const MesoGraph& graph, double width, std::vector<Share>& cells) {
  (void)work::Runner().run({}, work::Chunks(cells.size(), 1), Growth(graph),
                           [&](const work::Chunk& chunk, Growth& growth) {
                             for (std::size_t c = chunk.begin; c < chunk.end; ++c)
                               cells[c].members = growth.from(
                                   cells[c].centre, cells[c].reach + float(kBeyond * width));
                           });
}

/// Draws the place that each cell jumps to.
void chooseJumps(const PatchLevel& patch, const ScatterOptions& options, const std::vector<Vec2>& q,
                 std::vector<Share>& cells) {
  constexpr float kApart = 0.12f;  // of places from each other, in periods
  constexpr int kPlaces = 24;      // that a jump chooses among at most
  work::parallelFor(cells.size(), [&](std::size_t c) {
    const Vec2 from = q[cells[c].centre];
    std::vector<PatchLevel::Place> places = patch.mostSimilar(from, kPlaces, kApart);
    if (places.empty()) places.push_back({from, 0.0f});
    // Randomness is also how much less alike a place may be than the one most alike; a few have
    // their chance however that is, or all cells with like centres would jump alike.
    const float most = places[0].distance + 0.5f * options.randomness * patch.windowVariance();
    std::size_t alike = std::min(places.size(), std::size_t(1.5f + 8.0f * options.randomness));
    while (alike < places.size() && places[alike].distance <= most) ++alike;
    math::Random random(options.seed, cells[c].centre, 0x10b9u);
    cells[c].place = places[random.below(std::uint32_t(alike))].q;
  });
}

/// What lies on the surface, and pieces cut into it.
class Cuts {
 public:
  Cuts(const MesoGraph& graph, const PatchLevel& patch, const ScatterOptions& options,
       float spacing, const Division& cells, std::vector<Vec2>& q)
      : graph_(graph), patch_(patch), options_(options), cells_(cells), q_(q) {
    deviation_ = std::sqrt(double(patch.variance()));
    least_ = 0.15f * spacing;
    parted_ = options.pieces && options.pieces->leaveRoom() ? kParted : kPartedClose;
    local_.assign(graph.size(), kNone);
  }

  /// Cuts a cell's piece into what is there.
  void cutIn(std::uint32_t c) {
    const Share& cell = cells_.cells[c];
    cutIn(cell.members, cell.place, [&](std::uint32_t v) {
      if (!isCore(v)) return Owner::Open;
      return cells_.cellOf[v] == c ? Owner::Proposal : Owner::Present;
    });
  }
  /// A piece with the patch's place `at` at its centre, which may take any of its members or none.
  void cutIn(const std::vector<Member>& members, const Vec2& at) {
    cutIn(members, at, [](std::uint32_t) { return Owner::Open; });
  }

  bool isPiece(const Vec2& q) const { return options_.pieces && options_.pieces->at(q) >= 0; }
  /// Whether a piece of the patch is parted at a vertex.
  bool isParted(std::uint32_t v) const {
    if (!isPiece(q_[v])) return false;
    for (const MesoGraph::Edge& e : graph_.of(v)) {
      const Vec2 &a = q_[v], &b = q_[e.to];
      if (!goesOn(a, b, e) && (isPiece(a + e.offset) || isPiece(b))) return true;
    }
    return false;
  }

 private:
  enum class Owner { Open, Present, Proposal };
  struct Node {
    Vec2 proposed;
    Owner own;
    bool same, pieceThere, pieceProposed;
    double apart;  ///< of the looks of what is there and what is proposed
  };

  template <class OwnerOf>
  void cutIn(const std::vector<Member>& members, const Vec2& at, const OwnerOf& ownerOf) {
    nodes_.clear();
    for (const Member& m : members) {
      Node& node = nodes_.emplace_back();
      const std::uint32_t v = m.vertex;
      local_[v] = std::uint32_t(nodes_.size() - 1);
      node.proposed = at + m.way;
      node.own = ownerOf(v);
      node.same = metres(wrapped(node.proposed - q_[v])) <= least_;
      node.apart = node.same ? 0.0 : apart(node.proposed, q_[v]);
      node.pieceThere = isPiece(q_[v]), node.pieceProposed = isPiece(node.proposed);
    }
    math::MinCut cut(std::uint32_t(nodes_.size()));
    for (std::uint32_t i = 0; i < nodes_.size(); ++i)
      for (const MesoGraph::Edge& e : graph_.of(members[i].vertex)) {
        const std::uint32_t j = local_[e.to];
        if (j == kNone)
          addBorder(i, members[i].vertex, e, cut);
        else if (i < j)
          addPair(i, j, members[i].vertex, e, cut);
      }
    cut.solve();
    for (std::uint32_t i = 0; i < nodes_.size(); ++i) {
      const Node& node = nodes_[i];
      if (node.own == Owner::Proposal || (node.own == Owner::Open && cut.isOnFirst(i)))
        q_[members[i].vertex] = node.proposed;
      local_[members[i].vertex] = kNone;
    }
  }

  bool isCore(std::uint32_t v) const {
    return cells_.distance[v] <= kCore * cells_.cells[cells_.cellOf[v]].reach;
  }
  float metres(const Vec2& d) const { return d.cwiseProduct(options_.patchSize).norm(); }
  double apart(const Vec2& a, const Vec2& b) const {
    PatchLevel::Descriptor look;
    patch_.descriptor(b, look);
    return std::sqrt(double(patch_.distance(a, look)));
  }
  /// What a cut costs beyond unlikeness: the pieces of either side that go on over it, and those of
  /// both that meet at it.
  double parted(bool here, bool hereBeyond, bool there, bool thereBeyond) const {
    return deviation_ *
           (kLength + kParted * ((here && hereBeyond) + (there && thereBeyond) + (here && there)));
  }
  bool goesOn(const Vec2& a, const Vec2& b, const MesoGraph::Edge& e) const {
    return metres(wrapped(b - e.offset - a)) <= std::max(least_, 0.3f * e.length);
  }
  /// Between places that are next to each other.
  double cutBetween(const Vec2& a, const Vec2& b, const MesoGraph::Edge& e) const {
    if (goesOn(a, b, e)) return 0.0;
    const Vec2 onwards = a + e.offset, back = b - e.offset;
    return apart(onwards, b) + apart(back, a) +
           parted(isPiece(a), isPiece(onwards), isPiece(b), isPiece(back));
  }

  void addPair(std::uint32_t i, std::uint32_t j, std::uint32_t v, const MesoGraph::Edge& e,
               math::MinCut& cut) {
    const Node &a = nodes_[i], &b = nodes_[j];
    const Vec2 &here = q_[v], &there = q_[e.to];
    double present = 0.0, presentProposed = 0.0, proposedPresent = 0.0;
    if (!goesOn(here, there, e)) {
      present = cutBetween(here, there, e);
      presentProposed = cutBetween(here, b.proposed, e);
      proposedPresent = cutBetween(a.proposed, there, e);
    } else if (!(a.same && b.same)) {  // the same, from what is known of both
      const double unlike = a.apart + b.apart;
      presentProposed =
          unlike + parted(a.pieceThere, b.pieceThere, b.pieceProposed, a.pieceProposed);
      proposedPresent =
          unlike + parted(a.pieceProposed, b.pieceProposed, b.pieceThere, a.pieceThere);
    }
    if (a.own == Owner::Open && b.own == Owner::Open) {
      // kolmogorov2004energy (§4.1), which bears costs whose sum over the ways to part is at least
      // that of what is there. Where it is not, one of them counts as dearer than it is: whatever is
      // taken is an improvement all the same.
      const double more = present - presentProposed;
      cut.addNode(i, 0.0, presentProposed);
      cut.addNode(j, std::max(-more, 0.0), std::max(more, 0.0));
      cut.addLink(i, j, proposedPresent - more, 0.0);
    } else if (a.own == Owner::Open) {
      cut.addNode(i, b.own == Owner::Proposal ? 0.0 : proposedPresent,
                  b.own == Owner::Proposal ? presentProposed : present);
    } else if (b.own == Owner::Open) {
      cut.addNode(j, a.own == Owner::Proposal ? 0.0 : presentProposed,
                  a.own == Owner::Proposal ? proposedPresent : present);
    }
  }

  /// Towards what no proposal reaches.
  void addBorder(std::uint32_t i, std::uint32_t v, const MesoGraph::Edge& e, math::MinCut& cut) {
    const Node& a = nodes_[i];
    if (a.own == Owner::Open)
      cut.addNode(i, cutBetween(a.proposed, q_[e.to], e), cutBetween(q_[v], q_[e.to], e));
  }

  const MesoGraph& graph_;
  const PatchLevel& patch_;
  const ScatterOptions& options_;
  const Division& cells_;
  std::vector<Vec2>& q_;
  double parted_;     ///< cost of a parted piece, in deviations
  double deviation_;  ///< of looks from the mean one
  float least_;       ///< metres: places nearer to each other than that are one
  std::vector<std::uint32_t> local_;
  std::vector<Node> nodes_;
};

/// Where a piece of the patch is parted, and what may be laid anew around there.
struct Wound {
  std::uint32_t centre = 0;
  std::vector<Member> members;
  std::vector<std::uint32_t> near;  ///< the members that are to be whole
};

std::vector<Wound> woundsOf(const MesoGraph& graph, const ScatterOptions& options,
                            const Cuts& cuts) {
  const float reach = kReach * std::sqrt(options.patchSize.x() * options.patchSize.y());
  Growth growth(graph);
  std::vector<Wound> wounds;
  std::vector<std::uint8_t> isNear(graph.size(), 0);
  for (std::uint32_t v = 0; v < graph.size(); ++v) {
    if (isNear[v] || !cuts.isParted(v)) continue;
    Wound& wound = wounds.emplace_back(Wound{v, growth.from(v, reach), {}});
    for (const Member& m : wound.members) {
      if (m.way.cwiseProduct(options.patchSize).norm() >= 0.5f * reach) continue;
      wound.near.push_back(m.vertex);
      isNear[m.vertex] = 1;
    }
  }
  return wounds;
}

/// Takes from `waiting` those of which none changes what another looks at.
std::vector<const Wound*> apartFromEachOther(const MesoGraph& graph,
                                             std::vector<const Wound*>& waiting) {
  std::vector<std::uint8_t> isTaken(graph.size(), 0);
  std::vector<const Wound*> batch;
  std::erase_if(waiting, [&](const Wound* wound) {
    const auto isFree = [&](const Member& m) {
      const auto edges = graph.of(m.vertex);
      return std::none_of(edges.begin(), edges.end(),
                          [&](const MesoGraph::Edge& e) { return isTaken[e.to] != 0; });
    };
    if (!std::all_of(wound->members.begin(), wound->members.end(), isFree)) return false;
    for (const Member& m : wound->members) {
      isTaken[m.vertex] = 1;
      for (const MesoGraph::Edge& e : graph.of(m.vertex)) isTaken[e.to] = 1;
    }
    batch.push_back(wound);
    return true;
  });
  return batch;
}

/// Tries what is there and other places of the patch around a wound: in the end one piece is whole,
/// and what is left of the other has given way.
void mend(const Wound& wound, const ScatterOptions& options, int round, const std::vector<Vec2>& q,
          Cuts& cuts) {
  const auto isMended = [&] {
    return std::none_of(wound.near.begin(), wound.near.end(),
                        [&](std::uint32_t v) { return cuts.isParted(v); });
  };
  math::Random random(options.seed, wound.centre, 0x4ea1u + std::uint64_t(round));
  for (int k = 0; k < kTries && !isMended(); ++k) {
    Vec2 at = q[wound.centre];
    if (k > 0) {
      at = random.uniform2();
      // Three of four times what lies between, for what is left of a piece to give way to.
      for (int draw = 1; draw < 8 && k % 4 != 0 && cuts.isPiece(at); ++draw) at = random.uniform2();
    }
    cuts.cutIn(wound.members, at);
  }
}

Status mendAll(const MesoGraph& graph, const ScatterOptions& options, const Progress& progress,
               const Cuts& cuts, const std::vector<Vec2>& q) {
  const work::Runner runner;
  for (int round = 0; round < kRounds; ++round) {
    const std::vector<Wound> wounds = woundsOf(graph, options, cuts);
    std::vector<const Wound*> waiting;
    for (const Wound& wound : wounds) waiting.push_back(&wound);
    while (!waiting.empty()) {
      if (progress &&
          !progress({"cuts round pieces", wounds.size() - waiting.size(), wounds.size(), "pieces"}))
        return report::cancelled();
      const std::vector<const Wound*> batch = apartFromEachOther(graph, waiting);
      (void)runner.run({}, work::Chunks(batch.size(), 1), cuts,
                       [&](const work::Chunk& chunk, Cuts& own) {
                         for (std::size_t k = chunk.begin; k < chunk.end; ++k)
                           mend(*batch[k], options, round, q, own);
                       });
    }
  }
  return Status::ok();
}

}  // namespace

Status scatter(const MesoMesh& mesh, std::size_t level, const MesoGraph& graph,
               const PatchLevel& patch, const PatchLevel& coarse, const ScatterOptions& options,
               const Progress& progress, std::vector<Vec2>& q) {
  Division all;
  if (options.randomness > 0.0f) {
    all = cellsOf(mesh, level, graph, options);
    grow(graph, widthOf(options), all.cells);
    chooseJumps(coarse, options, q, all.cells);
  }
  const std::vector<Share>& cells = all.cells;
  for (std::uint32_t c = 0; c < cells.size(); ++c)
    for (const Member& m : cells[c].members)
      if (all.cellOf[m.vertex] == c) q[m.vertex] = cells[c].place + m.way;

  Cuts cuts(graph, patch, options, mesh.spacing(level), all, q);
  constexpr std::size_t kSweeps = 2;  // the second, now that cuts with all neighbours are there
  for (std::size_t k = 0; k < kSweeps * cells.size(); ++k) {
    if (progress && !progress({"cuts", k, kSweeps * cells.size(), "pieces"}))
      return report::cancelled();
    cuts.cutIn(std::uint32_t(k % cells.size()));
  }
  const bool goRound = options.pieces && options.pieces->leaveRoom();
  return goRound ? mendAll(graph, options, progress, cuts, q) : Status::ok();
}

}  // namespace lambent::synthesis
