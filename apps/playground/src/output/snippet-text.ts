import type { Scene } from '@glanz/scene';
import type { State } from '../state/state';
import { placedTransform } from '../viewer/placement';

/** Six digits are more than a slider gives. */
export const digits = (value: unknown): unknown => (typeof value === 'number' ? Number(value.toPrecision(6)) : value);
/** A text as TypeScript writes it. */
export const quoted = (text: string) =>
  `'${text.replaceAll('\\', '\\\\').replaceAll("'", "\\'").replaceAll('\n', '\\n')}'`;

/** A value as a person would write it in TypeScript. */
export function literal(value: unknown, depth = 0): string {
  if (Array.isArray(value) || ArrayBuffer.isView(value)) {
    const items = Array.from(value as unknown as unknown[]);
    if (items.every((item) => typeof item !== 'object')) return `[${items.map((item) => literal(item)).join(', ')}]`;
    const pad = '  '.repeat(depth + 1);
    return `[\n${items.map((item) => `${pad}${literal(item, depth + 1)},`).join('\n')}\n${'  '.repeat(depth)}]`;
  }
  if (typeof value === 'object' && value !== null)
    return `{ ${Object.entries(value)
      .map(([key, item]) => `${/^[A-Za-z_$][\w$]*$/.test(key) ? key : quoted(key)}: ${literal(item, depth)}`)
      .join(', ')} }`;
  return typeof value === 'string' ? quoted(value) : String(digits(value));
}

/**
 * Where a program finds the model. Samples are files as `tools/models/write.mjs` writes them.
 *
 * @param name Of the file or sample.
 */
export const addressOf = (name: string): string =>
  `/${name.includes('.') ? name : name === 'push-button' ? 'push-button-medium.glb' : `${name}.glb`}`;

/** Whether a name chooses a material or a part in calls: it has one, and no other one has the same. */
export function isNamed(list: readonly { readonly name?: string | undefined }[], index: number): boolean {
  const name = list[index]?.name;
  return !!name && !list.some((other, i) => i !== index && other.name === name);
}

/** What chooses a material or a part in calls: its name, or its index where that says nothing. */
export const keyOf = (list: readonly { readonly name?: string | undefined }[], index: number): string =>
  isNamed(list, index) ? quoted(list[index]?.name as string) : String(index);

/** Parts that have been moved, with their transforms. */
export const movedParts = (scene: Scene, { moves }: State): (readonly [part: number, transform: string])[] =>
  Object.keys(moves).map((part) => [Number(part), literal(Array.from(placedTransform(scene, Number(part), moves)))]);

/** Whether a state is lit by the studio that viewers have by themselves. */
export const isPlainStudio = ({ environment, studio, boxes }: State): boolean =>
  environment === 'studio' && studio === 'neutral' && !boxes;

/** The studio of a state as an expression, with what it imports; dimmed and turned by `options`. */
function studioCode({ studio, boxes }: State, options: Readonly<Record<string, unknown>> = {}) {
  const plain = studio === 'neutral' && !boxes;
  const setup = boxes ? `{ ...STUDIOS[${quoted(studio)}], boxes: ${literal(boxes)} }` : `STUDIOS[${quoted(studio)}]`;
  const fields = [
    ...(plain ? [] : [`setup: ${setup}`]),
    ...Object.entries(options).map(([key, value]) => `${key}: ${literal(value)}`),
  ];
  return {
    imports: [`import { ${plain ? '' : 'STUDIOS, '}studioEnvironment } from '@glanz/scene/studio';`],
    value: `studioEnvironment(${fields.length > 0 ? `{ ${fields.join(', ')} }` : ''})`,
  };
}

/** What lights the model as the viewer's `environment`; undefined where that is its default. */
export function environmentSource(state: State): { readonly imports: string[]; readonly value: string } | undefined {
  const { environment, constant, intensity } = state;
  if (environment === 'model') return undefined;
  if (environment === 'none') return { imports: [], value: quoted('none') };
  if (environment === 'file') return { imports: [], value: quoted('/environment.hdr') };
  if (environment === 'constant')
    return { imports: [], value: literal({ type: 'constant', radiance: constant.map((c) => c * intensity) }) };
  return isPlainStudio(state) ? { imports: [], value: quoted('studio') } : studioCode(state);
}

/** Factor and turn of an environment that has them, radians; undefined where they are the default. */
export const environmentView = ({
  environment,
  intensity,
  rotation,
}: State): { readonly intensity?: number; readonly rotation?: number } =>
  environment === 'none' || environment === 'constant'
    ? {}
    : {
        ...(intensity === 1 ? {} : { intensity }),
        ...(rotation === 0 ? {} : { rotation: (rotation * Math.PI) / 180 }),
      };

/** Statements that give a scene the environment of a state. */
export function environmentLines(state: State): { readonly imports: string[]; readonly lines: string[] } {
  const { environment, constant, intensity, rotation } = state;
  const turn = rotation === 0 ? {} : { rotation: (rotation * Math.PI) / 180 };
  const dim = intensity === 1 ? {} : { intensity };
  if (environment === 'none') return { imports: [], lines: ['delete scene.environment;'] };
  if (environment === 'constant')
    return {
      imports: [],
      lines: [`scene.environment = ${literal({ type: 'constant', radiance: constant.map((c) => c * intensity) })};`],
    };
  if (environment === 'file') {
    return {
      imports: ["import { decodeEnvironment } from '@glanz/image/environment';"],
      lines: [
        "const image = decodeEnvironment(new Uint8Array(await (await fetch('/environment.hdr')).arrayBuffer()));",
        `scene.environment = { type: 'latlong', ...image${Object.entries({ ...dim, ...turn })
          .map(([key, value]) => `, ${key}: ${literal(value)}`)
          .join('')} };`,
      ],
    };
  }
  const { imports, value } = studioCode(state, { ...dim, ...turn });
  return { imports, lines: [`scene.environment ${environment === 'model' ? '??=' : '='} ${value};`] };
}
