// Private to this room: what is wrong with numbers and receivers, in the words of all its messages.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lambent/scene/scene.h"
#include "lambent/transfer/numbers.h"
#include "lambent/transfer/receivers.h"
#include "lambent/transfer/surface.h"

namespace lambent::asset {

/// What is wrong, or nothing.
using Wrong = std::optional<std::string>;

/// Lengths and angles of tangents may be this far from 1 and 0.
inline constexpr float kTangentLength = 1e-3f, kTangentLean = 1e-2f;

bool bandsInRange(int bands);
bool channelsInRange(int channels);
std::string text(std::uint64_t value);

/// The first number that is NaN or infinite.
std::optional<std::size_t> firstNonFinite(const transfer::Numbers& numbers);
std::optional<std::size_t> firstNonFinite(std::span<const Vec3> vectors);

/// `name` is for messages. What the numbers of so many receivers have to be.
Wrong faultOf(const transfer::Vectors<transfer::Numbers>& vectors, std::size_t receivers,
              const std::string& name);
Wrong faultOf(const transfer::Matrices<transfer::Numbers>& matrices, std::size_t receivers,
              const std::string& name);
/// Whether the scales of snorm8 numbers cover them, run by run.
Wrong faultOfScales(const transfer::Numbers& numbers, const std::string& name);

/// Where they stand, against the mesh that they belong to.
Wrong faultOf(const transfer::Receivers& receivers, const scene::Mesh& mesh);

}  // namespace lambent::asset
