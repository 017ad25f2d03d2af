export {
  MAX_ADAPTIVE_SAMPLES,
  RENDER_OPTIONS,
  type BooleanOption,
  type EnumOption,
  type FilterOption,
  type LimitsOption,
  type NamesOption,
  type NumberOption,
  type RenderOption,
  type RenderOptionEffect,
  type RenderOptionName,
  type RenderSettings,
  type ResolvedSettings,
} from './table';
export { RENDER_OPTION_TEXTS, type RenderOptionText } from './texts';
export { kebabCase, parseOption, type KebabCase } from './parse';
export { optionFault, optionValues, shownValue, takesOption } from './values';
