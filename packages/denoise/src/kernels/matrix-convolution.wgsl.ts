import { wgslModule, type WgslModule } from '@glanz/wgsl/module';
import { DenoiseLayer } from './layouts';
import {
  matrixPatch,
  matrixSums,
  threadsOf,
  tileHeight,
  tileWidth,
  type MatrixConvolution,
  type MatrixShape,
} from './shapes';
import tensor from './tensor.wesl';

/** `f(0)`, `f(1)`, … of n, one a line. */
const lines = (n: number, f: (i: number) => string) => Array.from({ length: n }, (_, i) => f(i)).join('\n');

/** Bindings, workgroup memory and the types of matrices. */
function declarations({ shape }: MatrixConvolution): string {
  const { m, n, k } = shape.matrix;
  return /* wgsl */ `
enable chromium_experimental_subgroup_matrix;
diagnostic(off, chromium.subgroup_matrix_uniformity);
alias DenoisePixels = subgroup_matrix_left<f16, ${k}, ${m}>;
alias DenoiseWeights = subgroup_matrix_right<f16, ${n}, ${k}>;
alias DenoiseSums = subgroup_matrix_result<f32, ${n}, ${m}>;
struct DenoiseWeightBlock { halves: array<vec4u, ${(n * k) / 8}> }
struct DenoiseSumBlock { vectors: array<vec4f, ${matrixSums(shape)}> }
@group(0) @binding(0) var<uniform> denoise_layer: DenoiseLayer;
@group(0) @binding(1) var<uniform> denoise_first_row: vec4u;
@group(0) @binding(2) var<storage, read> denoise_weights: array<DenoiseWeightBlock>;
@group(0) @binding(3) var<storage, read> denoise_direct: array<DenoiseTexel>;
${shape.up ? '@group(0) @binding(4) var<storage, read> denoise_up: array<DenoiseTexel>;' : ''}
@group(0) @binding(5) var<storage, read_write> denoise_result: array<DenoiseTexel>;
@group(0) @binding(6) var<storage, read> denoise_bias: array<vec4f>;
var<workgroup> denoise_patch: array<vec4u, ${matrixPatch(shape) / 8}>;
var<workgroup> denoise_sums: array<DenoiseSumBlock, ${shape.subgroups}>;`;
}

/** Copies the pixels that a workgroup needs of `k` channels into workgroup memory, with zeros outside of the image. */
function stage(
  { matrix, pixelStride, ...shape }: MatrixShape,
  source: 'direct' | 'up',
  columns: number,
  rows: number,
): string {
  const parts = matrix.k / 8;
  return /* wgsl */ `
fn denoise_stage_${source}(first: u32, corner: vec2u, thread: u32) {
  let size = vec2i(denoise_layer.size${source === 'up' ? ' / 2u' : ''});
  let quads = denoise_layer.${source}_quads;
  for (var task = thread; task < ${rows * columns * parts}u; task += ${shape.lanes * shape.subgroups}u) {
    let pixel = task / ${parts}u;
    let quad = first + (task % ${parts}u) * 2u;
    let y = i32(corner.y + pixel / ${columns}u) - 1;
    let x = i32(corner.x + pixel % ${columns}u) - 1;
    var texels = vec4u();
    if (y >= 0 && y < size.y && x >= 0 && x < size.x) {
      let at = u32((y * i32(quads) + i32(quad)) * size.x + x) - denoise_layer.${source}_base;
      if (quad < quads) { texels = vec4u(bitcast<vec2u>(denoise_${source}[at]), texels.zw); }
      if (quad + 1u < quads) { texels = vec4u(texels.xy, bitcast<vec2u>(denoise_${source}[at + u32(size.x)])); }
    }
    denoise_patch[pixel * ${pixelStride / 8}u + task % ${parts}u] = texels;
  }
}`;
}

/** Where a matrix of pixels is read from in the patch: its first pixel, and pixels from row to row of the matrix. */
interface Pixels {
  readonly row: number;
  readonly column: number;
  readonly step: number;
}

/** A product to be added: pixels, the tap of the weights, and which sums. */
interface Product {
  readonly pixels: Pixels;
  readonly tap: number;
  readonly sum: string;
}

