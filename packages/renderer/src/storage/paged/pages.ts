// Imports no values of the renderer: those it has in common with what is there from the start would become a chunk of
// their own, which all pages load.
import type { DeviceError } from '../../errors';
import type { GpuMemory, PagedArray } from '../buffers';
import type { ShapeArray, ShapeBytes } from '../shape-arrays';

/** `GPUTextureUsage.COPY_SRC | COPY_DST | TEXTURE_BINDING`, which Node does not define. */
const USAGE = 1 | 2 | 4;

/** Texels of a row and bytes of a layer, as far as the device allows: within WebGPU's default limits. */
const MAX_COLUMNS = 8192;
const MAX_LAYER_BYTES = 1 << 26;
/** Shaders count words by 32 bits. */
const MAX_ARRAY_BYTES = 2 ** 34;
/** Bytes that are written at once. */
const WRITE_BYTES = 1 << 24;

/** Bytes of a texel, and its format. Attributes begin at any word; nodes and triangles are read by four words. */
const TEXELS = {
  nodes: [16, 'rgba32uint'],
  triangles: [16, 'rgba32uint'],
  attributes: [4, 'r32uint'],
} as const satisfies Record<ShapeArray, readonly [bytes: number, format: GPUTextureFormat]>;

/** How arrays lie in textures on a device: all numbers are powers of two, but `layers`. */
export interface PageShape {
  /** Texels of a row. */
  readonly columns: number;
  readonly layerBytes: number;
  /** Layers that a texture may have. */
  readonly layers: number;
}

const powerOfTwo = (max: number) => 2 ** Math.floor(Math.log2(max));

/** @param device Its limits decide. */
export function pageShape({ limits }: Pick<GPUDevice, 'limits'>): PageShape {
  const columns = powerOfTwo(Math.min(MAX_COLUMNS, limits.maxTextureDimension2D));
  // The smallest texels have the most rows: as many as columns.
  return {
    columns,
    layerBytes: Math.min(MAX_LAYER_BYTES, 4 * columns * columns),
    layers: limits.maxTextureArrayLayers,
  };
}

/** A part of a range of texels that is a box within one layer. */
export interface PagePart {
  readonly origin: [x: number, y: number, layer: number];
  readonly size: [width: number, height: number, layers: number];
  /** Its first texel, counted from the first of the range. */
  readonly first: number;
}

/**
 * Cuts a range of texels into boxes: the rest of a row, whole rows, the begin of a row.
 *
 * @param columns Texels of a row.
 * @param rows Rows of a layer.
 * @param maxRows Rows of a box at most.
 */
export function* pageParts(
  first: number,
  count: number,
  columns: number,
  rows: number,
  maxRows = rows,
): Generator<PagePart> {
  for (let done = 0; done < count;) {
    const x = (first + done) % columns;
    const row = Math.floor((first + done) / columns);
    const y = row % rows;
    const left = count - done;
    const isWhole = x === 0 && left >= columns;
    const width = Math.min(columns - x, left);
    const height = isWhole ? Math.min(Math.floor(left / columns), rows - y, maxRows) : 1;
    yield { origin: [x, y, Math.floor(row / rows)], size: [width, height, 1], first: done };
    done += width * height;
  }
}

/** An array in a texture. Ranges begin and end at texels. */
class TextureArray implements PagedArray {
  readonly size: number;
  readonly view: GPUTextureView;
  readonly #device: GPUDevice;
  readonly #texture: GPUTexture;
  readonly #columns: number;
  readonly #rows: number;
  readonly #texelBytes: number;

