import { loadGltf } from '@glanz/gltf';
import { GlanzError } from '@glanz/scene';

export async function open(url: string, say: (text: string) => void) {
  try {
    return await loadGltf(url);
  } catch (error) {
    if (!(error instanceof GlanzError)) throw error; // a bug: let it surface
    if (error.code === 'gltf/truncated')
      say('The file is incomplete. Load it again?');
    else say(error.message);
    return undefined;
  }
}
