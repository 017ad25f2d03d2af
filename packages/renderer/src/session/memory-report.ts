import type { TextureFit } from '../scene/texture-fit';
import type { MemoryReport } from '../memory';
import type { GpuMemory } from '../storage/buffers';

/** Labels of the buffers and textures that belong together. */
const PARTS: Readonly<
  Record<'shapes' | 'lights' | 'materials' | 'textures' | 'environment' | 'paths' | 'film', RegExp>
> = {
  shapes: /^(nodes|triangles|attributes|instances)$/,
  lights: /^lights$/,
  materials: /^materials$/,
  textures: /^scene texture /,
  environment: /^environment/,
  paths: /^(paths|queues|shadows)$/,
  film: /^film /,
};

/** Adds up what is held, see `RenderStatistics.memory`. */
export function memoryReport(
  memory: GpuMemory,
  counts: {
    readonly pathsInFlight: number;
    readonly triangles: number;
    readonly pixels: number;
    readonly texels: number;
    readonly textures: TextureFit;
  },
): MemoryReport {
  const parts = Object.fromEntries(
    Object.entries(PARTS).map(([name, pattern]) => [name, memory.bytesOf((label) => pattern.test(label))]),
  ) as Record<keyof typeof PARTS, number>;
  const other = memory.bytes - Object.values(parts).reduce((sum, bytes) => sum + bytes, 0);
  const each = (bytes: number, count: number) => (count > 0 ? bytes / count : 0);
  return {
    ...parts,
    fullTextures: counts.textures.fullBytes ?? parts.textures,
    reducedTextures: [...counts.textures.reduced.values()],
    other,
    pathsInFlight: counts.pathsInFlight,
    perPath: each(parts.paths, counts.pathsInFlight),
    perTriangle: each(parts.shapes, counts.triangles),
    perPixel: each(parts.film, counts.pixels),
    perTexel: each(parts.textures, counts.texels),
  };
}
