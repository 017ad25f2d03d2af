import type { OpenPbrParameterName } from '../parameters/index';
import { fromOpenPbr12, type OpenPbr12Parameters } from '../versions/from-1-2';
import type { MaterialXTexture } from './material';

/** Inputs of the draft of OpenPBR 1.2 that become others; all of them are numbers. */
export const DRAFT_INPUTS = { emission_weight: true } as const;

/** An input of a surface, of either version. */
export type SurfaceName = OpenPbrParameterName | keyof typeof DRAFT_INPUTS;

/** What a surface's inputs are set to. */
export type SurfaceValues = Partial<Record<SurfaceName, unknown>>;
export type SurfaceTextures = Partial<Record<SurfaceName, MaterialXTexture>>;

/** Whether a value is above 0 somewhere: a number or a colour. */
const acts = (value: unknown): boolean => [value].flat().some((number) => (number as number) > 0);

/**
 * Converts the inputs of a surface of the draft of OpenPBR 1.2 in place to those of 1.1.1.
 *
 * @param report Receives a sentence for each input whose effect is lost.
 */
export function fromDraft(raw: SurfaceValues, textures: SurfaceTextures, report: (message: string) => void): void {
  if (textures.emission_weight) {
    if (textures.emission_luminance)
      report('emission_weight and emission_luminance are both images; the image of the luminance is read alone.');
    // The product of a weight that is an image and a constant luminance is a luminance that is an image.
    else textures.emission_luminance = textures.emission_weight;
    delete textures.emission_weight;
  }
  if (acts(raw.transmission_scatter) && (textures.transmission_color || textures.transmission_depth)) {
    report('transmission_scatter depends on a transmission_color or depth that is an image; it is left out.');
    delete raw.transmission_scatter;
    delete textures.transmission_scatter;
  }
  const { parameters, lost } = fromOpenPbr12(raw as OpenPbr12Parameters);
  for (const { parameter, reason } of lost) report(`${parameter}: ${reason}.`);
  for (const name of Object.keys(raw) as SurfaceName[]) delete raw[name];
  Object.assign(raw, parameters);
}
