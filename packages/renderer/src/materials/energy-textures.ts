import type { OPENPBR_TABLES } from '@glanz/openpbr/tables';
import type { SceneResources } from '../storage/scene-resources';
import { toHalves } from './texture-upload';

/** An energy table as the kernels sample it. */
export interface EnergyTexture {
  readonly dimension: '2d' | '3d';
  readonly size: [width: number, height: number, depth: number];
  /** Half floats, x fastest. */
  readonly data: Uint16Array<ArrayBuffer>;
}

/** The energy tables, decoded, by the names that kernels bind them under. */
export type EnergyTextures = Readonly<Record<'energy_dielectric' | 'energy_conductor', EnergyTexture>>;

/** Decodes the energy tables, which takes some milliseconds and no scene. */
export function energyTextures({ dielectric, conductor }: typeof OPENPBR_TABLES): EnergyTextures {
  const texture = (
    { width, height, depth, data }: typeof dielectric,
    dimension: EnergyTexture['dimension'],
  ): EnergyTexture => ({ dimension, size: [width, height, depth], data: toHalves(data) });
  return { energy_dielectric: texture(dielectric, '3d'), energy_conductor: texture(conductor, '2d') };
}

/** Makes the energy tables' textures. */
export function uploadEnergyTextures(queue: GPUQueue, resources: SceneResources, energy: EnergyTextures): void {
  for (const name of ['energy_dielectric', 'energy_conductor'] as const) {
    const { size, dimension, data } = energy[name];
    const texture = resources.makeTexture(name, { size, dimension, format: 'r16float' }, data.byteLength);
    queue.writeTexture({ texture }, data, { bytesPerRow: size[0] * 2, rowsPerImage: size[1] }, size);
  }
}
