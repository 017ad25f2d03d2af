import type { Material } from '@glanz/scene';

/** A colour that the push-button's lens comes in. */
export interface LensColour {
  readonly name: string;
  /** For the swatch. */
  readonly css: string;
  readonly parameters: Material['parameters'];
}

/** The lens colours on offer; linear Rec.709. */
export const LENS_COLOURS: readonly LensColour[] = [
  { name: 'green', css: '#1f9d4d', parameters: { base_color: [0.012, 0.33, 0.08], emission_color: [0.03, 1, 0.2] } },
  { name: 'red', css: '#c8281c', parameters: { base_color: [0.4, 0.014, 0.012], emission_color: [1, 0.05, 0.03] } },
  { name: 'amber', css: '#e8920c', parameters: { base_color: [0.6, 0.22, 0.012], emission_color: [1, 0.4, 0.03] } },
  { name: 'blue', css: '#1f5fd0', parameters: { base_color: [0.012, 0.06, 0.4], emission_color: [0.03, 0.16, 1] } },
  { name: 'white', css: '#f2f2ee', parameters: { base_color: [0.7, 0.7, 0.68], emission_color: [1, 1, 1] } },
];
