/**
 * Assets of Lambent in @react-three/fiber.
 *
 * @packageDocumentation
 */
export { LambentAsset, type LambentAssetProps, type RelitProps } from "./component.js";
export { extendLambent, useLambent, type UseLambentOptions } from "./use-lambent.js";
