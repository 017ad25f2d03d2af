/** Bytes of instructions, in any nesting. */
export type Code = readonly (number | Code)[];

const flat = (code: Code): number[] => code.flatMap((item) => (typeof item === 'number' ? item : flat(item)));

/** An unsigned number in the format's variable length (LEB128). */
export function unsigned(value: number): number[] {
  const bytes: number[] = [];
  for (; value > 127; value >>>= 7) bytes.push((value & 127) | 128);
  return [...bytes, value];
}

/** A number that is counted, then its items. */
const vector = (items: readonly Code[]): number[] => [...unsigned(items.length), ...flat(items)];

/** A constant from −64 to 63 or of more bytes, as i32. */
function constant(value: number): number[] {
  const bytes = [0x41];
  for (;;) {
    const low = value & 127;
    value >>= 7;
    const last = value === (low & 64 ? -1 : 0);
    bytes.push(last ? low : low | 128);
    if (last) return bytes;
  }
}

const access = (align: number, offset: number): number[] => [align, ...unsigned(offset)];
const simd = (code: number, rest: Code = []): Code => [0xfd, ...unsigned(code), ...rest];

/** Instructions of WebAssembly's core, its SIMD and its relaxed SIMD, as the binary format encodes them. */
export const op = {
  get: (local: number): Code => [0x20, ...unsigned(local)],
  set: (local: number): Code => [0x21, ...unsigned(local)],
  tee: (local: number): Code => [0x22, ...unsigned(local)],
  constant,
  add: [0x6a],
  sub: [0x6b],
  shiftLeft: [0x74],
  /** Loads and stores at the address on the stack plus an offset. */
  load: (offset: number): Code => [0x28, ...access(2, offset)],
  store: (offset: number): Code => [0x36, ...access(2, offset)],
  loadVector: (offset: number): Code => simd(0, access(2, offset)),
  /** One float, four times. */
  loadSplat: (offset: number): Code => simd(9, access(2, offset)),
  storeVector: (offset: number): Code => simd(11, access(2, offset)),
  zeros: simd(12, Array<number>(16).fill(0)),
  addVectors: simd(0xe4),
  multiplyVectors: simd(0xe6),
  maxVectors: simd(0xe9),
  /** a × b + c, rounded once or twice as the processor likes. */
  multiplyAdd: simd(0x105),
  /** Repeats its body while this i32, a counter that is positive at the start, is not yet 0. */
  countdown: (counter: number, body: Code): Code => [
    0x03,
    0x40,
    body,
    [op.get(counter), constant(1), op.sub, op.tee(counter)],
    [0x0d, 0, 0x0b],
  ],
  /** Adds a constant to a local. */
  advance: (local: number, by: number): Code => [op.get(local), constant(by), op.add, op.set(local)],
};

const I32 = 0x7f;
const V128 = 0x7b;

/** A function of i32 parameters without a result. Its locals are numbered: parameters, then i32, then vectors. */
export interface WasmFunction {
  readonly name: string;
  readonly parameters: number;
  readonly integers: number;
  readonly vectors: number;
  readonly body: Code;
}

/** The binary of a module with these functions, which imports its memory as `m.memory`. */
export function assemble(functions: readonly WasmFunction[]): Uint8Array<ArrayBuffer> {
  const section = (id: number, content: readonly number[]): Code => [id, unsigned(content.length), content];
  const text = (name: string): number[] => vector([...name].map((letter) => [letter.charCodeAt(0)]));
  const types = functions.map(({ parameters }) => [0x60, ...vector(Array<Code>(parameters).fill([I32])), 0]);
  const bodies = functions.map(({ integers, vectors, body }) => {
    const locals = vector([
      [...unsigned(integers), I32],
      [...unsigned(vectors), V128],
    ]);
    const code = flat([locals, body, 0x0b]);
    return [unsigned(code.length), code];
  });
  return Uint8Array.from(
    flat([
      [0, 0x61, 0x73, 0x6d, 1, 0, 0, 0],
      section(1, vector(types)),
      section(2, vector([[text('m'), text('memory'), 2, 0, 1]])),
      section(3, vector(functions.map((_, i) => unsigned(i)))),
      section(7, vector(functions.map(({ name }, i) => [text(name), 0, unsigned(i)]))),
      section(10, vector(bodies)),
    ]),
  );
}
