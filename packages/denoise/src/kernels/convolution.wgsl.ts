import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import finish from './finish.wesl';
import { stagedUpChannels, stagesWeights, threadsOf, tileHeight, type ThreadShape } from './shapes';
import { DenoiseLayer } from './layouts';
import tensor from './tensor.wesl';

/** What a convolution's shader depends on. */
export interface ConvolutionKernel {
  readonly shape: ThreadShape;
  /** Whether the first source is at half of the resolution, to be upsampled. */
  readonly up: boolean;
  /** Channels of the source at full resolution. The last vector of four may hold fewer, which are all that is added. */
  readonly directChannels: number;
  /** Whether the maximum of 2×2 pixels is stored. */
  readonly pool: boolean;
  /** Whether this is the last layer, whose result is decoded into the caller's image. */
  readonly last: boolean;
}

/** `f(0)`, `f(1)`, … of n, one a line. */
const lines = (n: number, f: (i: number) => string) => Array.from({ length: n }, (_, i) => f(i)).join('\n');
/** Names of the staged weights. */
const STAGED = { direct: 'denoise_staged', up: 'denoise_staged_up' } as const;
const XYZW = ['x', 'y', 'z', 'w'] as const;

/** A thread's four pixels, `kx` to the right, out of two neighbouring vectors of a row. */
const SHIFTED = ['$a', 'vec4f($a.yzw, $b.x)', 'vec4f($a.zw, $b.xy)'] as const;

// Text in place of loops: sums are registers, and drivers do not always unroll what indexes them.
class Emitter {
  readonly #kernel: ConvolutionKernel;
  readonly #shape: ThreadShape;
  /** Vectors of output channels a thread. */
  readonly #quads: number;
  /** Output channels a thread that are computed: the last layer has three, and its vector a place to spare. */
  readonly #outputs: number;
  readonly #patchRows: number;
  readonly #threads: number;

  constructor(kernel: ConvolutionKernel) {
    this.#kernel = kernel;
    this.#shape = kernel.shape;
    this.#quads = kernel.shape.outputs / 4;
    this.#outputs = kernel.last ? 3 : kernel.shape.outputs;
    this.#patchRows = tileHeight(kernel.shape) + 2;
    this.#threads = threadsOf(kernel.shape);
  }

  /** Bindings and workgroup memory. */
  declarations(): string {
    const { up, last, shape } = this.#kernel;
    const staged = (taps: number, channels: number) =>
      `array<array<array<vec4f, ${taps * this.#quads}>, ${shape.groups}>, ${channels}>`;
    return /* wgsl */ `
@group(0) @binding(0) var<uniform> denoise_layer: DenoiseLayer;
@group(0) @binding(1) var<uniform> denoise_first_row: vec4u;
@group(0) @binding(2) var<storage, read> denoise_weights: array<vec4f>;
@group(0) @binding(3) var<storage, read> denoise_direct: array<DenoiseTexel>;
${up ? '@group(0) @binding(4) var<storage, read> denoise_up: array<DenoiseTexel>;' : ''}
${last ? '' : '@group(0) @binding(5) var<storage, read_write> denoise_result: array<DenoiseTexel>;'}
var<workgroup> denoise_patch: array<array<array<vec4f, ${shape.threadsX + 1}>, ${this.#patchRows}>, 4>;
${stagesWeights(shape) ? `var<workgroup> denoise_staged: ${staged(9, 4)};` : ''}
${up && stagesWeights(shape) ? `var<workgroup> denoise_staged_up: ${staged(16, stagedUpChannels(shape, true))};` : ''}`;
  }

