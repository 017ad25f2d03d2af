import type { Material } from '@glanz/scene';
import { cssColor } from '@glanz/tonemap/css-color';

type Parameters = Material['parameters'];
type ColorName = Extract<keyof Parameters, `${string}_color` | 'transmission_scatter'>;

/** Parameters of a material, for `Viewer.setMaterial`: colours are linear Rec.709, or CSS colours as text. */
export type MaterialEdit = Omit<Parameters, ColorName> & { readonly [Name in ColorName]?: Parameters[Name] | string };

/** Whether a parameter may be a CSS colour. */
export const isColor = (name: string): name is ColorName => name.endsWith('_color') || name === 'transmission_scatter';

/**
 * Parameters with their CSS colours as linear Rec.709. What else is a text stays one: the tracer refuses it.
 * @throws {ToneMapError} `tonemap/color`
 */
export function linearColors(material: string | number, edit: MaterialEdit): Parameters {
  const linear = Object.entries(edit).map(([name, value]) => {
    const text = isColor(name) && typeof value === 'string';
    return [name, text ? cssColor(value, `Material "${material}" was not changed: ${name}`) : value] as const;
  });
  return Object.fromEntries(linear) as Parameters;
}
