// What is changed in a document while it is written, and taken back afterwards.

import {
  Primitive,
  PropertyType,
  type Accessor,
  type Document,
  type Extension,
  type TypedArray,
} from "@gltf-transform/core";

/** Changes of a document that are taken back once it is written. */
export class Changes {
  private readonly undos: (() => void)[] = [];
  private readonly replaced = new Set<Accessor>();

  constructor(private readonly document: Document) {}

  /** Calls `change`, and `back` when all is undone. */
  make(change: () => void, back: () => void): void {
    this.undos.push(back);
    change();
  }

  private accessor(array: TypedArray, type: "SCALAR" | "VEC2" | "VEC3", like: Accessor | null) {
    const buffer = like?.getBuffer() ?? this.document.getRoot().listBuffers()[0] ?? null;
    const made = this.document.createAccessor("", buffer).setType(type).setArray(array);
    this.undos.push(() => made.dispose());
    return made;
  }

  /** An attribute of a primitive, for now; null: without it. */
  setAttribute(primitive: Primitive, semantic: string, array: Float32Array | null): void {
    const before = primitive.getAttribute(semantic);
    const like = before ?? primitive.getAttribute("POSITION");
    const type = semantic.startsWith("TEXCOORD") ? "VEC2" : "VEC3";
    this.undos.push(() => primitive.setAttribute(semantic, this.restored(before)));
    primitive.setAttribute(semantic, array && this.accessor(array, type, like));
    if (before) this.replaced.add(before);
  }

  setIndices(primitive: Primitive, array: Uint16Array | Uint32Array): void {
    const before = primitive.getIndices();
    this.undos.push(() => primitive.setIndices(this.restored(before)));
    primitive.setIndices(this.accessor(array, "SCALAR", primitive.getAttribute("POSITION")));
    if (before) this.replaced.add(before);
  }

  private readonly copies = new Map<Accessor, Accessor>();

  private restored(accessor: Accessor | null): Accessor | null {
    return accessor && (this.copies.get(accessor) ?? accessor);
  }

  /** Takes out of the document what was replaced and has no other use: it would be written. */
  removeReplaced(): void {
    for (const accessor of this.replaced) {
      if (accessor.listParents().some((p) => p.propertyType !== PropertyType.ROOT)) continue;
      const array = accessor.getArray();
      const content = {
        ...{ name: accessor.getName(), buffer: accessor.getBuffer(), type: accessor.getType() },
        ...{ normalized: accessor.getNormalized(), sparse: accessor.getSparse() },
        extras: accessor.getExtras(),
      };
      const back = () => {
        const copy = this.document
          .createAccessor(content.name, content.buffer)
          .setType(content.type)
          .setArray(array)
          .setNormalized(content.normalized)
          .setSparse(content.sparse)
          .setExtras(content.extras);
        this.copies.set(accessor, copy);
      };
      this.make(() => accessor.dispose(), back);
    }
  }

  undo(): void {
    for (const step of this.undos.splice(0).reverse()) step();
  }
}

/**
 * EXT_meshopt_compression may round normals, which transfer stands on, and turn triangles, which
 * have to match where there are two sides. It does neither with other options, and where it does
 * not know that indices are triangles.
 */
export function keepFromMeshopt(
  document: Document,
  changes: Changes,
  twoSided: readonly Primitive[],
): void {
  const meshopt = document
    .getRoot()
    .listExtensionsUsed()
    .find(({ extensionName }) => extensionName === "EXT_meshopt_compression") as
    | (Extension & {
        setEncoderOptions(options: { method?: string }): unknown;
        _encoderOptions?: { method?: string };
      })
    | undefined;
  if (!meshopt) return;
  const before = { ...meshopt._encoderOptions };
  changes.make(
    () => meshopt.setEncoderOptions({ ...before, method: "quantize" }),
    () => meshopt.setEncoderOptions(before),
  );
  for (const primitive of twoSided)
    changes.make(
      () => primitive.setMode(Primitive.Mode.LINES),
      () => primitive.setMode(Primitive.Mode.TRIANGLES),
    );
}
