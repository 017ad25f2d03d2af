import type { OPENPBR_TABLES } from '@glanz/openpbr/tables';
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
