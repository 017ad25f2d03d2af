import { FilmDenoiser } from '@glanz/denoise/film';
import { denoising } from '@glanz/viewer/denoise';

// Fetched once, for every viewer and every device.
const address = new URL('rt_hdr_alb_nrm_small.tza', import.meta.url);
const weights = fetch(address).then((response) => response.arrayBuffer());

export default denoising(async (device) =>
  FilmDenoiser.create(device, { color: await weights }),
);
