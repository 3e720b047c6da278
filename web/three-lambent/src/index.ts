/**
 * Relights assets that carry LAMBENT_radiance_transfer, in three.js.
 *
 * Directions and positions are in glTF's space: right-handed, +Y up, metres. Radiance is linear RGB
 * with Rec. 709 primaries, W m⁻² sr⁻¹. Spherical harmonics are real and orthonormal, polar axis +z,
 * positive signs, index l(l+1)+m; n bands have n² coefficients.
 *
 * @packageDocumentation
 */
export {
  lambentOf,
  LambentLoaderPlugin,
  type LambentGLTF,
  type LambentLoaderOptions,
} from "./loader-plugin.js";
export { LambentAsset } from "./asset/asset.js";
export type { AssetInfo, AssetKind } from "./asset/info.js";
export type { AirOptions } from "./asset/asset-air.js";
export type { TransferChoice } from "./asset/choices.js";
export type { LambentNodes } from "./gpu/nodes.js";
export type { AnyRenderer, NodeRenderer } from "./gpu/renderer.js";
export type { IncidentMode } from "./asset/asset-source.js";
export { LambentFormatError } from "./format/description.js";
export {
  LambentLight,
  type DirectionLike,
  type Disc,
  type QuaternionLike,
  type Rgb,
  type WindowName,
} from "./light/light.js";
export { kLargestSun, sunOf, sunPoints, type SunPoint } from "./light/sun.js";
export type { EquirectangularImage } from "./light/equirectangular.js";
export { kMostDiscs, type Environment, type EnvironmentSky } from "./materials/environment.js";
export { EnvironmentBackground } from "./output/background.js";
export { ToneMapper } from "./output/tone-mapper.js";
export { filmic, srgbDecode, srgbEncode, toneGlsl, type ToneCurve } from "./output/tone.js";
export { fitClipping, frameAutomatically, subpixelPositions } from "./output/camera.js";
export { bandOf, coefficientCount, evaluateHarmonics, kMaxBands } from "./sh/basis.js";
export { HarmonicRotation, matrixOfQuaternion } from "./sh/rotation.js";
export { capMoments, clampedCosineMoments, phongLobeMoments, sharpestNonNegative, turnZonal } from "./sh/zonal.js";
export {
  polynomialDeltaT,
  refraction,
  sunAngularRadius,
  sunIrradianceScale,
  sunPosition,
  worldDirection,
  type Air,
  type SunPosition,
} from "./sky/sun_position.js";
export { LambentSky, Sky, type SkyModel, type SkyRequest, type SkySun } from "./sky/sky.js";
export { AerialPerspective, LambentAir, type AirBetween } from "./sky/air.js";
export {
  hannWindow,
  lanczosWindow,
  leastSofteningOfZonal,
  leastSofteningWindow,
  minimalRingingWindow,
} from "./sh/window.js";
