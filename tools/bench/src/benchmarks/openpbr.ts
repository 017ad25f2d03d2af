import { toHalf } from '@glanz/image';
import {
  openpbr,
  openPbrStruct,
  packOpenPbr,
  requiredFeatures,
  resolveParameters,
  type OpenPbrParameters,
} from '@glanz/openpbr';
import { openpbrFilm } from '@glanz/openpbr/film';
import { OPENPBR_TABLES } from '@glanz/openpbr/tables';
import { requestDevice } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { compose, wgslModule } from '@glanz/wgsl';
import { timed, type Benchmark, type Figure } from '../benchmark';

const BASE: Partial<OpenPbrParameters> = { base_color: [0.8, 0.5, 0.3], specular_roughness: 0.4 };
const COAT: Partial<OpenPbrParameters> = { coat_weight: 0.8, coat_roughness: 0.2, coat_color: [0.9, 0.8, 0.7] };
const FUZZ: Partial<OpenPbrParameters> = { fuzz_weight: 0.5, fuzz_roughness: 0.6 };
const GLASS: Partial<OpenPbrParameters> = { transmission_weight: 0.6, transmission_color: [0.9, 0.8, 0.7] };
const METAL: Partial<OpenPbrParameters> = { base_metalness: 0.3 };
const FILM: Partial<OpenPbrParameters> = { thin_film_weight: 0.7, thin_film_thickness: 0.4 };

/** What a scene's materials hold; the kernel has the text of these lobes only. */
const SETS: readonly (readonly [name: string, materials: readonly Partial<OpenPbrParameters>[]])[] = [
  ['base', [BASE]],
  ['base and metal', [{ ...BASE, ...METAL }]],
  ['base and coat', [{ ...BASE, ...COAT }]],
  ['base and fuzz', [{ ...BASE, ...FUZZ }]],
  ['base and transmission', [{ ...BASE, ...GLASS }]],
  ['base and thin film', [{ ...BASE, ...FILM }]],
  [
    'everything but film',
    [
      {
        ...BASE,
        ...METAL,
        ...COAT,
        ...FUZZ,
        ...GLASS,
        subsurface_weight: 0.3,
        base_diffuse_roughness: 0.3,
        specular_roughness_anisotropy: 0.3,
        emission_luminance: 1,
      },
    ],
  ],
  [
    'everything',
    [
      {
        ...BASE,
        ...METAL,
        ...COAT,
        ...FUZZ,
        ...GLASS,
        ...FILM,
        subsurface_weight: 0.3,
        base_diffuse_roughness: 0.3,
        specular_roughness_anisotropy: 0.3,
        emission_luminance: 1,
      },
    ],
  ],
];

const GROUP = 64;
const LOOPS = 16;

/**
 * A path's work at a surface: prepare, a sample, and the value and density for a light. "salt" keeps drivers' caches
 * out.
 */
const kernel = (salt: number) =>
  wgslModule(
    'bench/openpbr',
    /* wgsl */ `
@group(0) @binding(0) var<storage, read> materials: array<OpenPbrParameters>;
@group(0) @binding(1) var<storage, read_write> results: array<vec4f>;
@group(0) @binding(2) var dielectric: texture_3d<f32>;
@group(0) @binding(3) var conductor: texture_2d<f32>;
@group(0) @binding(4) var linear: sampler;
fn openpbr_table_dielectric(coords: vec3f) -> f32 { return textureSampleLevel(dielectric, linear, coords, 0.0).x; }
fn openpbr_table_conductor(coords: vec2f) -> f32 { return textureSampleLevel(conductor, linear, coords, 0.0).x; }

fn next(state: ptr<function, u32>) -> f32 {
  *state = *state * 747796405u + 2891336453u;
  let word = ((*state >> ((*state >> 28u) + 4u)) ^ *state) * 277803737u;
  return f32(((word >> 22u) ^ word) >> 8u) * 5.9604645e-8;
}
fn upper(state: ptr<function, u32>) -> vec3f {
  let z = 0.05 + 0.95 * next(state);
  let angle = 6.2831853 * next(state);
  return vec3f(sqrt(1.0 - z * z) * vec2f(cos(angle), sin(angle)), z);
}

@compute @workgroup_size(${GROUP}) fn main(@builtin(global_invocation_id) id: vec3u) {
  var state = id.x * 9781u + ${salt}u;
  var sum = vec4f(0.0);
  for (var i = 0u; i < ${LOOPS}u; i++) {
    let p = materials[(id.x + i) % arrayLength(&materials)];
    let wo = upper(&state);
    let b = openpbr_prepare(p, wo);
    let s = openpbr_sample(b, wo, vec3f(next(&state), next(&state), next(&state)));
    sum += vec4f(s.weight, s.pdf);
    sum += openpbr_eval_pdf(b, wo, upper(&state));
  }
  results[id.x] = sum;
}`,
    [openpbr],
  );