  /**
   * Copies the pixels that a workgroup needs of four channels into workgroup memory, one vector for four pixels in a row,
   * with zeros outside of the image.
   *
   * @param step Pixels between the vectors of a row: 4, or 2 of an upsampled source, whose vectors overlap.
   */
  stagePixels(source: 'direct' | 'up', rows: number, columns: number, step: number): string {
    const size = source === 'up' ? 'denoise_layer.size / 2u' : 'denoise_layer.size';
    return /* wgsl */ `
fn denoise_stage_${source}(quad: u32, corner: vec2u, thread: u32) {
  let size = vec2i(${size});
  for (var task = thread; task < ${rows * columns}u; task += ${this.#threads}u) {
    let row = task / ${columns}u;
    let column = task % ${columns}u;
    let x = i32(corner.x + ${step}u * column) - 1;
    let y = i32(corner.y + row) - 1;
    var a = vec4f(0.0);
    var b = vec4f(0.0);
    var c = vec4f(0.0);
    var d = vec4f(0.0);
    if (y >= 0 && y < size.y) {
      let at = (y * i32(denoise_layer.${source}_quads) + i32(quad)) * size.x + x - i32(denoise_layer.${source}_base);
      if (x >= 0 && x < size.x) { a = denoise_unpack(denoise_${source}[at]); }
      if (x + 1 < size.x) { b = denoise_unpack(denoise_${source}[at + 1]); }
      if (x + 2 < size.x) { c = denoise_unpack(denoise_${source}[at + 2]); }
      if (x + 3 < size.x) { d = denoise_unpack(denoise_${source}[at + 3]); }
    }
    denoise_patch[0][row][column] = vec4f(a.x, b.x, c.x, d.x);
    denoise_patch[1][row][column] = vec4f(a.y, b.y, c.y, d.y);
    denoise_patch[2][row][column] = vec4f(a.z, b.z, c.z, d.z);
    denoise_patch[3][row][column] = vec4f(a.w, b.w, c.w, d.w);
  }
}`;
  }

  /** Copies the weights of `channels` input channels, for the outputs of a workgroup, into workgroup memory. */
  stageWeights(source: 'direct' | 'up', taps: number, channels: number): string {
    const { groups } = this.#shape;
    const row = groups * this.#quads;
    return /* wgsl */ `
fn denoise_stage_${source}_weights(first: u32, output: u32, thread: u32) {
  let start = denoise_layer.${source}_weights + first * ${taps}u * denoise_layer.output_quads + output;
  for (var task = thread; task < ${channels * taps * row}u; task += ${this.#threads}u) {
    let tap = task / ${row}u;
    let quad = task % ${row}u;
    ${STAGED[source]}[tap / ${taps}u][quad / ${this.#quads}u][(tap % ${taps}u) * ${this.#quads}u + quad % ${this.#quads}u] =
      denoise_weights[start + tap * denoise_layer.output_quads + quad];
  }
}`;
  }

  /**
   * Reads a thread's weights for a tap into NAME0, NAME1, … Inside of a thread's part of the staged weights all places are
   * constants (but for the parity), so that compilers need no bounds checks for them.
   */
  #readWeights(name: string, source: 'direct' | 'up', tap: number): string {
    const quads = this.#quads;
    const parity = source === 'up' ? `parity * ${8 * quads}u + ` : '';
    return lines(quads, (n) =>
      stagesWeights(this.#shape)
        ? `let ${name}${n} = ${STAGED[source]}[channel][group][${parity}${tap * quads + n}u];`
        : `let ${name}${n} = denoise_weights[row + ${tap}u * denoise_layer.output_quads + ${n}u];`,
    );
  }

