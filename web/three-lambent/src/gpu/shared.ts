// What instances of one asset have in common on a renderer's GPU: made when the first of them asks
// for it, freed when the last one has given it back.

export interface Disposable {
  dispose(): void;
}

export class SharedThings {
  private readonly held = new Map<string, { thing: Disposable; users: number }>();

  take<T extends Disposable>(name: string, make: () => T): T {
    let found = this.held.get(name);
    if (!found) {
      found = { thing: make(), users: 0 };
      this.held.set(name, found);
    }
    ++found.users;
    return found.thing as T;
  }

  give(name: string): void {
    const found = this.held.get(name);
    if (!found || --found.users > 0) return;
    this.held.delete(name);
    found.thing.dispose();
  }
}

/** What one user has taken. */
export class Lease {
  private readonly names = new Map<string, Disposable>();

  constructor(private readonly things: SharedThings) {}

  /** The same name is the same thing. */
  take<T extends Disposable>(name: string, make: () => T): T {
    let thing = this.names.get(name) as T | undefined;
    if (!thing) {
      thing = this.things.take(name, make);
      this.names.set(name, thing);
    }
    return thing;
  }

  release(): void {
    for (const name of this.names.keys()) this.things.give(name);
    this.names.clear();
  }
}
