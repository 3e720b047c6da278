// The light of a state, in the few hundred numbers that relight an asset. What a frame costs does
// not depend on the environment's pixels nor on the asset.
//
// This work is based on:
// - sloan2002precomputed: §6, a light is projected once; a turn of it is a turn of its
// coefficients.
#pragma once

#include "lambent/light/environment.h"
#include "lambent/light/sun.h"
#include "lambent/sh/coefficients.h"
#include "lambent/shade/sharp_sun.h"
#include "lambent/view/view_state.h"

namespace lambent::view {

class StateLight {
 public:
  /// Projects the environment: the one step that looks at its pixels.
  StateLight(const light::Environment& environment, int bands);

  /// Environment (turned) and discs (in closed form), softened by the state's window, in the
  /// world's frame. Kept until one of these changes.
  const sh::RgbCoefficients& world(const ViewState& state);
  /// The same in the asset's frame: what multiplies its transfer.
  sh::RgbCoefficients asset(const ViewState& state);

  /// The Sun of that light, in the asset's frame, where the state wants its shadows sharp and there
  /// is one: environment's or a disc of the state's.
  std::optional<shade::SharpSun> sharpSun(const ViewState& state);

  int bands() const { return environment_.bands; }

 private:
  sh::RgbCoefficients environment_;  ///< as it stands before any turn
  std::optional<light::Sun> sun_;    ///< the environment's, as it stands there
  std::optional<sh::RgbCoefficients> world_;
  std::vector<double> factors_;  ///< of world_'s window, band by band
  /// What world_ was made from.
  std::array<double, 4> rotation_{};
  std::vector<Disc> discs_;
  std::string window_;
};

}  // namespace lambent::view
