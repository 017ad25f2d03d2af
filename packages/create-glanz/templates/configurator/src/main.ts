import { createViewer } from '@glanz/viewer';
import { assemblies, CATALOGUE, type Option } from './catalogue';

const viewer = createViewer(document.querySelector('canvas')!);
const form = document.querySelector('form')!;
const status = document.querySelector('output')!;

viewer.on('sample', ({ samples, target }) => {
  status.textContent = `one of ${assemblies}, ${samples} of ${target} samples`;
});
viewer.on('error', ({ message }) => {
  status.textContent = message;
});

/** Shows one choice: its parts, without those of the others, and its materials. */
async function choose(option: Option, name: string): Promise<void> {
  const chosen = option.choices.find((choice) => choice.name === name);
  if (!chosen) return;
  const parts = new Set(option.choices.flatMap(({ shows }) => shows ?? []));
  await Promise.all([
    ...[...parts].map((part) =>
      viewer.setVisibility(part, chosen.shows?.includes(part) ?? false),
    ),
    ...Object.entries(chosen.materials ?? {}).map(([material, edit]) =>
      viewer.setMaterial(material, edit),
    ),
  ]);
}

/** The choices in the page's address, which can be sent to others. */
const address = new URLSearchParams(location.hash.slice(1));

/** A row of buttons for one option. @returns Its choice at the start. */
function row(option: Option): string {
  const asked = address.get(option.name);
  const [first] = option.choices;
  const chosen = option.choices.find(({ name }) => name === asked) ?? first!;
  const fieldset = document.createElement('fieldset');
  const legend = document.createElement('legend');
  legend.textContent = option.name;
  fieldset.append(legend);
  for (const { name } of option.choices) {
    const label = document.createElement('label');
    const input = document.createElement('input');
    Object.assign(input, {
      type: 'radio',
      name: option.name,
      value: name,
      checked: name === chosen.name,
    });
    input.addEventListener('change', () => {
      address.set(option.name, name);
      history.replaceState(null, '', `#${address}`);
      void choose(option, name);
    });
    label.append(input, name);
    fieldset.append(label);
  }
  document.querySelector('#options')!.append(fieldset);
  return chosen.name;
}

form.querySelector('button')!.addEventListener('click', async () => {
  const image = await viewer.toBlob({ width: 1600, height: 1200 });
  const link = document.createElement('a');
  link.href = URL.createObjectURL(image);
  link.download = 'push-button.png';
  link.click();
  URL.revokeObjectURL(link.href);
});

const chosen = CATALOGUE.map((option) => [option, row(option)] as const);
await viewer.load('/push-button.glb');
await Promise.all(chosen.map(([option, name]) => choose(option, name)));
