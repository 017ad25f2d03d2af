import { requestDevice } from '@glanz/renderer';
import { createGpu, listGpus } from '@glanz/renderer/node';

for (const { name, backend, software } of await listGpus())
  console.log(name, backend, software ? '(processor)' : '');

const { gpu, adapterName, software } = await createGpu({
  gpu: 'nvidia',
  software: 'never',
});
const device = await requestDevice({ gpu });
console.log(`on ${adapterName}${software ? ', in software' : ''}`);
device.destroy(); // lets the process end
