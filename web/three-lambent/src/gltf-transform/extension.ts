// LAMBENT_radiance_transfer for glTF-Transform. Transfer belongs to vertices in their sequence, and
// tools for glTF change that sequence, join primitives, and round positions. So every vertex of a
// primitive with transfer carries, from reading to writing, an attribute that names it
// (source.ts): tools treat it like any other attribute, and when the document is written the rows
// of transfer follow it (written.ts). What cannot be right then is an error.

import {
  Document,
  Extension,
  ExtensionProperty,
  PropertyType,
  type Primitive,
  type Property,
  type ReaderContext,
  type WriterContext,
} from "@gltf-transform/core";
import { kExtensionName, kFormatMajor } from "../format/description.js";
import { fail, isObject, placeOf, withBlocks, type AccessorSource } from "./blocks.js";
import { receiversOf, sourceOf, type Bake, type Source } from "./source.js";
import { prepare, type Prepared } from "./written.js";

/**
 * The transfer of a primitive. What it holds is read-only: it can be kept, copied with its
 * primitive and removed (`primitive.setExtension("LAMBENT_radiance_transfer", null)`, with the
 * attribute `_LAMBENT_RECEIVER_…`).
 */
export class PrimitiveTransferProperty extends ExtensionProperty {
  static override readonly EXTENSION_NAME = kExtensionName;
  declare readonly extensionName: string;
  declare readonly propertyType: string;
  declare readonly parentTypes: string[];
  /** @hidden */
  source: Source | null = null;

  protected init(): void {
    Object.assign(this, {
      extensionName: kExtensionName,
      propertyType: "LambentPrimitiveTransfer",
      parentTypes: [PropertyType.PRIMITIVE],
    });
  }

  /** `"vertices"` or `"texels"`: where transfer is known. */
  getLayout(): string {
    return String(this.source?.tree.layout ?? "");
  }

  override copy(other: this, resolve?: (property: Property) => Property): this {
    super.copy(other, resolve);
    this.source = other.source;
    const document = Document.fromGraph(this.getGraph());
    const extensions = document?.getRoot().listExtensionsUsed() ?? [];
    const extension = extensions.find((e) => e instanceof LambentRadianceTransfer);
    if (this.source) extension?.keep(this.source);
    return this;
  }

  override equals(other: this, skip?: Set<string>): boolean {
    return super.equals(other, skip) && this.source === other.source;
  }
}

/** The document's object: what was simulated, of the whole document. Read-only. */
export class BakeProperty extends ExtensionProperty {
  static override readonly EXTENSION_NAME = kExtensionName;
  declare readonly extensionName: string;
  declare readonly propertyType: string;
  declare readonly parentTypes: string[];
  /** @hidden */
  bake: Bake | null = null;

  protected init(): void {
    Object.assign(this, {
      extensionName: kExtensionName,
      propertyType: "LambentBake",
      parentTypes: [PropertyType.ROOT],
    });
  }

  override copy(other: this, resolve?: (property: Property) => Property): this {
    super.copy(other, resolve);
    this.bake = other.bake;
    return this;
  }

  override equals(other: this, skip?: Set<string>): boolean {
    return super.equals(other, skip) && this.bake === other.bake;
  }
}

/** Whether an attribute holds what its name says, for every vertex. */
function hasVectors(primitive: Primitive, name: string, vertices: number): boolean {
  const accessor = primitive.getAttribute(name);
  const type = name.startsWith("TEXCOORD") ? "VEC2" : "VEC3";
  return vertices > 0 && accessor?.getCount() === vertices && accessor.getType() === type;
}

/**
 * `new NodeIO().registerExtensions([...ALL_EXTENSIONS, LambentRadianceTransfer])`.
 *
 * Reads, keeps and writes baked assets through the functions of glTF-Transform. Writing throws an
 * error that names the place and a remedy where the document has been changed so that its transfer
 * would be wrong.
 */
export class LambentRadianceTransfer extends Extension {
  static override readonly EXTENSION_NAME = kExtensionName;
  override readonly extensionName = kExtensionName;
  /**
   * Installed before anything is written: the moment at which the document takes the form that is
   * written, before other extensions compress it.
   *
   * @hidden
   */
  override readonly writeDependencies = [kExtensionName];
  /** @hidden */
  override readonly prewriteTypes = [PropertyType.BUFFER];
  private readonly sources = new Map<number, Source>();
  private prepared: Prepared | null = null;