  constructor(device: GPUDevice, name: ShapeArray, bytes: number, { columns, layerBytes }: PageShape) {
    const [texelBytes, format] = TEXELS[name];
    const rowBytes = columns * texelBytes;
    const layers = Math.max(1, Math.ceil(bytes / layerBytes));
    const rows = layers > 1 ? layerBytes / rowBytes : Math.max(1, Math.ceil(bytes / rowBytes));
    this.#device = device;
    this.#columns = columns;
    this.#rows = layerBytes / rowBytes;
    this.#texelBytes = texelBytes;
    this.size = layers * rows * rowBytes;
    this.#texture = device.createTexture({
      label: `glanz ${name}`,
      size: [columns, rows, layers],
      format,
      usage: USAGE,
    });
    this.view = this.#texture.createView({ dimension: '2d-array' });
  }

  write(data: ArrayBufferView<ArrayBuffer> | ArrayBuffer, offset: number): void {
    const [source, start] = ArrayBuffer.isView(data) ? [data.buffer, data.byteOffset] : [data, 0];
    for (const { origin, size, layout } of this.#parts(offset, data.byteLength, WRITE_BYTES))
      this.#device.queue.writeTexture(
        { texture: this.#texture, origin },
        source,
        { ...layout, offset: start + layout.offset },
        size,
      );
  }

  copyFrom(encoder: GPUCommandEncoder, buffer: GPUBuffer, offset: number, bytes: number): void {
    for (const { origin, size, layout } of this.#parts(offset, bytes))
      encoder.copyBufferToTexture({ buffer, ...layout }, { texture: this.#texture, origin }, size);
  }

  copyTo(encoder: GPUCommandEncoder, buffer: GPUBuffer, offset: number, bytes: number): void {
    for (const { origin, size, layout } of this.#parts(offset, bytes))
      encoder.copyTextureToBuffer({ texture: this.#texture, origin }, { buffer, ...layout }, size);
  }

  destroy(): void {
    this.#texture.destroy();
  }

  /** The boxes of a range of bytes, with where they lie in a buffer that holds the range. */
  *#parts(offset: number, bytes: number, maxBytes = Infinity) {
    const [texel, rowBytes] = [this.#texelBytes, this.#texelBytes * this.#columns];
    const maxRows = Math.max(1, Math.floor(maxBytes / rowBytes));
    for (const { first, ...part } of pageParts(offset / texel, bytes / texel, this.#columns, this.#rows, maxRows))
      yield { ...part, layout: { offset: first * texel, bytesPerRow: rowBytes, rowsPerImage: part.size[1] } };
  }
}

/**
 * The arrays of a scene that are larger than what a shader can bind of a buffer. They lie in textures, of which shaders
 * can bind 16, and each of which holds up to 16 GiB within WebGPU's default limits. Kernels read them by other
 * functions (integrator/paged-kernels.ts).
 */
export class Pages {
  readonly names: readonly ShapeArray[];
  readonly #device: GPUDevice;
  readonly #Fault: typeof DeviceError;
  readonly #shape: PageShape;

  /**
   * @param bytes What the arrays of a scene take.
   * @param bindingBytes What a shader can bind of a buffer: less than one of them takes.
   * @param Fault The class of errors.
   * @param present Its arrays lie in textures in any case.
   * @throws {DeviceError} `renderer/limit` where textures do not hold them either.
   */
  constructor(device: GPUDevice, bytes: ShapeBytes, bindingBytes: number, Fault: typeof DeviceError, present?: Pages) {
    this.#device = device;
    this.#Fault = Fault;
    this.#shape = pageShape(device);
    const entries = Object.entries(bytes) as [ShapeArray, number][];
    this.names = entries
      .filter(([name, size]) => size > bindingBytes || present?.names.includes(name))
      .map(([name]) => name);
    for (const [, size] of entries) this.#expectRoom(size, bytes);
  }

  /** An array in a texture, still of zeros; undefined for one that lies in a buffer. @throws As the constructor. */
  make(memory: GpuMemory, name: string, bytes: number): PagedArray | undefined {
    const found = this.names.find((other) => other === name);
    if (!found) return undefined;
    this.#expectRoom(bytes, { [found]: bytes });
    const array = new TextureArray(this.#device, found, bytes, this.#shape);
    memory.adopt(name, array);
    return array;
  }

  #expectRoom(size: number, bytes: Partial<ShapeBytes>): void {
    const { layerBytes, layers } = this.#shape;
    const max = Math.min(MAX_ARRAY_BYTES, layerBytes * layers);
    if (size <= max) return;
    const list = Object.entries(bytes).map(([name, value]) => `${name} ${mebibytes(value)}`);
    throw new this.#Fault(
      'renderer/limit',
      `The shapes of this scene take ${mebibytes(Object.values(bytes).reduce((a, b) => a + b, 0))} (${list.join(', ')}), but this device holds ${mebibytes(max)} of each: render fewer triangles, or repeat meshes by instances.`,
    );
  }
}

const mebibytes = (bytes: number) => `${(bytes / 2 ** 20).toFixed(1)} MiB`;
