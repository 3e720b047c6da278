// Twilight for models that know none: how much of the light at sunset is left.
#pragma once

namespace lambent::sky {

/// 1 with the Sun on the horizon or above it; below it the illuminance of a clear sky relative to
/// that at an elevation of 0° (a measured mean: 760 lx), which falls to 4.5·10⁻³ at −6°, 1.1·10⁻⁵
/// at −12° and 8.5·10⁻⁷ at −18°. Monotone, continuous, with a continuous slope below the horizon.
/// Elevations below −18° (rad here as everywhere) count as −18°.
///
/// An analytic sky multiplied by this is right in its level to a factor of two or so; its pattern
/// and its colour remain those of sunset: no earth's shadow, no purple light. What is simulated has
/// both.
double twilightFactor(double sunElevation);

}  // namespace lambent::sky