  /** @hidden Keeps what a primitive of this document was read from. */
  keep(source: Source): void {
    this.sources.set(source.number, source);
  }

  /** @hidden */
  override read(context: ReaderContext): this {
    const { json } = context.jsonDoc;
    const root = json.extensions?.[kExtensionName];
    if (!isObject(root)) return this;
    const place = placeOf("").slice(1);
    const version = /^(\d+)\.(\d+)$/.exec(String(root.version));
    if (!version || Number(version[1]) !== kFormatMajor)
      fail(`${place}.version`, `is ${JSON.stringify(root.version)}, not ${kFormatMajor}.x`);
    const accessor: AccessorSource = (index, at) => {
      const found = Number.isInteger(index) ? context.accessors[index as number] : undefined;
      const array = found?.getArray();
      if (!found || !array)
        fail(at, `accessor ${JSON.stringify(index)} does not exist, or is empty`);
      const type = found.getType();
      if (type !== "SCALAR" && type !== "VEC3") fail(at, `holds ${type}`);
      return { array, type };
    };
    const given = new Set<Property>();
    const take: AccessorSource = (index, at) => {
      const block = accessor(index, at);
      given.add(context.accessors[index as number]);
      return block;
    };
    const tree = withBlocks(root, place, 0, take) as Record<string, unknown>;
    const bake: Bake = {
      tree,
      low: [Infinity, Infinity, Infinity],
      high: [-Infinity, -Infinity, -Infinity],
    };
    const property = new BakeProperty(this.document.getGraph());
    property.bake = bake;
    this.document.getRoot().setExtension(kExtensionName, property);
    for (const [m, mesh] of context.meshes.entries())
      for (const [p, primitive] of mesh.listPrimitives().entries()) {
        const transfer = json.meshes?.[m].primitives[p].extensions?.[kExtensionName];
        if (transfer === undefined) continue;
        const object = `meshes[${m}].primitives[${p}]`;
        const at = placeOf(object);
        if (!isObject(transfer)) fail(at, "is not an object");
        const vertices = primitive.getAttribute("POSITION")?.getCount() ?? 0;
        const uvs = isObject(transfer.grid) && transfer.grid.texCoord === 1 ? 1 : 0;
        const looked = isObject(transfer.grid) || isObject(transfer.biScale);
        for (const name of ["POSITION", "NORMAL", ...(looked ? [`TEXCOORD_${uvs}`] : [])])
          if (!hasVectors(primitive, name, vertices))
            fail(`${object}.attributes.${name}`, "is missing or incomplete, and transfer needs it");
        const indices = primitive.getIndices()?.getArray() ?? [];
        if ((indices as number[]).some((index) => index >= vertices))
          fail(`${object}.indices`, `name a vertex beyond the ${vertices} that there are`);
        const followed = transfer.layout === "texels" ? 0 : vertices;
        const held = withBlocks(transfer, at, followed, take) as Record<string, unknown>;
        const source = sourceOf(primitive, object, bake, held);
        this.keep(source);
        const property = new PrimitiveTransferProperty(this.document.getGraph());
        property.source = source;
        primitive.setExtension(kExtensionName, property);
        const buffer = primitive.getAttribute("POSITION")?.getBuffer() ?? null;
        const receivers = this.document.createAccessor("", buffer).setType("VEC4");
        primitive.setAttribute(source.semantic, receivers.setArray(receiversOf(source)));
      }
    // They are written anew: as accessors without a use, tools would count or remove them.
    for (const property of given) property.dispose();
    return this;
  }

  /** @hidden */
  override install(key: string): this {
    if (key !== kExtensionName) return this;
    this.prepared?.undo(); // left by a writer that failed
    this.prepared = null;
    const whole = this.document.getRoot().getExtension<BakeProperty>(kExtensionName)?.bake;
    this.prepared = prepare(this.document, whole ?? null, this.sources);
    return this;
  }

  /** @hidden */
  override prewrite(context: WriterContext): this {
    this.prepared?.store(context);
    return this;
  }

  /** @hidden */
  override write(context: WriterContext): this {
    this.prepared?.write(context);
    this.prepared?.undo();
    this.prepared = null;
    return this;
  }
}
