// Workers of packages that are bundled from their sources: `new URL('./worker.js', import.meta.url)` names the built
// file, which lies beside the source as `worker.ts`. Only newer versions of Vite find that by themselves.
import { existsSync } from 'node:fs';

/** A plugin for Vite and its workers. */
export function sourceWorkers() {
  return {
    name: 'source-workers',
    resolveId(id: string): string | undefined {
      const source = id.replace(/\.js$/, '.ts');
      return source !== id && id.startsWith('/') && !existsSync(id) && existsSync(source) ? source : undefined;
    },
  };
}
