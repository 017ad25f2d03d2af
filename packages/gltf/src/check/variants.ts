import type { CheckContext } from './context';
import { isObject, own, quote, type Raw } from '../json-value';

/** The names of KHR_materials_variants; undefined if there are none. */
export function repairVariants(context: CheckContext): readonly { readonly name: string }[] | undefined {
  const extensions = own(context.json, 'extensions');
  const extension = isObject(extensions) ? own(extensions, 'KHR_materials_variants') : undefined;
  if (extension === undefined) return undefined;
  const path = '/extensions/KHR_materials_variants/variants';
  const variants = isObject(extension) ? own(extension, 'variants') : undefined;
  if (!Array.isArray(variants)) {
    context.warn('gltf/variant', path, `is ${quote(variants)}, but must be an array; there are no variants`);
    return undefined;
  }
  context.notEmpty(variants, path);
  return variants.map((variant: unknown, index) => {
    const name = isObject(variant) ? own(variant, 'name') : undefined;
    if (typeof name === 'string') return { name };
    context.warn('gltf/variant', `${path}/${index}`, 'has no name; it is called by its number');
    return { name: `variant ${index}` };
  });
}

/** A primitive whose mappings name variants and materials that exist; others are left out, with a warning. */
export function withSoundVariants(
  context: CheckContext,
  primitive: Raw,
  path: string,
  variants: number,
  materials: number,
): Raw {
  const extensions = own(primitive, 'extensions');
  const extension = isObject(extensions) ? own(extensions, 'KHR_materials_variants') : undefined;
  if (extension === undefined) return primitive;
  const at = `${path}/extensions/KHR_materials_variants/mappings`;
  const mappings = isObject(extension) ? own(extension, 'mappings') : undefined;
  const index = (value: unknown, count: number) =>
    typeof value === 'number' && Number.isInteger(value) && value >= 0 && value < count;
  if (!Array.isArray(mappings))
    context.warn('gltf/variant', at, `is ${quote(mappings)}, but must be an array; it is left out`);
  const sound = (Array.isArray(mappings) ? (mappings as unknown[]) : []).flatMap((mapping, m) => {
    const material = isObject(mapping) ? own(mapping, 'material') : undefined;
    const named = isObject(mapping) ? own(mapping, 'variants') : undefined;
    if (index(material, materials) && Array.isArray(named) && named.every((variant) => index(variant, variants)))
      return [{ material, variants: named as number[] }];
    context.warn(
      'gltf/variant',
      `${at}/${m}`,
      `is ${quote(mapping)}, which names no material or variants; it is left out`,
    );
    return [];
  });
  return { ...primitive, extensions: { ...(extensions as Raw), KHR_materials_variants: { mappings: sound } } };
}
