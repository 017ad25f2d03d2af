import type { Backend } from '../backend';
import { CliError } from '../errors';
import { usage } from '../options';
import { nvidiaNodes, type NvidiaNode } from './nvidia-nodes';

/** A GPU to render on. */
export interface ChosenGpu {
  /** For `--gpu`: part of an adapter's name; `undefined` is the fastest. */
  readonly name: string | undefined;
  /** For people: with a number where several have the name. */
  readonly label: string | undefined;
  /** Device files of the other GPUs, where its name does not tell it from them: its process must not see these. */
  readonly hidden: readonly string[];
}

/** `H100 #2`. */
const NUMBERED = /^(.*?)\s*#(\d{1,3})$/;

/** The adapters' names; where several have the same, with ` #1`, ` #2`, … */
export function numbered(names: readonly string[]): string[] {
  const seen = new Map<string, number>();
  return names.map((name) => {
    if (names.indexOf(name) === names.lastIndexOf(name)) return name;
    seen.set(name, (seen.get(name) ?? 0) + 1);
    return `${name} #${seen.get(name)}`;
  });
}

/**
 * The GPUs that `--gpu` names. `all` stands for those that are no software; `H100 #2` is the second of those with this
 * name, in the order of their device files.
 *
 * WebGPU in Node chooses adapters by name. Several of one name are distinguished by what a process sees of `/dev`, which
 * NVIDIA's driver respects.
 *
 * @throws {CliError} `renderer/no-adapter`, or `cli/usage` for names that stand for no GPU, or for several that cannot be
 * distinguished
 */
export async function chooseGpus(
  names: readonly string[],
  backend: Pick<Backend, 'listGpus'>,
  nodes: readonly NvidiaNode[] = nvidiaNodes(),
): Promise<ChosenGpu[]> {
  if (names.length === 0) return [{ name: undefined, label: undefined, hidden: [] }];
  if (!names.includes('all') && !names.some((name) => NUMBERED.test(name)))
    return names.map((name) => ({ name, label: name, hidden: [] }));
  const adapters = (await backend.listGpus()).filter(({ software }) => !software).map(({ name }) => name);
  const labels = numbered(adapters);
  const chosen = (at: number): ChosenGpu => {
    const name = adapters[at] as string;
    const label = labels[at] as string;
    return { name, label, hidden: label === name ? [] : othersThan(name, adapters, at, nodes) };
  };
  if (names.includes('all')) {
    if (adapters.length === 0)
      throw new CliError('renderer/no-adapter', '--gpu all: there is no GPU. See glanz --list-gpus.');
    return adapters.map((_, at) => chosen(at));
  }
  return names.map((given) => {
    const [, part, number] = NUMBERED.exec(given) ?? [];
    if (part === undefined) return { name: given, label: given, hidden: [] };
    const found = [...adapters.keys()].filter((at) =>
      (adapters[at] as string).toLowerCase().includes(part.toLowerCase()),
    );
    const at = found[Number(number) - 1];
    if (at === undefined)
      throw usage(
        `--gpu "${given}": ${found.length === 0 ? 'no GPU has' : found.length === 1 ? 'one GPU has' : `${found.length} GPUs have`} "${part}" in its name. See glanz --list-gpus.`,
      );
    return chosen(at);
  });
}

/** The device files of all GPUs but one of several of a name. */
function othersThan(
  name: string,
  adapters: readonly string[],
  at: number,
  nodes: readonly NvidiaNode[],
): readonly string[] {
  const same = [...adapters.keys()].filter((other) => adapters[other] === name);
  const files = nodes.filter(({ model }) => model === name).map(({ file }) => file);
  if (files.length !== same.length)
    throw usage(
      `${same.length} GPUs are called "${name}", and ${files.length === 0 ? 'no device files of NVIDIA' : `${files.length} of NVIDIA's device files`} belong to them: they cannot be distinguished here. Start a container for each (docker run --gpus device=0 …), and glanz in it without --gpu.`,
    );
  const own = files[same.indexOf(at)];
  return nodes.map(({ file }) => file).filter((file) => file !== own);
}
