import type { WgslModule } from '@glanz/wgsl/module';
import { acesToneMap, tonemapAces } from './aces';
import { agxToneMap, tonemapAgx } from './agx';
import { linearToneMap, tonemapLinear } from './linear';
import { ToneMapError, TONE_MAPS, type Rgb, type ToneMap } from './names';
import { neutralToneMap, tonemapNeutral } from './neutral';
import { reinhardToneMap, tonemapReinhard } from './reinhard';

/** One view transform: the WGSL module that declares `tonemap_<name>`, and its CPU twin. Linear in, linear 0..1 out. */
export interface ToneMapOperator {
  readonly wgsl: WgslModule;
  /** @param out May become the result; may be the colour itself. */
  readonly map: (rgb: Rgb, out?: [number, number, number]) => [number, number, number];
}

const OPERATORS: Readonly<Record<ToneMap, ToneMapOperator>> = {
  neutral: { wgsl: tonemapNeutral, map: neutralToneMap },
  aces: { wgsl: tonemapAces, map: acesToneMap },
  agx: { wgsl: tonemapAgx, map: agxToneMap },
  reinhard: { wgsl: tonemapReinhard, map: reinhardToneMap },
  linear: { wgsl: tonemapLinear, map: linearToneMap },
};

/**
 * The operator of that name.
 *
 * @throws {ToneMapError} code `tonemap/unknown`.
 */
export function toneMapOperator(name: ToneMap): ToneMapOperator {
  if (!Object.hasOwn(OPERATORS, name))
    throw new ToneMapError(
      'tonemap/unknown',
      `There is no tone map "${String(name)}". Known: ${TONE_MAPS.join(', ')}.`,
    );
  return OPERATORS[name];
}
