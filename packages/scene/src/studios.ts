/** A colour: linear Rec.709. */
export type Rgb = readonly [number, number, number];

/** A light of a {@link StudioSetup}: a soft box that faces the subject from infinitely far away. */
export interface SoftBox {
  /** Direction, radians: azimuth from +Z (the front) towards +X, and elevation above the horizon. */
  readonly azimuth: number;
  readonly elevation: number;
  /** Angular size, radians, in (0, π). */
  readonly width: number;
  readonly height: number;
  /** `rectangle` (default), or `disc`: an ellipse. */
  readonly shape?: 'rectangle' | 'disc';
  /**
   * Radiance at the centre, one number for all channels or RGB; it falls off by a quarter towards the edges, as in a
   * real soft box.
   */
  readonly radiance: number | Rgb;
}

/** The walls and lights of a studio. */
export interface StudioSetup {
  /** Radiance of the walls straight up, around the horizon and straight down, blended smoothly. */
  readonly backdrop: { readonly zenith: Rgb; readonly horizon: Rgb; readonly nadir: Rgb };
  readonly boxes: readonly SoftBox[];
}

const DEGREE = Math.PI / 180;

/** A box from angles in degrees and the tangents of its angular half sizes. */
const box = (
  azimuth: number,
  elevation: number,
  halfWidth: number,
  halfHeight: number,
  radiance: SoftBox['radiance'],
  shape?: 'disc',
): SoftBox => ({
  azimuth: azimuth * DEGREE,
  elevation: elevation * DEGREE,
  width: 2 * Math.atan(halfWidth),
  height: 2 * Math.atan(halfHeight),
  radiance,
  ...(shape ? { shape } : {}),
});

const walls = (zenith: number, horizon: number, nadir: number): StudioSetup['backdrop'] => ({
  zenith: [zenith, zenith, zenith],
  horizon: [horizon, horizon, horizon],
  nadir: [nadir, nadir, nadir],
});

// A function, so that bundlers can drop the table where it is unused.
const table = () =>
  ({
    // A product photographer's set for a subject that faces +Z, seen from the front right: the key from the front left,
    // a wide weak fill on the right, a large box overhead, and two strips behind for rim light. The strips are high
    // enough to stay out of view of a camera that looks slightly down.
    neutral: {
      backdrop: walls(0.25, 0.5, 0.3),
      boxes: [
        box(-50, 38, 0.42, 0.5, 4.6),
        box(65, 22, 0.55, 0.5, 0.9),
        box(0, 88, 0.7, 0.5, 0.5),
        box(150, 42, 0.14, 0.5, 3),
        box(-145, 42, 0.14, 0.5, 2.4),
      ],
    },
    // White all around, hardly a shadow: catalogue photographs.
    'high-key': {
      backdrop: walls(0.95, 0.9, 0.7),
      boxes: [box(-40, 45, 0.7, 0.7, 1.5), box(70, 30, 0.6, 0.7, 0.7), box(0, 88, 0.9, 0.9, 0.6)],
    },
    // Black walls: strips for the rim light, a narrow box overhead for the form.
    'low-key': {
      backdrop: walls(0.012, 0.03, 0.01),
      boxes: [
        box(-110, 25, 0.1, 0.9, 9),
        box(115, 25, 0.1, 0.9, 7),
        box(-20, 72, 0.45, 0.2, 4.5),
        box(30, 20, 0.16, 0.3, 0.7),
      ],
    },
    // A tall window at the left, warm walls.
    window: {
      backdrop: { zenith: [0.2, 0.18, 0.155], horizon: [0.22, 0.19, 0.16], nadir: [0.12, 0.09, 0.065] },
      boxes: [
        box(-82, 22, 0.24, 0.5, [6.6, 7.2, 8]),
        box(-50, 22, 0.24, 0.5, [6.6, 7.2, 8]),
        box(95, 15, 0.5, 0.5, [0.5, 0.42, 0.34]),
      ],
    },
    // Two colours against each other: a cool key, a warm rim.
    duotone: {
      backdrop: { zenith: [0.04, 0.045, 0.06], horizon: [0.07, 0.075, 0.1], nadir: [0.03, 0.03, 0.035] },
      boxes: [
        box(-60, 30, 0.4, 0.6, [1.2, 2.6, 5.4]),
        box(120, 28, 0.22, 0.7, [7.5, 2.6, 0.9]),
        box(20, 80, 0.5, 0.4, 0.9),
      ],
    },
    overcast: {
      backdrop: { zenith: [1.1, 1.15, 1.22], horizon: [0.62, 0.65, 0.7], nadir: [0.2, 0.19, 0.175] },
      boxes: [box(-40, 60, 1.2, 1.2, [0.45, 0.46, 0.48], 'disc')],
    },
    'clear-sky': {
      backdrop: { zenith: [0.16, 0.33, 0.78], horizon: [0.72, 0.84, 1], nadir: [0.2, 0.175, 0.145] },
      boxes: [box(-48, 48, 0.36, 0.36, [0.9, 0.85, 0.75], 'disc'), box(-48, 48, 0.07, 0.07, [130, 118, 96], 'disc')],
    },
    sunset: {
      backdrop: { zenith: [0.09, 0.13, 0.3], horizon: [0.95, 0.42, 0.2], nadir: [0.11, 0.075, 0.06] },
      boxes: [box(-70, 9, 0.5, 0.24, [2.4, 0.9, 0.28], 'disc'), box(-70, 9, 0.08, 0.08, [75, 32, 9], 'disc')],
    },
  }) as const satisfies Readonly<Record<string, StudioSetup>>;

/** Names of the studios and skies in {@link STUDIOS}. */
export type StudioName = keyof ReturnType<typeof table>;

/**
 * Studios and skies for `studioEnvironment({ setup })`, each exposed so that a white surface, or in the dark ones its
 * lit side, renders near 1. Skies are gradients with a soft sun, not a model of the atmosphere.
 */
export const STUDIOS: Readonly<Record<StudioName, StudioSetup>> = /* @__PURE__ */ table();
