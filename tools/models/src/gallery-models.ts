import type { Scene } from '@glanz/scene';
import { createArmchair } from './armchair';
import { createChess } from './chess';
import { createKnot } from './knot';
import { createPerfume } from './perfume';
import { createRing } from './ring';
import { createSpeedform } from './speedform';
import { createWatch } from './watch';

/** The models of the gallery, by the name of their files. */
export const GALLERY_MODELS: Readonly<Record<string, () => Scene>> = {
  armchair: createArmchair,
  chess: createChess,
  knot: createKnot,
  perfume: createPerfume,
  ring: createRing,
  speedform: createSpeedform,
  watch: createWatch,
};
