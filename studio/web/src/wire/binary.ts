import type { Packed } from "./protocol";

/** A binary message: the length of a JSON text (4 bytes), the text, Float32 numbers. Throws RangeError on anything else. */
export function unpacked(data: ArrayBuffer): { told: Packed; numbers: Float32Array } {
  if (data.byteLength < 4) throw new RangeError("a binary message of less than 4 bytes");
  const length = new DataView(data).getUint32(0, true);
  if (4 + length > data.byteLength || length % 4 !== 0) throw new RangeError(`a binary message with a text of ${length} bytes`);
  const told = JSON.parse(new TextDecoder().decode(new Uint8Array(data, 4, length))) as Packed;
  return { told, numbers: new Float32Array(data, 4 + length) };
}
