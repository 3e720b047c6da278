// The list of what can be opened without dropping a file: manifest.json beside the page, which
// `lambent view --web` extends by what was named on the command line.

export interface AssetEntry {
  name: string;
  /** Relative to the page. */
  file: string;
  /** Members of a view that suit the asset. */
  view?: Record<string, unknown>;
}

export interface EnvironmentEntry {
  name: string;
  /** As the tool takes it. */
  source: string;
  /** What to fetch for each term of the source that is a file. */
  files: Record<string, string>;
}

export interface Manifest {
  assets: AssetEntry[];
  environments: EnvironmentEntry[];
}

export async function fetchManifest(): Promise<Manifest> {
  const response = await fetch("manifest.json");
  if (!response.ok) throw new Error(`manifest.json: the server answers ${response.status}`);
  const json = (await response.json()) as Partial<Manifest>;
  if (!Array.isArray(json.assets) || !Array.isArray(json.environments))
    throw new Error("manifest.json: not the list that this page comes with. Build it again");
  return { assets: json.assets, environments: json.environments };
}
