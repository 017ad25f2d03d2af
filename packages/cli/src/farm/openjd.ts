import { isAbsolute, relative, resolve } from 'node:path';
import type { StoreAddress } from '@glanz/farm';
import { isEnvironmentFile } from '../environment';
import { CliError } from '../errors';
import { OPTIONS, type RenderValues } from '../options';
import { fileNamePart } from '../views';
import type { PlannedImage } from './plan';

/** What a template is made of. */
export interface OpenJdOptions {
  /** Absolute paths; of the template's own folder, too. */
  readonly folder: string;
  readonly batch: string;
  readonly store: StoreAddress;
  readonly outputRoot: string;
  readonly cwd: string;
  readonly split: number | undefined;
  readonly gpu: string | undefined;
  /** What the command line says of images. */
  readonly values: RenderValues;
}

/** An image by the names of its variant and its view, as `--image` takes it. */
export const imageName = ({ shot: { variant, view } }: Pick<PlannedImage, 'shot'>): string =>
  `${variant === undefined ? 'default' : fileNamePart(variant)}/${view.name}`;

/** Longest list of texts that the format allows for a parameter. */
const MAX_LIST = 1024;

/** The command line's options, with files by absolute paths: a task runs in a folder of its own. */
function optionArguments(values: RenderValues, cwd: string): string[] {
  const out: string[] = [];
  const absolute = (path: string) => (isAbsolute(path) ? path : resolve(cwd, path));
  for (const [name, value] of Object.entries(values) as [keyof typeof OPTIONS, unknown][]) {
    if (value === undefined || value === false || !Object.hasOwn(OPTIONS, name)) continue;
    if (value === true) out.push(`--${name}`);
    else
      for (const text of [value].flat() as string[]) {
        const isFile =
          name === 'output' ||
          (name === 'env' && isEnvironmentFile(text)) ||
          ((name === 'camera' || name === 'view') && /\.json$/i.test(text));
        out.push(`--${name}=${isFile ? absolute(text) : text}`);
      }
  }
  return out;
}

/**
 * A parameter for a path. Schedulers map those of type PATH from machine to machine; by default they lie below the
 * template's folder, so that others are texts.
 */
function pathParameter(name: string, path: string, folder: string, type: object): object {
  const inside = relative(folder, path) || '.';
  return inside.startsWith('..') || isAbsolute(inside)
    ? { name, type: 'STRING', default: literal(path) }
    : { name, type: 'PATH', ...type, default: literal(inside) };
}

/** Text that the format does not take for an expression: `{{` begins one. */
const literal = (text: string) => text.replaceAll('{{', '{ {');

/**
 * A job template of Open Job Description (2023-09). Where the images are all variants from all views, these are the
 * parameters; otherwise their numbers. Images in parts get the parameter `Part`, and a second step that adds them up.
 *
 * @see https://github.com/OpenJobDescription/openjd-specifications/wiki/2023-09-Template-Schemas
 * @throws {CliError} `cli/batch`
 */
export function openJdTemplate(
  name: string,
  images: readonly Pick<PlannedImage, 'shot' | 'requests'>[],
  { folder, batch, store, outputRoot, cwd, split, gpu, values }: OpenJdOptions,
): object {
  if (images.length === 0) throw new CliError('cli/batch', `${batch}: it contains no images.`);
  const names = images.map(imageName);
  const variants = [...new Set(names.map((one) => one.split('/')[0] as string))];
  const views = [...new Set(names.map((one) => one.split('/')[1] as string))];
  const isMatrix =
    new Set(names).size === images.length &&
    variants.length * views.length === images.length &&
    Math.max(variants.length, views.length) <= MAX_LIST;
  const parts = images.reduce((max, { requests }) => Math.max(max, requests.length), 1);
  const imageParameters = isMatrix
    ? [
        { name: 'Variant', type: 'STRING', range: variants },
        { name: 'View', type: 'STRING', range: views },
      ]
    : [{ name: 'Image', type: 'INT', range: images.length === 1 ? '0' : `0-${images.length - 1}` }];
  const image = isMatrix ? '{{Task.Param.Variant}}/{{Task.Param.View}}' : '{{Task.Param.Image}}';
  const common = [
    'farm',
    'task',
    '{{Param.Batch}}',
    '--store={{Param.Store}}',
    ...(store.endpoint === undefined ? [] : [`--s3-endpoint=${literal(store.endpoint)}`]),
    '--output-root={{Param.OutputRoot}}',
    `--image=${image}`,
    ...(split === undefined ? [] : [`--split=${split}`]),
    ...optionArguments(values, cwd).map(literal),
  ];
  const step = (stepName: string, args: readonly string[], extra: readonly object[], dependsOn?: string) => {
    const parameters = [...imageParameters, ...extra] as { name: string }[];
    return {
      name: stepName,
      ...(dependsOn === undefined ? {} : { dependencies: [{ dependsOn }] }),
      parameterSpace: {
        taskParameterDefinitions: parameters,
        combination: parameters.map((parameter) => parameter.name).join(' * '),
      },
      script: { actions: { onRun: { command: '{{Param.Glanz}}', args } } },
    };
  };
  const device = gpu === undefined ? [] : [`--gpu=${literal(gpu)}`];
  return {
    specificationVersion: 'jobtemplate-2023-09',
    name: name.replace(/[\p{Cc}]/gu, ' ').slice(0, 64) || 'glanz',
    parameterDefinitions: [
      { name: 'Glanz', type: 'STRING', default: 'glanz', description: 'The glanz command on the workers.' },
      pathParameter('Batch', batch, folder, { objectType: 'FILE', dataFlow: 'IN' }),
      store.url.startsWith('s3://')
        ? { name: 'Store', type: 'STRING', default: literal(store.url) }
        : pathParameter('Store', store.url, folder, { objectType: 'DIRECTORY', dataFlow: 'INOUT' }),
      pathParameter('OutputRoot', outputRoot, folder, { objectType: 'DIRECTORY', dataFlow: 'OUT' }),
    ],
    steps:
      parts === 1
        ? [step('Render', [...common, ...device], [])]
        : [
            step(
              'Render',
              [...common, '--part={{Task.Param.Part}}', ...device],
              [{ name: 'Part', type: 'INT', range: `0-${parts - 1}` }],
            ),
            step('Merge', [...common, ...device], [], 'Render'),
          ],
  };
}
