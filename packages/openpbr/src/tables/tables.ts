import { ENCODED_CONDUCTOR, ENCODED_DIELECTRIC, ENCODED_SHEEN } from './encoded';

/** A table of numbers, ready to become a texture. */
export interface OpenPbrTable {
  readonly width: number;
  readonly height: number;
  /** 1 for a two-dimensional table. */
  readonly depth: number;
  /**
   * `width × height × depth` numbers in [-0.1, 2], x fastest. Decoded at the first access; half floats hold them well
   * enough.
   */
  readonly data: Float32Array<ArrayBuffer>;
}

interface EncodedTable {
  readonly width: number;
  readonly height: number;
  readonly depth: number;
  /** How many steps are 1. */
  readonly step: number;
  readonly text: string;
}

/** The inverse of `encode` in scripts/tables.mjs. */
function decode({ width, height, depth, step: unit, text }: EncodedTable): Float32Array<ArrayBuffer> {
  const steps = new Int32Array(width * height * depth);
  let at = 0;
  const digit = (): number => {
    const code = text.charCodeAt(at++);
    return code - 40 - (code > 92 ? 1 : 0) - (code > 96 ? 1 : 0);
  };
  for (let i = 0; i < steps.length; i++) {
    let code = digit();
    // The first digit tells how many follow: from 64 on one; "~" is above all digits, and three follow.
    if (code > 79) code = (digit() * 80 + digit()) * 80 + digit();
    else if (code > 63) code = 64 + (code - 64) * 80 + digit();
    steps[i] = code % 2 === 0 ? code / 2 : -(code + 1) / 2;
  }
  // What is written is the difference along x, of those along y, of those along z.
  sumAlong(steps, 1, width);
  sumAlong(steps, width, width * height);
  sumAlong(steps, width * height, steps.length);
  const data = new Float32Array(steps.length);
  for (let i = 0; i < data.length; i++) data[i] = (steps[i] as number) / unit;
  return data;
}

/** Adds to each number the one `stride` before it, in blocks of their own of `block` numbers. */
function sumAlong(steps: Int32Array, stride: number, block: number): void {
  for (let from = 0; from < steps.length; from += block) {
    for (let i = from + stride; i < from + block; i++) steps[i] = (steps[i] as number) + (steps[i - stride] as number);
  }
}

function joined(first: Float32Array, second: Float32Array): Float32Array<ArrayBuffer> {
  const all = new Float32Array(first.length + second.length);
  all.set(first);
  all.set(second, first.length);
  return all;
}

/** Blocks of the same width, below each other. */
function table(first: EncodedTable, second?: EncodedTable): OpenPbrTable {
  let data: Float32Array<ArrayBuffer> | undefined;
  return {
    width: first.width,
    height: first.height + (second?.height ?? 0),
    depth: first.depth,
    get data() {
      return (data ??= second ? joined(decode(first), decode(second)) : decode(first));
    },
  };
}

/**
 * The energy tables that {@link openpbr} reads through the host's accessors: directional albedos of GGX interfaces (of
 * conductors, what single scattering loses; of fuzz, its energy and shape), computed from first principles by
 * scripts/tables.mjs. Bind them as textures with linear filtering and clamping (any filterable float format; `r16float`
 * does), or as buffers with the host's own interpolation between texel centres.
 *
 * `dielectric` is three-dimensional, for `openpbr_table_dielectric(coords)`; `conductor` two-dimensional, for
 * `openpbr_table_conductor(coords)`. `coords` are in [0, 1] like a texture's: texel i of n is centred at (i + ½)/n.
 */
export const OPENPBR_TABLES: { readonly dielectric: OpenPbrTable; readonly conductor: OpenPbrTable } = {
  dielectric: /* @__PURE__ */ table(ENCODED_DIELECTRIC),
  conductor: /* @__PURE__ */ table(ENCODED_CONDUCTOR, ENCODED_SHEEN),
};
