/**
 * LAMBENT_radiance_transfer for glTF-Transform 4: baked assets keep their transfer through its
 * functions, or say why they cannot.
 *
 * @packageDocumentation
 */
export { BakeProperty, LambentRadianceTransfer, PrimitiveTransferProperty } from "./extension.js";
export { LambentFormatError } from "../format/description.js";
