import { ToneMapError } from './names';

/** Exposure settings of a photographic camera. */
export interface CameraExposureSettings {
  /** Focal length over the aperture's diameter: 8 for f/8. Above 0. */
  readonly fStop: number;
  /** Exposure time, seconds: 1/125. Above 0. */
  readonly shutter: number;
  /** Sensitivity, ISO arithmetic; default 100. Above 0. */
  readonly iso?: number;
}

/**
 * Exposure value at ISO 100: log2(N²/t · 100/S). Sunlight is about 15, a lit room about 7; one more halves the light.
 *
 * @throws {ToneMapError} `tonemap/exposure` unless all settings are positive and finite.
 * @example
 * exposureValue({ fStop: 16, shutter: 1 / 125 }); // ≈ 15, the "sunny 16" rule
 */
export function exposureValue({ fStop, shutter, iso = 100 }: CameraExposureSettings): number {
  for (const [name, value] of Object.entries({ fStop, shutter, iso })) {
    if (!(value > 0 && value < Infinity))
      throw new ToneMapError('tonemap/exposure', `The exposure's ${name} is ${value}; it must be a positive number.`);
  }
  return Math.log2(((fStop * fStop) / shutter) * (100 / iso));
}

/**
 * The stops that `exposure` takes, for scenes whose radiance is luminance in cd/m² (glTF's photometric units, taken
 * 1:1): −(EV100 + log2 1.2). A luminance of 1.2 · 2^EV100, which saturates a sensor by ISO 12232's saturation speed
 * with a lens that passes 65 % of the light, becomes 1 (Lagarde and de Rousiers, "Moving Frostbite to Physically Based
 * Rendering", 2014).
 *
 * Scenes in arbitrary units, most of them, look best at exposures near 0 instead.
 *
 * @throws {ToneMapError} `tonemap/exposure` unless all settings are positive and finite.
 * @example
 * toneMapPixels(rgba, width, height, { exposure: cameraExposure({ fStop: 2.8, shutter: 1 / 60, iso: 400 }) });
 */
export function cameraExposure(settings: CameraExposureSettings): number {
  return -(exposureValue(settings) + Math.log2(1.2));
}
