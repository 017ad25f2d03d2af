import { byId } from '../ui/elements';
import { filesOfDrop, filesOfInput } from './files';

/** Kind of data under which a preset travels by drag and drop. */
const PRESET = 'text/x-glanz-preset';

export interface FileEvents {
  readonly onFiles: (files: ReadonlyMap<string, File> | Promise<ReadonlyMap<string, File>>) => void;
  /** A preset was dropped on the image, at shares of its width and height. */
  readonly onPreset: (name: string, x: number, y: number) => void;
}

/** Buttons that open files, and what is dropped on the page. */
export function wireFiles({ onFiles, onPreset }: FileEvents): void {
  for (const [button, input] of [
    ['open', 'files'],
    ['open-folder', 'folder'],
  ] as const) {
    const picker = byId<HTMLInputElement>(input);
    byId(button).addEventListener('click', () => picker.click());
    picker.addEventListener('change', () => {
      const files = filesOfInput(picker);
      // So that the same file can be chosen again.
      picker.value = '';
      if (files.size > 0) onFiles(files);
    });
  }
  const drop = byId('drop');
  const stage = byId('stage');
  const carries = (event: DragEvent, type: string) => event.dataTransfer?.types.includes(type) ?? false;
  window.addEventListener('dragover', (event) => {
    const preset = carries(event, PRESET);
    if (!preset && !carries(event, 'Files')) return;
    if (event.defaultPrevented || (preset && !stage.contains(event.target as Node))) return;
    event.preventDefault();
    drop.hidden = preset;
  });
  window.addEventListener('dragleave', (event) => {
    if (event.relatedTarget === null) drop.hidden = true;
  });
  // A row of a parameter took it.
  window.addEventListener('dropped', () => (drop.hidden = true));
  window.addEventListener('drop', (event) => {
    drop.hidden = true;
    if (!event.dataTransfer) return;
    const preset = event.dataTransfer.getData(PRESET);
    if (preset && stage.contains(event.target as Node)) {
      event.preventDefault();
      const { left, top, width, height } = stage.getBoundingClientRect();
      onPreset(preset, (event.clientX - left) / width, (event.clientY - top) / height);
    } else if (carries(event, 'Files')) {
      event.preventDefault();
      onFiles(filesOfDrop(event.dataTransfer));
    }
  });
}
