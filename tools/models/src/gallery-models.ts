import type { Scene } from '@glanz/scene';
import { createAmplifier } from './amplifier';
import { createArmchair } from './armchair';
import { createBubbles } from './bubbles';
import { createButtonPanel } from './button-panel';
import { createCameraLens } from './camera-lens';
import { createCandles } from './candles';
import { createChess } from './chess';
import { createKnot } from './knot';
import { createLamps } from './lamps';
import { createPerfume } from './perfume';
import { createRing } from './ring';
import { createSpeedform } from './speedform';
import { createTeaSet } from './tea-set';
import { createTumbler } from './tumbler';
import { createWatch } from './watch';
import { createMail, createWeave } from './weave';

/** The models of the gallery, by the name of their files. */
export const GALLERY_MODELS: Readonly<Record<string, () => Scene>> = {
  amplifier: createAmplifier,
  armchair: createArmchair,
  bubbles: createBubbles,
  'button-panel': createButtonPanel,
  'camera-lens': createCameraLens,
  candles: createCandles,
  chess: createChess,
  knot: createKnot,
  lamps: createLamps,
  mail: createMail,
  perfume: createPerfume,
  ring: createRing,
  speedform: createSpeedform,
  'tea-set': createTeaSet,
  tumbler: createTumbler,
  watch: createWatch,
  weave: createWeave,
};
