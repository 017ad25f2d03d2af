import { basename, resolve } from 'node:path';
import { parseArgs } from 'node:util';
import { sceneBounds, validateScene, type Scene } from '@glanz/scene';
import type { Backend } from '../backend';
import { CliError, EXIT } from '../errors';
import { checkInput } from '../input';
import type { CliIo } from '../io';
import type { PoseOptions, ReportOptions } from '../options';
import { jsonLine, visible } from '../visible';

/** `glanz info`. */
export interface InfoCommand extends ReportOptions {
  readonly kind: 'info';
  readonly model: string;
  readonly pose: PoseOptions;
}

const usage = (message: string) => new CliError('cli/usage', message);

/**
 * Reads the arguments behind `info`.
 * @throws {CliError} `cli/usage`
 */
export function parseInfo(argv: readonly string[]): InfoCommand {
  let parsed;
  try {
    parsed = parseArgs({
      args: [...argv],
      allowPositionals: true,
      strict: true,
      options: { scene: { type: 'string' }, json: { type: 'boolean' }, quiet: { type: 'boolean', short: 'q' } },
    });
  } catch (cause) {
    throw usage(`${((cause as Error).message.split('\n')[0] as string).replace(/\.?$/, '.')} See glanz help info.`);
  }
  const {
    values,
    positionals: [model, ...rest],
  } = parsed;
  if (model === undefined) throw usage('No model given. Use glanz info MODEL.');
  if (rest.length > 0) throw usage(`One model at a time: unexpected argument "${rest[0]}".`);
  const scene =
    values.scene === undefined ? undefined : /^\d+$/.test(values.scene) ? Number(values.scene) : values.scene;
  return {
    kind: 'info',
    json: values.json ?? false,
    quiet: values.quiet ?? false,
    model,
    pose: scene === undefined ? {} : { scene },
  };
}

/** What `--json` prints. */
export interface ModelInfo {
  readonly model: string;
  /** In all places. */
  readonly triangles: number;
  /** Held in memory: a mesh in many places counts once. */
  readonly meshTriangles: number;
  readonly meshes: number;
  readonly instances: number;
  /** Metres. */
  readonly bounds?: {
    readonly min: readonly number[];
    readonly max: readonly number[];
    readonly size: readonly number[];
  };
  readonly parts: readonly string[];
  readonly materials: readonly string[];
  readonly images: readonly { readonly name: string; readonly width: number; readonly height: number }[];
  readonly textures: number;
  readonly cameras: readonly { readonly name: string; readonly type: string }[];
  readonly lights: readonly { readonly name: string; readonly type: string }[];
  readonly environment: string;
  readonly variants: readonly string[];
  readonly animations: readonly { readonly name: string; readonly duration: number }[];
  /** Bytes of arrays and images in memory. */
  readonly memoryBytes: { readonly geometry: number; readonly images: number };
  readonly metadata: Readonly<Record<string, unknown>>;
  readonly warnings: readonly { readonly code: string; readonly message: string; readonly path?: string }[];
}

/** The contents of a scene, without rendering it. */
export function describeScene(scene: Scene, model: string): ModelInfo {
  const {
    meshes,
    instances,
    materials,
    images,
    textures,
    cameras,
    lights,
    environment,
    variants = [],
    animations = [],
    metadata = {},
  } = scene;
  const { min, max } = sceneBounds(scene);
  const bytes = (arrays: readonly (ArrayBufferView | undefined)[]) =>
    arrays.reduce((sum, array) => sum + (array?.byteLength ?? 0), 0);
  return {
    model,
    triangles: instances.reduce((sum, { mesh }) => sum + (meshes[mesh]?.indices.length ?? 0) / 3, 0),
    meshTriangles: meshes.reduce((sum, { indices }) => sum + indices.length / 3, 0),
    meshes: meshes.length,
    instances: instances.length,
    ...(min[0] <= max[0]
      ? { bounds: { min: [...min], max: [...max], size: min.map((low, k) => (max[k] as number) - low) } }
      : {}),
    parts: [...new Set(instances.map(({ name }) => name))],
    materials: materials.map(({ name }) => name),
    images: images.map(({ name, width, height }) => ({ name, width, height })),
    textures: textures.length,
    cameras: cameras.map(({ name = '', type }) => ({ name, type })),
    lights: lights.map(({ name = '', type }) => ({ name, type })),
    environment: environment
      ? environment.type === 'latlong'
        ? `${environment.width}×${environment.height}`
        : 'constant'
      : 'none',
    variants,
    animations,
    memoryBytes: {
      geometry: meshes.reduce(
        (sum, { positions, indices, normals, tangents, colors, uvs = [] }) =>
          sum + bytes([positions, indices, normals, tangents, colors, ...uvs]),
        0,
      ),
      images: images.reduce((sum, { data }) => sum + data.byteLength, 0),
    },
    metadata,
    warnings: [...scene.warnings, ...validateScene(scene)],
  };
}

const some = (names: readonly string[], max = 12) =>
  names.length === 0 ? 'none' : `${names.length}: ${names.slice(0, max).join(', ')}${names.length > max ? ', …' : ''}`;
const length = (metres: number) => `${Number(metres.toPrecision(4))}`;
const megabytes = (count: number) => `${(count / 1e6).toFixed(1)} MB`;

function lines(info: ModelInfo): string[] {
  const { bounds, memoryBytes } = info;
  const said = Object.entries(info.metadata).flatMap(([key, value]) =>
    typeof value === 'string' ? [[key, value.replace(/\s+/g, ' ').slice(0, 120)] as const] : [],
  );
  const rows: (readonly [string, string])[] = [
    [
      'triangles',
      `${info.triangles.toLocaleString('en')}${info.triangles === info.meshTriangles ? '' : ` (${info.meshTriangles.toLocaleString('en')} in ${info.meshes} meshes)`}`,
    ],
    ['parts', some(info.parts)],
    ['size', bounds ? `${bounds.size.map(length).join(' × ')} m, from ${bounds.min.map(length).join(', ')}` : 'empty'],
    ['materials', some(info.materials)],
    ['images', some(info.images.map(({ name, width, height }) => `${name || '–'} ${width}×${height}`))],
    ['cameras', some(info.cameras.map(({ name, type }, i) => `${i} "${name}" ${type}`))],
    ['lights', some(info.lights.map(({ name, type }) => `"${name}" ${type}`))],
    ['environment', info.environment],
    ['variants', some(info.variants.map((name) => `"${name}"`))],
    ['animations', some(info.animations.map(({ name, duration }) => `"${name}" ${Number(duration.toFixed(3))} s`))],
    ['memory', `${megabytes(memoryBytes.geometry)} of geometry, ${megabytes(memoryBytes.images)} of images`],
    ...said,
  ];
  return [
    ...rows.map(([name, text]) => `${name.padEnd(13)} ${text}`),
    ...info.warnings.map(({ code, message }) => `warning       ${message} [${code}]`),
  ];
}

/** `glanz info`: what a model holds, and what is odd about it. Gives the exit code. */
export async function infoCommand({ model, pose, json }: InfoCommand, io: CliIo, backend: Backend): Promise<number> {
  await checkInput(model, io.cwd, 'the model');
  const info = describeScene(
    await backend.loadModel(resolve(io.cwd, model), new AbortController().signal, pose),
    model,
  );
  io.stdout(
    json
      ? jsonLine({ ok: true, ...info })
      : `${[basename(model), ...lines(info).map((line) => `  ${line}`)].map(visible).join('\n')}\n`,
  );
  return EXIT.ok;
}
