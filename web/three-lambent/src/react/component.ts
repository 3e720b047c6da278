// <LambentAsset>: an asset as a component of @react-three/fiber.

import {
  createElement,
  useEffect,
  useLayoutEffect,
  useRef,
  useState,
  type ReactNode,
} from "react";
import { useFrame, useThree, type ThreeElements } from "@react-three/fiber";
import type { LambentAsset as Asset } from "../asset/asset.js";
import type { AirOptions } from "../asset/asset-air.js";
import type { Disc, LambentLight } from "../light/light.js";
import type { Environment } from "../materials/environment.js";
import type { AerialPerspective } from "../sky/air.js";
import { useLambent, type UseLambentOptions } from "./use-lambent.js";

/** Switches of the asset that are props of the same name; what is left out is as it was loaded. */
const kSwitches = [
  ...(["transfer", "macro", "viewDependent", "filter", "lobeExponent", "softLobes"] as const),
  ...(["mirrorSize", "unlit"] as const),
];
type Switches = Partial<Pick<Asset, (typeof kSwitches)[number]>>;

/** What a component does to its asset, and the props of a `<group>` around it. */
export interface RelitProps extends Switches, Omit<ThreeElements["group"], "ref"> {
  /** Light in the world: held, so that what is done to it later is followed. null: darkness. */
  light?: LambentLight | null;
  /** The light's disc whose shadows are sharp; see `LambentAsset.setSun`. */
  sun?: Disc | null;
  /** What mirrors show. */
  environment?: Environment | null;
  /** The air that the asset is seen through. */
  air?: AerialPerspective | null;
  airOptions?: AirOptions;
  /** Called once the asset is there: for what has no prop. */
  onLoad?: (asset: Asset) => void;
  children?: ReactNode;
}

export type LambentAssetProps = RelitProps &
  (
    | ({ url: string; asset?: undefined } & UseLambentOptions)
    /** An asset that somebody else loaded, and frees. null: not there yet. */
    | { asset: Asset | null; url?: undefined }
  );

/** What was never given is not set, so that the asset can say what it lacks. */
function useGiven<T>(value: T | null | undefined, set: (value: T | null) => void): void {
  const given = useRef(false);
  useLayoutEffect(() => {
    given.current ||= value !== undefined;
    if (given.current) set(value ?? null);
    // eslint-disable-next-line react-hooks/exhaustive-deps -- `set` is the same asset's
  }, [value]);
}

/** Applies props, and relights in every frame, after what had been mounted before has moved. */
function Relit({ asset, props }: { asset: Asset; props: RelitProps }): ReactNode {
  const invalidate = useThree((state) => state.invalidate);
  const [loaded] = useState(() => Object.fromEntries(kSwitches.map((key) => [key, asset[key]])));
  const { light, sun = null, environment, air = null, airOptions } = props;
  useGiven(light, (value) => asset.setLight(value));
  useLayoutEffect(() => asset.setSun(sun), [asset, sun]);
  useGiven(environment, (value) => asset.setEnvironment(value));
  useLayoutEffect(() => asset.setAir(air, airOptions), [asset, air, airOptions]);
  useLayoutEffect(() => {
    const given = props as Record<string, unknown>;
    for (const key of kSwitches) Object.assign(asset, { [key]: given[key] ?? loaded[key] });
    invalidate(); // canvases that draw on demand alone
  });
  const { onLoad } = props;
  useEffect(() => {
    onLoad?.(asset);
    // eslint-disable-next-line react-hooks/exhaustive-deps -- once for each asset
  }, [asset]);
  useFrame(({ gl, camera }) => void asset.update(gl, camera));
  return createElement("primitive", { object: asset.root, dispose: null });
}

/** Props that are the group's. */
function groupProps(props: Record<string, unknown>): Record<string, unknown> {
  const own = new Set<string>([...kSwitches, "light", "sun", "environment", "air", "airOptions"]);
  for (const key of ["onLoad", "url", "asset", "incident", "nodes", "extendLoader", "children"])
    own.add(key);
  return Object.fromEntries(Object.entries(props).filter(([key]) => !own.has(key)));
}

function Shown({ asset, props }: { asset: Asset | null; props: RelitProps }): ReactNode {
  const relit = asset && createElement(Relit, { key: asset.root.uuid, asset, props });
  return createElement(
    "group",
    groupProps(props as Record<string, unknown>),
    relit,
    props.children,
  );
}

function Loaded({ props }: { props: RelitProps & { url: string } & UseLambentOptions }): ReactNode {
  const { incident, nodes, extendLoader } = props;
  const asset = useLambent(props.url, { incident, nodes, extendLoader });
  return createElement(Shown, { asset, props });
}

/**
 * A baked asset, relit by a light:
 * `<LambentAsset url="baked.glb" light={light} rotation={[0, 1, 0]} transfer="shadowed" />`.
 *
 * Props of a group (position, rotation, onClick …) move it as a whole, in its light. With `url` it
 * loads an asset of its own and frees it when it is unmounted; nothing is shown until it is there,
 * and what fails is thrown to the nearest error boundary. With `asset` it shows one that was loaded
 * otherwise. Two components show two assets, each with a light of its own.
 */
export function LambentAsset(props: LambentAssetProps): ReactNode {
  return props.url === undefined
    ? createElement(Shown, { asset: props.asset, props })
    : createElement(Loaded, { props });
}