/** Adds products, with each matrix of pixels and of weights loaded once. Places in the patch are constants. */
function addProducts({ matrix, pixelStride }: MatrixShape, columns: number, list: readonly Product[]): string {
  const text: string[] = [];
  const names = new Map<string, string>();
  const load = ({ pixels: { row, column, step } }: Product) => {
    const place = `${((row * columns + column) * pixelStride) / 8}u, ${(step * pixelStride) / 8}u`;
    const known = names.get(place);
    if (known) return known;
    const name = `p${names.size}`;
    names.set(place, name);
    text.push(`let ${name} = subgroupMatrixLoad<DenoisePixels, row_major>(&denoise_patch, ${place});`);
    return name;
  };
  const taps = new Set(list.map(({ tap }) => tap));
  for (const tap of taps) {
    const those = list.filter((product) => product.tap === tap);
    const pixels = those.map(load);
    text.push(
      `{ let w = subgroupMatrixLoad<DenoiseWeights, col_major>(&denoise_weights[weights + ${tap}u * tap_stride].halves, 0u, ${matrix.k / 8}u);`,
      ...those.map(({ sum }, j) => `${sum} = subgroupMatrixMultiplyAccumulate(${pixels[j]}, w, ${sum});`),
      '}',
    );
  }
  return text.join('\n');
}

/** Name of the sums of a row of pixels, of a parity of row and column. */
const sumOf = (parityY: number, parityX: number, row: number) => `s${parityY}${parityX}_${row}`;

const PARITIES = [0, 1].flatMap((y) => [0, 1].map((x) => [y, x] as const));

/** Products of the source at full resolution, of one column of the kernel, so that few pixels are held at a time. */
function directProducts({ rows, up }: MatrixShape, kx: number): Product[] {
  const step = up ? 2 : 1;
  return [0, 1, 2].flatMap((ky) =>
    (up ? PARITIES : [[0, 0] as const]).flatMap(([py, px]) =>
      Array.from({ length: rows }, (_, j) => ({
        pixels: { row: step * j + py + ky, column: px + kx, step },
        tap: 3 * ky + kx,
        sum: sumOf(py, px, j),
      })),
    ),
  );
}

/** Products of the upsampled source: 2×2 of the small image for each parity, those of a column of pixels together. */
function upProducts({ rows }: MatrixShape, column: number): Product[] {
  return PARITIES.flatMap(([py, px]) =>
    [0, 1].flatMap((p) =>
      px > column || column > px + 1
        ? []
        : Array.from({ length: rows }, (_, j) => ({
            pixels: { row: j + py + p, column, step: 1 },
            tap: 8 * py + 4 * p + 2 * (column - px) + px,
            sum: sumOf(py, px, j),
          })),
    ),
  );
}

/** The loop over the channels of a source, `k` at a time. */
function channelLoop(source: 'direct' | 'up', shape: MatrixShape, columns: number): string {
  const { k } = shape.matrix;
  const taps = source === 'up' ? 16 : 9;
  const products = source === 'up' ? upProducts : directProducts;
  const body = [0, 1, 2].map((column) => `{\n${addProducts(shape, columns, products(shape, column))}\n}`).join('\n');
  return /* wgsl */ `
  for (var first = 0u; first < denoise_layer.${source}_quads; first += ${k / 4}u) {
    workgroupBarrier();
    denoise_stage_${source}(first, corner${source === 'up' ? ' / 2u' : ''}, thread);
    workgroupBarrier();
    let weights = denoise_layer.${source}_weights + (first / ${k / 4}u) * ${taps}u * tap_stride + block;
${body}
  }`;
}

