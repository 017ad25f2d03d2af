import { mkdirSync, writeFileSync } from 'node:fs';
import { publishedSource } from '../../tools/pipeline/published-source.mjs';
import { glanzPackage } from '../../tsup.base';
import { customElements } from './scripts/custom-elements.mjs';
import { writeSample } from './scripts/sample.mjs';
import { buildSingleFile } from './scripts/single-file.mjs';
import { packedWasm } from './scripts/wasm.mjs';

export default {
  ...glanzPackage({
    index: 'src/index.ts',
    define: 'src/define.ts',
    decoders: 'src/decoders/index.ts',
  }),
  esbuildPlugins: [packedWasm(process.cwd()), publishedSource],
  onSuccess: async () => {
    mkdirSync('dist', { recursive: true });
    writeFileSync('dist/custom-elements.json', `${JSON.stringify(customElements(process.cwd()), undefined, 2)}\n`);
    await buildSingleFile(process.cwd(), 'dist');
    await writeSample(process.cwd(), 'dist/push-button.glb');
  },
};
