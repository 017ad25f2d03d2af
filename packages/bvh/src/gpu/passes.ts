import { BVH_GPU_FEW_TILES } from './constants.wesl';
import { COPY_DST, UNIFORM, type Kernel, type PassClock } from './device';
import type { CommonKernels, SortKernels } from './kernels';
import type { BuildPlan, ScratchName } from './plan';

/** Bytes from one set of numbers to the next, as offsets of bindings must be aligned. */
const PARAMS_STRIDE = 256;
const PARAMS_BYTES = 48;

/** Numbers of a dispatch, see `BvhGpuParams`. */
export interface Params {
  readonly count: number;
  readonly vertices: number;
  readonly maxLeaf: number;
  readonly maxDepth: number;
  readonly level?: number;
  readonly firstDraft?: number;
  readonly draftBase?: number;
  readonly firstHead?: number;
  readonly shift?: number;
  readonly tiles?: number;
  readonly holes?: number;
}

/** One dispatch. */
export interface Step {
  readonly kernel: Kernel;
  readonly params?: Params;
  readonly buffers: Readonly<Record<number, GPUBuffer>>;
  readonly workgroups: number;
}

/** The dispatches of a build, in the order of its phases. */
export interface Phases {
  readonly primitives: readonly Step[];
  readonly sort: readonly Step[];
  readonly cluster: readonly Step[];
  readonly layout: readonly Step[];
}

/** Words of a set of numbers. */
function words(p: Params): readonly number[] {
  const { level = 0, firstDraft = 0, draftBase = 0, firstHead = 0, shift = 0, tiles = 0, holes = 0 } = p;
  return [p.count, p.vertices, p.maxLeaf, p.maxDepth, level, firstDraft, draftBase, firstHead, shift, tiles, holes];
}

/** The steps of a pass of the sort; buffers are keys and values. */
export function sortPass(
  kernels: SortKernels,
  params: Params & { readonly tiles: number },
  globals: GPUBuffer,
  digits: GPUBuffer,
  from: readonly [GPUBuffer, GPUBuffer],
  to: readonly [GPUBuffer, GPUBuffer],
): Step[] {
  const { tiles } = params;
  return [
    { kernel: kernels.histogram, params, buffers: { 1: globals, 2: from[0], 3: digits }, workgroups: tiles },
    { kernel: kernels.scan, params, buffers: { 1: digits }, workgroups: tiles <= BVH_GPU_FEW_TILES ? 1 : 256 },
    {
      kernel: kernels.scatter,
      params,
      buffers: { 1: globals, 2: digits, 3: from[0], 4: from[1], 5: to[0], 6: to[1] },
      workgroups: tiles,
    },
  ];
}

/** Lists what a build over an input dispatches. */
export function listPhases(
  plan: BuildPlan,
  kernels: CommonKernels,
  scratch: Readonly<Record<ScratchName, GPUBuffer>>,
  input: { readonly kernel: Kernel; readonly buffers: Readonly<Record<number, GPUBuffer>>; readonly params: Params },
): Phases {
  const { count, tiles, levels } = plan;
  const { params } = input;
  const { globals, primitives, digits, places, heads, nodes, order } = scratch;
  const threads = Math.ceil(count / 256);
  const codes = (level: number, side: 'A' | 'B') => ({
    kernel: kernels.codes,
    params: { ...params, level },
    buffers: { 1: primitives, 2: globals, 3: scratch[`keys ${side}`], 4: scratch[`values ${side}`] },
    workgroups: threads,
  });
  // Three passes by the lower codes, and three by the upper ones.
  const sort = [0, 1, 2, 3, 4, 5].flatMap((pass) => {
    const [from, to] = pass % 2 === 0 ? (['A', 'B'] as const) : (['B', 'A'] as const);
    return [
      ...(pass === 3 ? [codes(1, from)] : []),
      ...sortPass(
        kernels,
        { ...params, shift: 8 * (pass % 3), tiles, holes: pass === 0 ? 1 : 0 },
        globals,
        digits,
        [scratch[`keys ${from}`], scratch[`values ${from}`]],
        [scratch[`keys ${to}`], scratch[`values ${to}`]],
      ),
    ];
  });
  const levelParams = levels.map(({ firstDraft, firstHead }, level): Params => ({
    ...params,
    level,
    firstDraft,
    firstHead,
    draftBase: level === 0 ? 0 : (levels[1]?.firstDraft ?? 0),
  }));
  const drafts = (level: number) => scratch[level === 0 ? 'lowest drafts' : 'drafts'];
  const clusters = (level: number) => scratch[level % 2 === 0 ? 'clusters A' : 'clusters B'];
  return {
    primitives: [
      {
        kernel: input.kernel,
        params,
        buffers: { ...input.buffers, 3: primitives, 4: globals },
        workgroups: threads,
      },
      codes(0, 'A'),
    ],
    sort,
    cluster: levels.map(({ blocks }, level) => ({
      kernel: level === 0 ? kernels.lowest : kernels.cluster,
      params: levelParams[level] as Params,
      buffers: {
        1: globals,
        ...(level === 0 ? { 2: scratch['values A'], 3: primitives } : { 2: clusters(level - 1) }),
        4: clusters(level),
        5: drafts(level),
        6: places,
        7: heads,
      },
      workgroups: blocks,
    })),
    layout: [
      { kernel: kernels.root, buffers: { 1: globals, 2: heads, 3: places, 5: nodes, 6: order }, workgroups: 1 },
      ...levels
        .map(({ blocks }, level) => ({
          kernel: kernels.place,
          params: levelParams[level] as Params,
          buffers: { 1: globals, 2: drafts(level), 3: places, 4: heads, 5: nodes, 6: order },
          workgroups: blocks,
        }))
        .reverse(),
    ],
  };
}