  /** Rows of the patch that a thread reads, as r0a, r0b, … */
  #row(d: number, second: boolean): string {
    return `let r${d}a = denoise_patch[patch_channel][patch_row + ${d}u][tx];${
      second ? ` let r${d}b = denoise_patch[patch_channel][patch_row + ${d}u][tx + 1u];` : ''
    }`;
  }

  /** Adds the 3×3 correlation of an input channel. */
  direct(): string {
    const { rows } = this.#shape;
    const step = this.#kernel.up ? 2 : 1;
    const text: string[] = [];
    const read = new Set<number>();
    // With rows of one parity, kernel rows 0 and 2 share what they read.
    for (const ky of step === 2 ? [0, 2, 1] : [0, 1, 2]) {
      for (let j = 0; j < rows; j++) {
        const d = step * j + ky;
        if (read.has(d)) continue;
        read.add(d);
        text.push(this.#row(d, true));
      }
      for (let kx = 0; kx < 3; kx++) {
        text.push('{', this.#readWeights('w', 'direct', 3 * ky + kx));
        for (let j = 0; j < rows; j++) {
          const d = step * j + ky;
          text.push(`let v${j} = ${SHIFTED[kx]!.replace('$a', `r${d}a`).replace('$b', `r${d}b`)};`);
        }
        for (let j = 0; j < rows; j++)
          for (let n = 0; n < this.#outputs; n++) text.push(`s${j}_${n} += v${j} * w${n >> 2}.${XYZW[n & 3]};`);
        text.push('}');
      }
    }
    return text.join('\n');
  }

  /** Adds the 3×3 correlation of an upsampled input channel: 2×2 of the small one, by the parity of row and column. */
  up(): string {
    const { rows, outputs } = this.#shape;
    const text = [lines(rows + 1, (d) => this.#row(d, false))];
    for (let p = 0; p < 2; p++)
      for (let q = 0; q < 2; q++) {
        text.push(
          '{',
          this.#readWeights('even', 'up', 4 * p + 2 * q),
          this.#readWeights('odd', 'up', 4 * p + 2 * q + 1),
        );
        for (let j = 0; j < rows; j++) text.push(`let v${j} = r${j + p}a.${q === 0 ? 'xyyz' : 'yzzw'};`);
        for (let n = 0; n < outputs; n++) {
          const part = `${n >> 2}.${XYZW[n & 3]}`;
          text.push(`{ let w = vec4f(even${part}, odd${part}, even${part}, odd${part});`);
          for (let j = 0; j < rows; j++) text.push(`s${j}_${n} += v${j} * w;`);
          text.push('}');
        }
        text.push('}');
      }
    return text.join('\n');
  }

  /** Stores what a thread has computed. */
  store(): string {
    const { rows } = this.#shape;
    const { pool, last, up } = this.#kernel;
    const texel = (j: number, quad: number, k: number) =>
      `vec4f(${[0, 1, 2, 3].map((c) => `s${j}_${4 * quad + c}.${XYZW[k]}`).join(', ')})`;
    const text: string[] = [];
    const step = up ? 2 : 1;
    if (last) {
      for (let j = 0; j < rows; j++)
        for (let k = 0; k < 4; k++) text.push(`denoise_finish(vec2u(x + ${k}u, y + ${step * j}u), ${texel(j, 0, k)});`);
      return text.join('\n');
    }
    for (let quad = 0; quad < this.#quads; quad++) {
      text.push(`if (output + ${quad}u < denoise_layer.result_quads) {`);
      for (let j = 0; j < rows; j += pool ? 2 : 1) {
        text.push(
          pool
            ? `if (y + ${j}u < size.y) { let at = ((y / 2u + ${j / 2}u) * denoise_layer.result_quads + output + ${quad}u) * (size.x / 2u) + x / 2u - denoise_layer.result_base;`
            : `if (y + ${step * j}u < size.y) { let at = ((y + ${step * j}u) * denoise_layer.result_quads + output + ${quad}u) * size.x + x - denoise_layer.result_base;`,
        );
        for (let k = 0; k < 4; k += pool ? 2 : 1) {
          const value = pool
            ? `max(max(${texel(j, quad, k)}, ${texel(j, quad, k + 1)}), max(${texel(j + 1, quad, k)}, ${texel(j + 1, quad, k + 1)}))`
            : texel(j, quad, k);
          text.push(
            `if (x + ${k}u < size.x) { denoise_result[at + ${pool ? k / 2 : k}u] = denoise_pack(max(${value}, vec4f(0.0))); }`,
          );
        }
        text.push('}');
      }
      text.push('}');
    }
    return text.join('\n');
  }

  /** The loop over a source's quads of channels. */
  #quadLoop(source: 'direct' | 'up'): string {
    const up = source === 'up';
    const staged = stagesWeights(this.#shape);
    const channels = up && staged ? stagedUpChannels(this.#shape, true) : 4;
    const before = up ? '(quad * 4u + channel) * 16u + parity * 8u' : '(quad * 4u + channel) * 9u';
    // Inputs of 9 channels (color, albedo, normal) are 12 with padding: a quarter of the work of the first layer.
    const rest = up ? 0 : this.#kernel.directChannels % 4;
    const count = rest === 0 ? `${channels}u` : `select(4u, ${rest}u, quad + 1u == denoise_layer.direct_quads)`;
    const unstaged = `denoise_layer.${source}_weights + (${before}) * denoise_layer.output_quads + output`;
    return /* wgsl */ `
  for (var quad = 0u; quad < denoise_layer.${source}_quads; quad++) {
    for (var first = 0u; first < 4u; first += ${channels}u) {
      workgroupBarrier();
      if (first == 0u) { denoise_stage_${source}(quad, ${up ? 'corner / 2u' : 'corner'}, thread); }
      ${staged ? `denoise_stage_${source}_weights(quad * 4u + first, first_output, thread);` : ''}
      workgroupBarrier();
      for (var channel = 0u; channel < ${count}; channel++) {
        let patch_channel = first + channel;
        ${staged ? '' : `let row = ${unstaged};`}
${up ? this.up() : this.direct()}
      }
    }
  }`;
  }

  main(): string {
    const { shape, up } = this.#kernel;
    const { threadsX, threadsY, groups, rows, outputs } = shape;
    return /* wgsl */ `
@compute @workgroup_size(${this.#threads})
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) thread: u32) {
  let size = denoise_layer.size;
  let tx = thread % ${threadsX}u;
  let ty = (thread / ${threadsX}u) % ${threadsY}u;
  let group = thread / ${threadsX * threadsY}u;
  let corner = vec2u(workgroup.x * ${4 * threadsX}u, (workgroup.y + denoise_first_row.x) * ${tileHeight(shape)}u);
  let first_output = workgroup.z * ${groups * this.#quads}u;
  let output = first_output + group * ${this.#quads}u;
  ${lines(this.#quads, (n) => `let bias${n} = denoise_weights[output + ${n}u];`)}
  ${lines(rows * outputs, (i) => {
    const n = i % outputs;
    return `var s${Math.floor(i / outputs)}_${n} = vec4f(bias${n >> 2}.${XYZW[n & 3]});`;
  })}
  ${
    up
      ? `let parity = ty & 1u;
  { let patch_row = (ty >> 1u) * ${rows}u + parity;${this.#quadLoop('up')} }
  let patch_row = (ty >> 1u) * ${2 * rows}u + parity;`
      : `let patch_row = ty * ${rows}u;`
  }
  ${this.#quadLoop('direct')}
  let x = corner.x + 4u * tx;
  let y = corner.y + patch_row;
${this.store()}
}`;
  }

  text(): string {
    const { up, shape } = this.#kernel;
    const staged = stagesWeights(shape);
    return [
      this.declarations(),
      this.stagePixels('direct', this.#patchRows, shape.threadsX + 1, 4),
      staged ? this.stageWeights('direct', 9, 4) : '',
      ...(up
        ? [
            this.stagePixels('up', tileHeight(shape) / 2 + 2, shape.threadsX, 2),
            staged ? this.stageWeights('up', 16, stagedUpChannels(shape, true)) : '',
          ]
        : []),
      this.main(),
    ].join('\n');
  }
}

/**
 * The shader of a 3×3 convolution with ReLU as an implicit matrix product: pixels of a tile by output channels, summed
 * over input channels, four of which are staged in workgroup memory at a time.
 *
 * An upsampled source is never made: a 3×3 kernel on repeated pixels is one of 2×2 on the small image for each parity of
 * row and column, with weights added up (`up` in pack-weights.ts). A thread then has rows of one parity.
 */
export function convolutionModule(kernel: ConvolutionKernel): WgslModule {
  return wgslModule('denoise/convolution', new Emitter(kernel).text(), [
    DenoiseLayer,
    tensor,
    ...(kernel.last ? [finish] : []),
  ]);
}
