// What the page knows of skies and of the air under them: fetched once, when the first one is wanted.
import { LambentAir, LambentSky } from "three-lambent";
import airAddress from "../../three-lambent/data/air.bin?url";
import skyAddress from "../../three-lambent/data/sky.bin?url";

/** What is fetched when it is first asked for; after a failure, again with the next question. */
function once<T>(load: () => Promise<T>): () => Promise<T> {
  let loading: Promise<T> | null = null;
  return () =>
    (loading ??= load().catch((error: unknown) => {
      loading = null;
      throw error;
    }));
}

export const skies = once(() => LambentSky.load(skyAddress));
export const airs = once(() => LambentAir.load(airAddress));