/** Stores sums that lie in workgroup memory, with bias and ReLU. */
function store({ shape, pool }: MatrixConvolution): string {
  const { m, n } = shape.matrix;
  const lanes = shape.lanes;
  const step = shape.up ? 2 : 1;
  const count = ((pool ? m / 2 : m) * n) / 4;
  const each = Math.ceil(count / lanes);
  const width = pool ? m / 2 : m;
  const read = (pixel: string) => `denoise_sums[subgroup].vectors[(${pixel}) * ${n / 4 + 1}u + task / ${width}u]`;
  const loop = (body: (i: number) => string) =>
    lines(each, (i) => `{ let task = lane + ${i * lanes}u; if (task < ${count}u) { ${body(i)} } }`);
  const pixel = `task % ${width}u`;
  return /* wgsl */ `
${
  pool
    ? `fn denoise_halve(subgroup: u32, lane: u32) -> array<vec4f, ${each}> {
  var held: array<vec4f, ${each}>;
  ${loop((i) => `held[${i}] = max(${read(`2u * (${pixel})`)}, ${read(`2u * (${pixel}) + 1u`)});`)}
  return held;
}
fn denoise_store(above: array<vec4f, ${each}>, below: array<vec4f, ${each}>, lane: u32, x: u32, y: u32, first_quad: u32) {
  let size = denoise_layer.size / 2u;
  ${loop(
    (i) => `let quad = first_quad + task / ${width}u;
    let at = x / 2u + ${pixel};
    if (quad < denoise_layer.result_quads && at < size.x && y / 2u < size.y) {
      let value = max(above[${i}], below[${i}]) + denoise_bias[quad];
      denoise_result[((y / 2u) * denoise_layer.result_quads + quad) * size.x + at - denoise_layer.result_base] = denoise_pack(max(value, vec4f()));
    }`,
  )}
}`
    : `fn denoise_store(subgroup: u32, lane: u32, x: u32, y: u32, first_quad: u32) {
  let size = denoise_layer.size;
  ${loop(
    () => `let quad = first_quad + task / ${width}u;
    let at = x + ${step}u * (${pixel});
    if (quad < denoise_layer.result_quads && at < size.x && y < size.y) {
      let value = ${read(pixel)} + denoise_bias[quad];
      denoise_result[(y * denoise_layer.result_quads + quad) * size.x + at - denoise_layer.result_base] = denoise_pack(max(value, vec4f()));
    }`,
  )}
}`
}`;
}

function main({ shape, pool }: MatrixConvolution): string {
  const { matrix, rows, lanes, subgroups, up } = shape;
  const { n } = matrix;
  const parities = up ? PARITIES : [[0, 0] as const];
  const text: string[] = [];
  const pass = (sum: string) =>
    `subgroupMatrixStore<row_major>(&denoise_sums[subgroup].vectors, 0u, ${sum}, ${n / 4 + 1}u);\nworkgroupBarrier();`;
  for (const [py, px] of parities)
    for (let j = 0; j < rows; j += pool ? 2 : 1) {
      if (pool)
        text.push(
          `{ ${pass(sumOf(py, px, j))} let above = denoise_halve(subgroup, lane); workgroupBarrier();`,
          `${pass(sumOf(py, px, j + 1))} let below = denoise_halve(subgroup, lane); workgroupBarrier();`,
          `denoise_store(above, below, lane, corner.x, corner.y + ${j}u, first_quad); }`,
        );
      else
        text.push(
          `${pass(sumOf(py, px, j))} denoise_store(subgroup, lane, corner.x + ${px}u, corner.y + ${(up ? 2 : 1) * j + py}u, first_quad); workgroupBarrier();`,
        );
    }
  return /* wgsl */ `
@compute @workgroup_size(${threadsOf(shape)})
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) thread: u32) {
  let subgroup = thread / ${lanes}u;
  let lane = thread % ${lanes}u;
  let corner = vec2u(workgroup.x * ${tileWidth(shape)}u, (workgroup.y + denoise_first_row.x) * ${tileHeight(shape)}u);
  let block = workgroup.z * ${subgroups}u + subgroup;
  let first_quad = block * ${n / 4}u;
  // From a tap's weights to the next one's.
  let tap_stride = denoise_layer.output_quads / ${n / 4}u;
  ${parities.map(([py, px]) => lines(rows, (j) => `var ${sumOf(py, px, j)}: DenoiseSums;`)).join('\n')}
  ${up ? channelLoop('up', shape, matrix.m + 2) : ''}
  ${channelLoop('direct', shape, tileWidth(shape) + 2)}
  ${text.join('\n')}
}`;
}

/**
 * The shader of a 3×3 convolution with ReLU whose products are subgroup matrices: `m` pixels of a row by `k` input
 * channels, times `k` input by `n` output channels, in half precision with sums in single precision. Pixels of `k`
 * channels are staged in workgroup memory at a time, weights are read from their buffer. A matrix of pixels serves all
 * rows of the kernel that it is in, one of weights all rows of pixels.
 *
 * Matrices are read and written through pointers whose bounds are constants, as vectors: WGSL's check of bounds is a
 * branch around each access otherwise, which makes the whole 1.6 times slower on an H200.
 */
export function matrixConvolution(kernel: MatrixConvolution): WgslModule {
  const { shape } = kernel;
  const text = [
    declarations(kernel),
    stage(shape, 'direct', tileWidth(shape) + 2, tileHeight(shape) + 2),
    shape.up ? stage(shape, 'up', shape.matrix.m + 2, shape.rows + 2) : '',
    store(kernel),
    main(kernel),
  ];
  return wgslModule('denoise/matrix-convolution', text.join('\n'), [DenoiseLayer, tensor]);
}
