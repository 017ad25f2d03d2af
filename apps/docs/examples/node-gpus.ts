import { requestDevice } from '@glanz/renderer';
import { createGpu, listGpus } from '@glanz/renderer/node';

for (const { name, backend, software } of await listGpus())
  console.log(name, backend, software ? '(CPU)' : '');

const { gpu, adapterName, software } = await createGpu({
  gpu: 'nvidia',
  software: 'never',
});
const device = await requestDevice({ gpu });
console.log(`on ${adapterName}${software ? ', on the CPU' : ''}`);
device.destroy(); // lets the process end
