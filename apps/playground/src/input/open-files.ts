import type { Scene } from '@glanz/scene';
import type { Selection } from '../selection';
import type { State } from '../state/state';
import type { Store } from '../state/store';
import type { Message } from '../ui/messages';
import type { Session } from '../viewer/session';
import type { Environments } from './environments';
import type { ModelRequest } from './load-messages';
import { environmentNote, othersNote, sortFiles } from './sort-files';

/** What files that are opened change. */
export interface FilesHost {
  readonly store: Store<State>;
  readonly session: Session;
  readonly selection: Selection;
  readonly environments: Environments;
  /** As loaded, of the model that is shown. */
  readonly scene: () => Scene | undefined;
  readonly load: (request: ModelRequest) => Promise<void>;
  /** Another image file is the environment. */
  readonly onEnvironmentFile: () => void;
  readonly clearErrors: () => void;
  readonly show: (message: Message) => void;
}

/**
 * Opens what was dropped or picked: a model, an environment, a material, or several of them.
 *
 * @throws What is wrong with the files, as a typed error.
 */
export async function openFiles(host: FilesHost, files: ReadonlyMap<string, File>): Promise<void> {
  const { store, session, environments, clearErrors, show } = host;
  const { model, others, environment, material } = sortFiles(files);
  let note: string | undefined;
  if (environment) {
    try {
      await environments.load(environment);
    } catch (error) {
      // A model that came with it is still shown.
      if (!model) throw error;
      note = environmentNote(error);
    }
  }
  if (environment && !note) {
    clearErrors();
    // Another file under the same choice is no change of state.
    if (store.state.environment === 'file')
      session.edit('environment', (tracer) => tracer.setEnvironment(environments.choose(store.state, host.scene())));
    else store.set({ environment: 'file' }, { label: 'Environment' });
    host.onEnvironmentFile();
  }
  if (model) await host.load({ kind: 'files', files: model.files, entry: model.entry });
  if (model && others) show({ kind: 'note', text: othersNote(model.entry, others) });
  if (note) show({ kind: 'note', text: note, code: 'playground/environment', stays: true });
  if (material && !model && host.scene()) await openMaterial(host, material, files);
}

/** Puts the material of a MaterialX file in place of the chosen one. */
async function openMaterial(
  { store, selection, scene, clearErrors, show }: FilesHost,
  file: File,
  files: ReadonlyMap<string, File>,
): Promise<void> {
  const [{ materialFromFiles }, { replaceMaterials }] = await Promise.all([
    import('../output/materialx'),
    import('../ui/material/edits'),
  ]);
  const { parameters, slots, name, notes } = await materialFromFiles(file, files);
  const { material: index } = selection.chosen;
  const target = scene()?.materials[index];
  if (!target) return;
  replaceMaterials(store, scene()?.materials ?? [], [index], parameters, `MaterialX "${name}"`, slots);
  clearErrors();
  show({ kind: 'note', text: [`The material "${name}" replaces "${target.name}".`, ...notes.slice(0, 1)].join(' ') });
}
