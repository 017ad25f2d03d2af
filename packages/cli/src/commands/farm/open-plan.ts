import type { Backend } from '../../backend';
import { FarmPlan } from '../../farm/plan';
import type { CliIo } from '../../io';
import type { RenderCommandOptions } from '../../options';
import type { ProgressReporter } from '../../progress';
import { SceneLoader } from '../../render/scene';
import { noVariants } from '../render';
import type { FarmCommand } from './parse';

/** Opens the batch that the command names. */
export async function openPlan(
  { args, values, outputRoot, split }: FarmCommand,
  io: CliIo,
  backend: Backend,
  progress: ProgressReporter,
): Promise<FarmPlan> {
  const loader = new SceneLoader(backend, io.cwd);
  const warned = new Set<string>();
  return FarmPlan.open({
    batch: args[0] as string,
    cwd: io.cwd,
    values,
    outputRoot,
    split,
    async variantsOf(options: RenderCommandOptions) {
      progress.stage('load model');
      const { variants = [] } = (await loader.load(options, new AbortController().signal)).scene;
      if (variants.length === 0) throw noVariants(options);
      return variants;
    },
    warn(text) {
      if (!warned.has(text)) progress.warning(text);
      warned.add(text);
    },
  });
}
