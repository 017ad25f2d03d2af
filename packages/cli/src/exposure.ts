import { cameraExposure } from '@glanz/tonemap';
import { CliError } from './errors';

const wrong = (text: string) =>
  new CliError(
    'cli/usage',
    `--exposure must be a number of stops from -64 to 64, or a camera's settings like f/8,1/125,iso200, not "${text}".`,
  );

/**
 * Stops from `--exposure`: a number, or `f/8,1/125,iso200` (aperture, seconds, sensitivity; the last may be left out).
 *
 * @throws {CliError} `cli/usage`
 */
export function parseExposure(text: string): number {
  if (!/f\//i.test(text)) {
    const value = text.trim() === '' ? NaN : Number(text);
    if (!(value >= -64 && value <= 64)) throw wrong(text);
    return value;
  }
  let fStop = NaN,
    shutter = NaN,
    iso = 100;
  for (const word of text.trim().split(/[\s,]+/)) {
    const [, aperture, numerator, denominator, seconds, sensitivity] =
      /^(?:f\/(\d*\.?\d+)|(\d*\.?\d+)\/(\d*\.?\d+)s?|(\d*\.?\d+)s|iso(\d+))$/i.exec(word) ?? [];
    if (aperture) fStop = Number(aperture);
    else if (numerator) shutter = Number(numerator) / Number(denominator);
    else if (seconds) shutter = Number(seconds);
    else if (sensitivity) iso = Number(sensitivity);
    else throw wrong(text);
  }
  if (![fStop, shutter, iso].every((value) => value > 0 && value < Infinity)) throw wrong(text);
  return cameraExposure({ fStop, shutter, iso });
}
