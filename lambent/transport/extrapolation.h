// Rows of receivers that stand where nobody sees them, such that rows between them and others are
// right where somebody does.
#pragma once

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "lambent/transport/row_system.h"

namespace lambent::transport {

/// At a place of a surface its row is interpolated: Σ_k w_k M_k over receivers k, some of which are
/// wanted. What it should be is known, for a receiver of its own, the witness, stands there.
struct Interpolated {
  std::uint32_t witness;
  std::vector<std::pair<std::uint32_t, float>> weights;  ///< receiver, w: each once
};

/// A wanted receiver whose row is the mean of others', known before it.
struct Mean {
  std::uint32_t receiver;
  std::vector<std::uint32_t> of;
};

/// The rows M_b that minimise Σ_s |Σ_k w_k(s) M_k − M_s|² + λ Σ_b |M_b − P_b|² over places s, with
/// P_b the mean of the witnesses around b. It is the same for every column of the rows, so it is
/// solved at once. Where little of a surface is seen, rows beyond are free to be anything: λ keeps
/// them near what is seen.
class Extrapolation {
 public:
  Extrapolation() = default;
  /// `wanted[r]`: whether receiver r is. Every place interpolates from a wanted one at least, and
  /// none from a receiver of another mesh than its witness.
  Extrapolation(std::span<const std::uint8_t> wanted, std::vector<Interpolated> places,
                std::vector<Mean> means);

  /// Sets the rows of wanted receivers, from those of all others. `rowOf[r]` is the number of the
  /// row of receiver r, or kNoRow where it has none, as all of its mesh; empty: r itself.
  void fill(RowsToFill rows, std::span<const std::uint32_t> rowOf = {}) const;

 private:
  RowSystem system_;  ///< of the wanted receivers of places
  std::vector<Mean> means_;
};

}  // namespace lambent::transport
