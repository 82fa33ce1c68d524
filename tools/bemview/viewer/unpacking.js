// Sections of a page: base 64, inflated by the browser, split into bytes. ../packing.hpp writes them.

function bytesOf(base64) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(base64);
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < bytes.length; i++) bytes[i] = text.charCodeAt(i);
  return bytes;
}

async function inflated(bytes) {
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Reads the numbers of a section one array after another. */
class SectionReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }

  take(count) {
    if (this.at + count > this.bytes.length) throw new Error("the page is not complete");
    this.at += count;
    return this.bytes.subarray(this.at - count, this.at);
  }

  /** Numbers that are stored by their bytes: the lowest byte of all, then the next. */
  numbers(Type, count) {
    const out = new Type(count);
    const width = Type.BYTES_PER_ELEMENT;
    const planes = this.take(count * width);
    const bytes = new Uint8Array(out.buffer);
    for (let byte = 0; byte < width; byte++) {
      const plane = byte * count;
      for (let i = 0; i < count; i++) bytes[i * width + byte] = planes[plane + i];
    }
    return out;
  }

  /**
   * Frames of whole numbers that were predicted from each other (../prediction.hpp), into `out`.
   * Prediction is from the vertex before (0), the frame before (1), or the two before (2).
   */
  predictedFrames(out, frames, components) {
    const kinds = this.take(frames);
    const length = out.length / frames;
    const differences = this.numbers(Uint16Array, out.length);
    for (let k = 0; k < frames; k++) {
      const here = k * length;
      const kind = kinds[k];
      for (let i = here; i < here + length; i++) {
        const folded = differences[i];
        const difference = folded & 1 ? ~(folded >> 1) : folded >> 1;
        let predicted = 0;
        if (kind === 1) predicted = out[i - length];
        else if (kind === 2) predicted = 2 * out[i - length] - out[i - 2 * length];
        else if (i - here >= components) predicted = out[i - components];
        out[i] = predicted + difference;
      }
    }
  }
}

/** The section in an element of the page, which is emptied: the text is no longer needed. */
export async function readSection(element) {
  const bytes = bytesOf(element.textContent);
  element.remove();
  return new SectionReader(await inflated(bytes));
}
