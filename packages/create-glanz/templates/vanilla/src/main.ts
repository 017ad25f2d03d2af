import '@glanz/element/define';

const viewer = document.querySelector('glanz-viewer')!;
const status = document.querySelector('output')!;
const save = document.querySelector('button')!;

viewer.addEventListener('sample', ({ detail: { samples, target } }) => {
  status.textContent = `${samples} of ${target} samples per pixel`;
});
viewer.addEventListener('error', ({ detail: { message } }) => {
  status.textContent = message;
});

save.addEventListener('click', async () => {
  const link = document.createElement('a');
  link.href = URL.createObjectURL(await viewer.toBlob());
  link.download = 'image.png';
  link.click();
  URL.revokeObjectURL(link.href);
});
