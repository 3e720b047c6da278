// What the page knows of skies: fetched once, when the first one is wanted.
import { LambentSky } from "three-lambent";
import address from "../../three-lambent/data/sky.bin?url";

let loading: Promise<LambentSky> | null = null;

export function skies(): Promise<LambentSky> {
  loading ??= LambentSky.load(address).catch((error: unknown) => {
    loading = null;
    throw error;
  });
  return loading;
}
