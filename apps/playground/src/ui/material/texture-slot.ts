import type { OpenPbrParameterName } from '@glanz/openpbr/parameters';
import type { TexturedParameter } from '@glanz/scene';
import { readImage, slotOf } from '../../input/image-file';
import type { Slot } from '../../state/state';
import type { Context } from '../context';
import { element } from '../elements';
import { icon } from '../icons';
import { editSlots, slotState } from './edits';

/**
 * The button on a parameter's row that puts an image on it; images may be dropped on the row as well.
 *
 * @param index Of the material whose image is shown.
 * @param targets Of the materials that get it.
 */
export function textureSlot(
  context: Context,
  index: number,
  name: OpenPbrParameterName,
  title: string,
  row: HTMLElement,
  targets: () => readonly number[],
): () => void {
  const { store, opened, fail, say } = context;
  const material = opened().scene.materials[index];
  if (!material) return () => undefined;
  const parameter = name as TexturedParameter;
  const picker = element('input', {
    type: 'file',
    accept: 'image/*',
    hidden: true,
    'aria-label': `Texture of ${title}`,
  });
  const button = element(
    'button',
    { type: 'button', class: 'slot', 'aria-label': `Texture for ${title}`, title: 'Set a texture' },
    icon('image'),
  );
  const imageLabel = element('span', { class: 'slot-name' });
  const edit = (slot: Slot) => editSlots(store, opened().scene.materials, targets(), parameter, slot);
  const take = async (file: File) => {
    try {
      const image = await readImage(file);
      edit(slotOf(image, parameter));
      const { scene } = opened();
      if (
        !scene.instances.some(
          (instance) => instance.material === index && (scene.meshes[instance.mesh]?.uvs?.length ?? 0) > 0,
        )
      )
        say(
          `No part with the material "${material.name}" has UV coordinates: all of it has the colour of the texture’s corner.`,
        );
    } catch (error) {
      fail(error);
    }
  };
  button.addEventListener('click', () => {
    if (slotState(store.state, material, index, name)) edit(null);
    else picker.click();
  });
  picker.addEventListener('change', () => {
    const file = picker.files?.[0];
    picker.value = '';
    if (file) void take(file);
  });
  const carries = (event: DragEvent) => event.dataTransfer?.types.includes('Files') ?? false;
  row.addEventListener('dragover', (event) => {
    if (!carries(event)) return;
    event.preventDefault();
    row.classList.add('dropping');
  });
  row.addEventListener('dragleave', () => row.classList.remove('dropping'));
  row.addEventListener('drop', (event) => {
    row.classList.remove('dropping');
    const file = [...(event.dataTransfer?.files ?? [])].find(({ type }) => type.startsWith('image/'));
    // Anything else is for the page.
    if (!file) return;
    event.preventDefault();
    event.stopPropagation();
    window.dispatchEvent(new Event('dropped'));
    void take(file);
  });
  row.querySelector('label, .label')?.after(button);
  row.append(picker, imageLabel);
  return () => {
    const slot = slotState(store.state, material, index, name);
    button.setAttribute('aria-pressed', String(slot !== undefined));
    button.setAttribute('aria-label', slot ? `Remove the texture of ${title}` : `Texture for ${title}`);
    button.title = slot ? 'Remove the texture' : 'Set a texture';
    imageLabel.hidden = slot === undefined;
    imageLabel.textContent = slot ? `× ${slot.name}` : '';
  };
}
