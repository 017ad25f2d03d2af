import { element } from '../ui/elements';
import {
  applies,
  CATALOGUE,
  choicesOf,
  chosen,
  FEATURES,
  type Choice,
  type Configuration,
  type FeatureName,
} from './catalogue';

function drawing(path: string): SVGSVGElement {
  const space = 'http://www.w3.org/2000/svg';
  const svg = document.createElementNS(space, 'svg');
  svg.setAttribute('viewBox', '0 0 24 24');
  svg.setAttribute('class', 'icon');
  svg.setAttribute('aria-hidden', 'true');
  const line = document.createElementNS(space, 'path');
  line.setAttribute('d', path);
  svg.append(line);
  return svg;
}

function option(feature: FeatureName, { code, title, swatch, icon }: Choice): HTMLElement {
  const input = element('input', { type: 'radio', name: feature, value: code, id: `${feature}-${code}` });
  const round = feature === 'legend' || (feature === 'light' && icon !== undefined);
  if (!swatch && !round)
    return element('label', { class: 'choice tile', title }, input, ...(icon ? [drawing(icon)] : []), title);
  input.setAttribute('aria-label', title);
  const kind = swatch ? 'choice swatched' : 'choice round';
  return element(
    'label',
    { class: kind, title },
    input,
    swatch ? element('span', { class: 'swatch', style: `background:${swatch}` }) : drawing(icon ?? ''),
  );
}

/** All features as groups of radio buttons, so that arrows and Tab work as everywhere. */
export class OptionsForm {
  readonly #groups = new Map<FeatureName, { readonly set: HTMLFieldSetElement; readonly choiceLabel: HTMLElement }>();

  constructor(form: HTMLFormElement, onChoose: (feature: FeatureName, code: string) => void) {
    for (const feature of FEATURES) {
      const choiceLabel = element('span', { 'aria-hidden': 'true' });
      const set = element(
        'fieldset',
        { 'data-feature': feature },
        element('legend', {}, CATALOGUE[feature].title, choiceLabel),
        element('div', { class: 'choices' }, ...choicesOf(feature).map((choice) => option(feature, choice))),
      );
      this.#groups.set(feature, { set, choiceLabel });
      form.append(set);
    }
    form.addEventListener('change', (event) => {
      const input = event.target as HTMLInputElement;
      onChoose(input.name as FeatureName, input.value);
    });
    form.addEventListener('submit', (event) => event.preventDefault());
  }

  show(configuration: Configuration): void {
    for (const [feature, { set, choiceLabel }] of this.#groups) {
      const input = set.querySelector<HTMLInputElement>(`#${feature}-${configuration[feature]}`);
      if (input) input.checked = true;
      set.disabled = !applies(configuration, feature);
      choiceLabel.textContent = set.disabled ? '' : chosen(configuration, feature).title;
    }
  }
}
