import { compose, wgslModule } from '@glanz/wgsl';
import { runCompute, testDevice } from '@glanz/gpu';
import type { OpenPbrParameters, OpenPbrVector } from '../src/parameters/index';
import { OPENPBR_TABLES } from '../src/tables/index';
import { openpbrLobes } from '../src/wgsl/lobes/index';
import { openpbrFilm } from '../src/wgsl/thin_film/index';
import { openpbr, openPbrStruct, packOpenPbr, type OpenPbrFlags } from '../src/wgsl/index';

/** One surface, seen from one direction: a pair to evaluate, and numbers to sample with. */
export interface GpuCase {
  readonly parameters: OpenPbrParameters;
  readonly wo: OpenPbrVector;
  readonly wi: OpenPbrVector;
  readonly u: OpenPbrVector;
  /** The viewer's side; asked for with OPENPBR_TRANSMISSION only. */
  readonly side?: { readonly inside: boolean; readonly outerIor: number };
}

/** What the shader made of it. */
export interface GpuResult {
  readonly f: OpenPbrVector;
  readonly pdf: number;
  readonly together: OpenPbrVector;
  readonly togetherPdf: number;
  readonly wi: OpenPbrVector;
  readonly samplePdf: number;
  readonly weight: OpenPbrVector;
  readonly valid: boolean;
  readonly transmitted: boolean;
  readonly subsurface: boolean;
  readonly emission: OpenPbrVector;
  readonly opacity: number;
  readonly albedo: OpenPbrVector;
}

const { dielectric, conductor } = OPENPBR_TABLES;

/** Both tables, for a buffer. */
export function tableData(): Float32Array<ArrayBuffer> {
  const tables = new Float32Array(dielectric.data.length + conductor.data.length);
  tables.set(dielectric.data);
  tables.set(conductor.data, dielectric.data.length);
  return tables;
}

/** The host's accessors of the tables in `tables: array<f32>`, filtered by hand. */
export const TABLES_WGSL = /* wgsl */ `fn table_row(at: u32, y: u32, z: u32, size: vec3u, x: vec3f) -> f32 {
  let base = at + (z * size.y + y) * size.x;
  let low = u32(x.x);
  return mix(tables[base + low], tables[base + min(low + 1u, size.x - 1u)], x.x - f32(low));
}
fn table(at: u32, size: vec3u, coords: vec3f) -> f32 {
  let x = clamp(coords * vec3f(size) - 0.5, vec3f(0.0), vec3f(size) - 1.0);
  let low = vec3u(x);
  let high = min(low + 1u, size - 1u);
  let w = x - vec3f(low);
  let near = mix(table_row(at, low.y, low.z, size, x), table_row(at, high.y, low.z, size, x), w.y);
  let far = mix(table_row(at, low.y, high.z, size, x), table_row(at, high.y, high.z, size, x), w.y);
  return mix(near, far, w.z);
}
fn openpbr_table_dielectric(coords: vec3f) -> f32 { return table(0u, vec3u(${dielectric.width}u, ${dielectric.height}u, ${dielectric.depth}u), coords); }
fn openpbr_table_conductor(coords: vec2f) -> f32 { return table(${dielectric.data.length}u, vec3u(${conductor.width}u, ${conductor.height}u, 1u), vec3f(coords, 0.5)); }`;

/** The host's part: the tables in a buffer, filtered by hand, so that the precision is that of the arithmetic. */
const host = (transmission: boolean) =>
  wgslModule(
    'test/host',
    /* wgsl */ `
struct Case { wo: vec4f, wi: vec4f, u: vec4f }
struct Result { f: vec3f, pdf: f32, together: vec4f, wi: vec3f, sample_pdf: f32, weight: vec3f, valid: f32, emission: vec3f, opacity: f32, albedo: vec4f }
@group(0) @binding(0) var<storage, read> tables: array<f32>;
@group(0) @binding(1) var<storage, read> materials: array<OpenPbrParameters>;
@group(0) @binding(2) var<storage, read> cases: array<Case>;
@group(0) @binding(3) var<storage, read_write> results: array<Result>;

${TABLES_WGSL}

@compute @workgroup_size(64) fn main(@builtin(global_invocation_id) id: vec3u) {
  if (id.x >= arrayLength(&cases)) { return; }
  let p = materials[id.x];
  let wo = cases[id.x].wo.xyz;
  let wi = cases[id.x].wi.xyz;
  let b = ${transmission ? 'openpbr_prepare_side(p, wo, OpenPbrSide(cases[id.x].wo.w != 0.0, cases[id.x].wi.w))' : 'openpbr_prepare(p, wo)'};
  let s = openpbr_sample(b, wo, cases[id.x].u.xyz);
  let together = openpbr_eval_pdf(b, wo, wi);
  // Both by themselves where that is quick to compile: they are the same function's parts.
  var alone = together;
  ${transmission ? '' : 'alone = vec4f(openpbr_eval(b, wo, wi), openpbr_pdf(b, wo, wi));'}
  results[id.x] = Result(
    alone.xyz, alone.w, together,
    s.wi, s.pdf, s.weight, f32(s.valid) + 2.0 * f32(s.transmitted) + 4.0 * f32(s.subsurface), openpbr_emission(p, wo), openpbr_opacity(p), vec4f(openpbr_albedo(b, wo), 0.0));
}`,
    [openpbr],
  );

/** The shader text for a set of flags. */
export const gpuShader = (flags: OpenPbrFlags) =>
  compose(
    [
      host(flags.OPENPBR_TRANSMISSION),
      ...(flags.OPENPBR_LOBES ? [openpbrLobes] : []),
      ...(flags.OPENPBR_THIN_FILM ? [openpbrFilm] : []),
    ],
    { flags: { ...flags } },
  );

/** Runs the public WGSL functions over the cases on the test device. */
export async function onGpu(flags: OpenPbrFlags, cases: readonly GpuCase[]): Promise<GpuResult[]> {
  const tables = tableData();
  const materials = openPbrStruct.allocate(cases.length);
  cases.forEach((one, i) => packOpenPbr(materials, i, one.parameters));
  const directions = new Float32Array(
    cases.flatMap(({ wo, wi, u, side }) => [...wo, Number(side?.inside ?? false), ...wi, side?.outerIor ?? 1, ...u, 0]),
  );
  const words = 24;
  const bytes = await runCompute(await testDevice({ driver: 'swiftshader' }), gpuShader(flags).code, {
    inputs: [tables, materials, directions],
    outputBytes: cases.length * words * 4,
    workgroups: Math.ceil(cases.length / 64),
  });
  const out = new Float32Array(bytes);
  return cases.map((_, i) => {
    const word = (k: number) => out[i * words + k] as number;
    const triple = (k: number): OpenPbrVector => [word(k), word(k + 1), word(k + 2)];
    return {
      f: triple(0),
      pdf: word(3),
      together: triple(4),
      togetherPdf: word(7),
      wi: triple(8),
      samplePdf: word(11),
      weight: triple(12),
      valid: (word(15) & 1) === 1,
      transmitted: (word(15) & 2) > 0,
      subsurface: (word(15) & 4) > 0,
      emission: triple(16),
      opacity: word(19),
      albedo: triple(20),
    };
  });
}
