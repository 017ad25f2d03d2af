import { readFileSync } from 'node:fs';
import { gunzipSync } from 'node:zlib';
import type { OpenPbrParameters } from '../../src/parameters/index';

const bytes = (file: string) => readFileSync(new URL(`./${file}`, import.meta.url));
const read = (file: string): unknown =>
  JSON.parse((file.endsWith('.gz') ? gunzipSync(bytes(file)) : bytes(file)).toString());

/** The specification's example materials. */
export const presets = (): Record<string, Partial<OpenPbrParameters>> =>
  (read('presets.json') as { presets: Record<string, Partial<OpenPbrParameters>> }).presets;

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

export const oracle = (): Oracle => read('reference.json.gz') as Oracle;
export const primitives = (): Record<string, Record<string, unknown>[]> =>
  read('primitives.json') as Record<string, Record<string, unknown>[]>;
