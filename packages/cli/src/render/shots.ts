import { PLACEHOLDER } from '../output/placeholders';
import { CliError } from '../errors';
import type { RenderCommandOptions } from '../options';
import type { OutputTarget } from '../output/formats';
import { fileNamePart, type View } from '../views';

/** What moves in a frame of a film, and for how long the shutter is open. */
export interface FrameMotion {
  /** Number of the frame. The steps of its view, if that is a turntable, are frames. */
  readonly frame: number;
  readonly fps: number;
  /** Share of the time between two frames in which the shutter is open, from 0 to 1. */
  readonly shutter: number;
  /** Times of an open shutter at which the scene is posed; `undefined`: one for each sample. */
  readonly times: number | undefined;
  /** An animation of the model by name or number. */
  readonly animation: string | number | undefined;
}

/** One image of those that a command asks for. */
export interface Shot {
  readonly options: RenderCommandOptions;
  /** Name or number of a variant; undefined: the model's own look. */
  readonly variant: string | undefined;
  readonly view: View;
  /** With the names of variant and view in them. */
  readonly outputs: readonly OutputTarget[];
  /** Likewise; `undefined`: samples are kept in memory only. */
  readonly checkpoint: string | undefined;
  /** What progress calls it, where its files get their names later. Default: their paths. */
  readonly label?: string;
  /** Its film is for a merge alone, which does not need the image that it has come to. */
  readonly isPart?: boolean;
  /** It is a frame of a film. */
  readonly motion?: FrameMotion;
}

function filled(path: string, names: Readonly<Record<string, string>>, several: readonly string[]): string {
  // What distinguishes images has to be in their names.
  const missing = several
    .filter((name) => !path.includes(`{${name}}`))
    .map((name) => `-{${name}}`)
    .join('');
  return path
    .replace(/(\.[^.\\/]+)?$/, `${missing}$1`)
    .replace(PLACEHOLDER, (whole, name: string) => names[name] ?? whole);
}

/**
 * All images of a request: each variant from each view.
 * @param all Names of the model's variants, for `--variant all`.
 * @param checkpoint See `RenderCommand.checkpoint`.
 */
export function shotsOf(options: RenderCommandOptions, all: readonly string[] = [], checkpoint?: string): Shot[] {
  const variants = options.variants.flatMap((variant) => (variant === 'all' ? all : [variant]));
  const model = fileNamePart((options.model.split(/[\\/]/).pop() as string).replace(/\.[^.]*$/, ''));
  const several = [...(variants.length > 1 ? ['variant'] : []), ...(options.views.length > 1 ? ['view'] : [])];
  return (variants.length === 0 ? [undefined] : variants).flatMap((variant) =>
    options.views.map((view) => {
      const names = { model, variant: variant === undefined ? 'default' : fileNamePart(variant), view: view.name };
      return {
        options,
        variant,
        view,
        outputs: options.outputs.map((target) => ({ ...target, path: filled(target.path, names, several) })),
        checkpoint: checkpoint === undefined ? undefined : filled(checkpoint, names, several),
      };
    }),
  );
}

/** @throws {CliError} `cli/usage` if two images would have the same name. */
export function checkDistinct(shots: readonly Shot[]): void {
  const seen = new Set<string>();
  for (const { outputs, checkpoint } of shots) {
    for (const path of [...outputs.map((target) => target.path), ...(checkpoint === undefined ? [] : [checkpoint])]) {
      if (seen.has(path))
        throw new CliError(
          'cli/usage',
          `Two images would be written to "${path}": put {model}, {variant} or {view} into the name, or give each its own.`,
        );
      seen.add(path);
    }
  }
}

/** For progress: what distinguishes this image from the others. */
export const shotLabel = ({ variant, view, outputs }: Shot): string =>
  [outputs[0]?.path, variant, view.kind === 'camera' && view.camera === undefined ? undefined : view.name]
    .filter((part) => part !== undefined)
    .join(' · ');
