import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { join } from 'node:path';

/** An NVIDIA GPU as the driver's kernel module lists it. */
export interface NvidiaNode {
  /** As Vulkan calls it. */
  readonly model: string;
  /** The device file, such as `/dev/nvidia0`. */
  readonly file: string;
}

/**
 * The NVIDIA GPUs that this process may open, in the order of their device files; none where there is no such driver.
 *
 * @param root The file system's root, for tests.
 */
export function nvidiaNodes(root = '/'): NvidiaNode[] {
  const folder = join(root, 'proc/driver/nvidia/gpus');
  const found: { minor: number; node: NvidiaNode }[] = [];
  for (const address of existsSync(folder) ? readdirSync(folder) : []) {
    let text: string;
    try {
      text = readFileSync(join(folder, address, 'information'), 'utf8');
    } catch {
      // A GPU that has just been removed.
      continue;
    }
    const field = (name: string) => new RegExp(`^${name}:\\s*(.+?)\\s*$`, 'm').exec(text)?.[1];
    const [model, minor] = [field('Model'), field('Device Minor')];
    if (model === undefined || minor === undefined || !/^\d+$/.test(minor)) continue;
    const file = `/dev/nvidia${minor}`;
    // Containers see all GPUs of the machine in /proc, and in /dev those that they were given.
    if (existsSync(join(root, file))) found.push({ minor: Number(minor), node: { model, file } });
  }
  return found.sort((a, b) => a.minor - b.minor).map(({ node }) => node);
}
