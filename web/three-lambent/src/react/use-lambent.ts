// Loading for components: every one that is mounted has an asset of its own, and frees it.

import { useEffect, useState } from "react";
import { useThree } from "@react-three/fiber";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";
import type { LambentAsset as Asset } from "../asset/asset.js";
import { LambentLoaderPlugin, type LambentLoaderOptions } from "../loader-plugin.js";

export interface UseLambentOptions extends LambentLoaderOptions {
  /** Gives the loader what else the file needs: a decoder for meshopt, KTX2, a manager. */
  extendLoader?: (loader: GLTFLoader) => void;
}

/** For loaders that others make, as drei's `useGLTF(url, true, true, extendLambent)`. */
export function extendLambent(loader: {
  // Of three's GLTFLoader, or of a copy of it with types of its own.
  register(plugin: (parser: any) => any): unknown;
}): void {
  loader.register((parser) => new LambentLoaderPlugin(parser));
}

type State = { url: string; asset: Asset | null; error: unknown };

/**
 * The asset at `url`, null until it is there. It belongs to the component, which frees it when it
 * is unmounted or given another URL. What `options` say counts when loading begins.
 *
 * @throws in rendering, for the nearest error boundary, what failed: the network, a damaged file
 *   (LambentFormatError), a glTF file without transfer
 */
export function useLambent(url: string, options: UseLambentOptions = {}): Asset | null {
  const invalidate = useThree((state) => state.invalidate);
  const [state, setState] = useState<State>({ url, asset: null, error: null });
  useEffect(() => {
    let wanted = true;
    let mine: Asset | null = null;
    const loader = new GLTFLoader();
    loader.register((parser) => new LambentLoaderPlugin(parser, options));
    options.extendLoader?.(loader);
    loader
      .loadAsync(url)
      .then((gltf) => {
        const asset = gltf.userData.lambent as Asset | undefined;
        if (!asset) throw new Error(`${url} carries no transfer: run \`lambent bake\` on it first`);
        if (!wanted) return asset.dispose();
        mine = asset;
        setState({ url, asset, error: null });
        invalidate();
      })
      .catch((error: unknown) => {
        if (wanted) setState({ url, asset: null, error });
      });
    return () => {
      wanted = false;
      mine?.dispose();
    };
    // eslint-disable-next-line react-hooks/exhaustive-deps -- options are read once
  }, [url]);
  if (state.url !== url) return null;
  if (state.error) throw state.error;
  return state.asset;
}
