// Fields as simulated ⇄ fields as stored: one map over their numbers.
#pragma once

#include "lambent/transfer/field.h"
#include "lambent/transfer/numbers.h"

namespace lambent::transfer {

/// How the numbers of a field are stored. Snorm8: vectors have a scale for each channel of a
/// receiver, matrices one for each matrix.
struct Encodings {
  Encodings(Encoding all) : surfaces(all), biScale(all) {}  // NOLINT: implicit
  Encodings(Encoding ofSurfaces, Encoding ofBiScale) : surfaces(ofSurfaces), biScale(ofBiScale) {}
  Encoding surfaces;  ///< vectors and glossy matrices
  Encoding biScale;   ///< matrices into tangent frames
};

EncodedField encode(const SimulatedField& field, const Encodings& encodings);
SimulatedField decode(const EncodedField& field);

/// Snorm8: one scale for each coefficient.
EncodedRtt encode(const Rtt<Floats>& rtt, Encoding encoding);
Rtt<Floats> decode(const EncodedRtt& rtt);

}  // namespace lambent::transfer
