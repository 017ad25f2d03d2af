import { RENDER_OPTION_TEXTS, RENDER_OPTIONS } from '@glanz/renderer/options';
import { LIMITS } from '../state/limits';
import type { State } from '../state/state';
import type { changer } from './context';
import type { SliderOptions } from './fields';

/** What a slider for an option of the renderer needs: type, default, text and slider range come from the option's row. */
export function optionSlider(
  name: 'samples' | 'maxDepth',
  label: string,
  state: State,
  change: ReturnType<typeof changer>,
): SliderOptions {
  const { type, default: initial } = RENDER_OPTIONS[name];
  const { doc, unit, softRange } = RENDER_OPTION_TEXTS[name];
  return {
    id: name,
    label,
    value: state[name],
    initial,
    range: softRange ?? LIMITS[name],
    hardRange: LIMITS[name],
    whole: type === 'integer',
    unit,
    hint: doc,
    onInput: change(name, label),
  };
}
