import { existsSync, readFileSync } from 'node:fs';
import { it } from 'vitest';
import type { OpenPbrParameters } from '../src/parameters/index';

// Independent numbers live beside the repository; where they are absent, the tests that need them say so in their names.
const FOLDER = new URL('../../../../shared/openpbr/', import.meta.url);

/** Whether the independent numbers are there. */
export const sharedPresent = existsSync(FOLDER);

/** `it`, or a skipped test that says why. */
export function sharedIt(name: string, run: () => void | Promise<void>, timeout?: number): void {
  if (sharedPresent) it(name, run, timeout);
  else it.skip(`${name} — SKIPPED: the oracle folder ../shared/openpbr is not here`, run);
}

const read = (file: string): unknown => JSON.parse(readFileSync(new URL(file, FOLDER), 'utf8'));

/** The specification's example materials. */
export const presets = (): Record<string, Partial<OpenPbrParameters>> => (read('presets.json') as { presets: Record<string, Partial<OpenPbrParameters>> }).presets;

export type Triple = [number, number, number];

export interface OraclePair {
  o: number;
  wi: Triple;
  f: Triple;
  pdf: number;
  k?: number;
  kc?: number;
  L?: 'spec' | Partial<Record<'spec' | 'dms' | 'mms' | 'diff' | 'coat' | 'base_scale', Triple>>;
}

export interface OracleSetting {
  id: string;
  params: Partial<OpenPbrParameters> & { exterior_ior?: number };
  tol: {
    f: { cls: string; rel?: number; abs?: number; median?: number; p90?: number } | null;
    albedo: { cls: string; rel: number; abs: number };
    lobes: { spec?: { cls: string; rel: number; abs: number }; coat?: { cls: string; rel: number; abs: number } };
  };
  derived: { alpha: [number, number]; eta_refl_opaque: Triple };
  wo: Triple[];
  pairs: OraclePair[];
  albedo: { mu: number; R: Triple; T: Triple; se: [number, number] }[];
}

export interface Oracle {
  settings: OracleSetting[];
  furnace: { id: string; params: string; mu: number[]; RT: number[]; se: number }[];
}

export const oracle = (): Oracle => read('reference.json') as Oracle;
export const primitives = (): Record<string, Record<string, unknown>[]> => read('primitives_own.json') as Record<string, Record<string, unknown>[]>;