/** The numbers of all steps, for a uniform buffer. */
function paramsOf(steps: readonly Step[]): Uint32Array<ArrayBuffer> {
  const data = new Uint32Array((PARAMS_STRIDE / 4) * steps.length);
  for (const [i, { params }] of steps.entries()) if (params) data.set(words(params), (PARAMS_STRIDE / 4) * i);
  return data;
}

/** Makes the buffer of all steps' numbers. */
function makeUniforms(device: GPUDevice, steps: readonly Step[]): GPUBuffer {
  const size = PARAMS_STRIDE * steps.length;
  const uniforms = device.createBuffer({ label: 'bvh numbers', size, usage: UNIFORM | COPY_DST });
  device.queue.writeBuffer(uniforms, 0, paramsOf(steps));
  return uniforms;
}

/**
 * Binds what a step reads and writes.
 *
 * @param uniforms Numbers, of which the step's are at `index`.
 */
function bindStep(
  device: GPUDevice,
  { kernel, params, buffers }: Step,
  uniforms: GPUBuffer,
  index: number,
): GPUBindGroup {
  const entries = Object.entries(buffers).map(([binding, buffer]): GPUBindGroupEntry => ({
    binding: Number(binding),
    resource: { buffer },
  }));
  if (params)
    entries.push({
      binding: 0,
      resource: { buffer: uniforms, offset: PARAMS_STRIDE * index, size: PARAMS_BYTES },
    });
  return device.createBindGroup({ layout: kernel.layout, entries });
}

/** Records a step. */
function encodeStep(
  device: GPUDevice,
  pass: GPUComputePassEncoder,
  { kernel, workgroups }: Step,
  group: GPUBindGroup,
): void {
  pass.setPipeline(kernel.pipeline);
  pass.setBindGroup(0, group);
  // Rows of workgroups, of which the last may be longer than needed.
  const rows = Math.ceil(workgroups / device.limits.maxComputeWorkgroupsPerDimension);
  pass.dispatchWorkgroups(Math.ceil(workgroups / rows), rows);
}

/** Steps that are recorded repeatedly: what they bind is made once. */
export interface PreparedSteps {
  /** Records them in a pass. */
  encode(encoder: GPUCommandEncoder): void;
  /** Frees what was allocated. What is submitted still runs. */
  destroy(): void;
}

/** Prepares steps. */
export function prepareSteps(device: GPUDevice, label: string, steps: readonly Step[]): PreparedSteps {
  const some = steps.filter(({ workgroups }) => workgroups > 0);
  const uniforms = makeUniforms(device, some);
  const groups = some.map((step, i) => bindStep(device, step, uniforms, i));
  return {
    encode(encoder) {
      const pass = encoder.beginComputePass({ label });
      some.forEach((step, i) => encodeStep(device, pass, step, groups[i] as GPUBindGroup));
      pass.end();
    },
    destroy: () => uniforms.destroy(),
  };
}

/** Submits phases, each in a pass. */
export function submitPhases(
  device: GPUDevice,
  phases: readonly (readonly [string, readonly Step[]])[],
  { globals, clock }: { readonly globals?: GPUBuffer; readonly clock?: PassClock | undefined } = {},
): void {
  const all = phases.flatMap(([, steps]) => steps);
  const uniforms = makeUniforms(device, all);
  const encoder = device.createCommandEncoder({ label: 'bvh build' });
  if (globals) encoder.clearBuffer(globals);
  let index = 0;
  for (const [name, steps] of phases) {
    const pass = encoder.beginComputePass({
      label: `bvh ${name}`,
      ...(clock ? { timestampWrites: clock.writes(name) } : {}),
    });
    for (const step of steps) {
      const at = index++;
      if (step.workgroups > 0) encodeStep(device, pass, step, bindStep(device, step, uniforms, at));
    }
    pass.end();
  }
  clock?.resolve(encoder);
  device.queue.submit([encoder.finish()]);
  // Freed once the GPU is done.
  uniforms.destroy();
}