/**
 * Shaded samples a second, one a thread and loop, by the lobes that the materials have, and what the kernel takes to
 * compile.
 */
export const benchmark: Benchmark = {
  description: 'OpenPBR: shaded samples a second and cold compile time, by lobes',
  async run({ log, quick, gpu, seed = Math.floor(performance.timeOrigin + performance.now()) % 1_000_000 }) {
    const { gpu: api, adapterName, software } = await createGpu(gpu === undefined ? {} : { gpu });
    const small = quick || software;
    const threads = small ? 1 << 14 : 1 << 21;
    const runs = small ? 3 : 9;
    const figures: Figure[] = [];
    for (const [k, [name, materials]] of SETS.entries()) {
      // A device of its own for each: nothing compiled before helps.
      const device = await requestDevice({ gpu: api });
      const flags = requiredFeatures(materials);
      const modules = [kernel(seed * SETS.length + k), ...(flags.OPENPBR_THIN_FILM ? [openpbrFilm] : [])];
      const { code } = compose(modules, { flags: { ...flags } });
      const create = performance.now();
      const module = device.createShaderModule({ code });
      const visibility = GPUShaderStage.COMPUTE;
      const layout = device.createBindGroupLayout({
        entries: [
          { binding: 0, visibility, buffer: { type: 'read-only-storage' } },
          { binding: 1, visibility, buffer: { type: 'storage' } },
          { binding: 2, visibility, texture: { viewDimension: '3d' } },
          { binding: 3, visibility, texture: {} },
          { binding: 4, visibility, sampler: {} },
        ],
      });
      const pipeline = await device.createComputePipelineAsync({
        layout: device.createPipelineLayout({ bindGroupLayouts: [layout] }),
        compute: { module, entryPoint: 'main' },
      });
      const created = performance.now() - create;
      const records = openPbrStruct.allocate(materials.length);
      materials.forEach((material, i) => packOpenPbr(records, i, resolveParameters(material)));
      const buffer = device.createBuffer({
        size: records.byteLength,
        usage: GPUBufferUsage.STORAGE | GPUBufferUsage.COPY_DST,
      });
      device.queue.writeBuffer(buffer, 0, records);
      const results = device.createBuffer({ size: threads * 16, usage: GPUBufferUsage.STORAGE });
      const textures = (['dielectric', 'conductor'] as const).map((table) => {
        const { width, height, depth, data } = OPENPBR_TABLES[table];
        const texture = device.createTexture({
          size: [width, height, depth],
          dimension: table === 'dielectric' ? '3d' : '2d',
          format: 'r16float',
          usage: GPUTextureUsage.TEXTURE_BINDING | GPUTextureUsage.COPY_DST,
        });
        device.queue.writeTexture(
          { texture },
          Uint16Array.from(data, toHalf),
          { bytesPerRow: width * 2, rowsPerImage: height },
          [width, height, depth],
        );
        return texture.createView();
      });
      const sampler = device.createSampler({ magFilter: 'linear', minFilter: 'linear' });
      const resources: GPUBindingResource[] = [{ buffer }, { buffer: results }, ...textures, sampler];
      const bind = device.createBindGroup({
        layout,
        entries: resources.map((resource, binding) => ({ binding, resource })),
      });
      const dispatch = async (times: number, groups = threads / GROUP) => {
        const encoder = device.createCommandEncoder();
        const pass = encoder.beginComputePass();
        pass.setPipeline(pipeline);
        pass.setBindGroup(0, bind);
        for (let i = 0; i < times; i++) pass.dispatchWorkgroups(groups);
        pass.end();
        const from = performance.now();
        device.queue.submit([encoder.finish()]);
        await device.queue.onSubmittedWorkDone();
        return performance.now() - from;
      };
      // Some drivers compile no sooner than at the first use.
      const compile = created + (await dispatch(1, 1));
      await dispatch(1);
      const once = await dispatch(1);
      const times = small ? 1 : Math.max(1, Math.ceil(100 / Math.max(once, 0.1)));
      const rates: number[] = [];
      for (let i = 0; i < runs; i++) rates.push((threads * LOOPS * times) / (await dispatch(times)) / 1e3);
      figures.push(timed(`${name}: shaded samples`, 'M/s', rates));
      const limit = name === 'everything' ? (software ? 10_000 : 1500) : undefined;
      figures.push(
        timed(
          `${name}: compile, cold`,
          'ms',
          [compile],
          limit === undefined ? undefined : { value: limit, relation: '<=', source: 'aim' },
        ),
      );
      log(
        `${name}: ${(figures.at(-2)?.median ?? 0).toFixed(2)} M/s, compiled in ${compile.toFixed(0)} ms, ${code.length} characters`,
      );
      device.destroy();
    }
    return {
      settings: { threads, loops: LOOPS, group: GROUP, sets: Object.fromEntries(SETS) },
      gpu: { name: adapterName, software },
      figures,
    };
  },
};
