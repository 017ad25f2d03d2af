import { parentPort } from 'node:worker_threads';
import { bandOf, type LinearBand } from './png-bands';

// A thread of `PngThreads`: one band after another.
parentPort?.on('message', (band: LinearBand) => {
  void bandOf(band).then((made) => parentPort?.postMessage(made));
});
