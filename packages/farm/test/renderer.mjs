// A renderer's process for tests, written against the protocol. A job's payload says how it behaves:
// { text }: a file with this text; { ms }: how long it takes; { exit }: it ends the process;
// { fail: kind, times }: it fails, that often; { block }: it keeps the event loop busy for so many milliseconds.
import { appendFileSync, existsSync, readFileSync, writeFileSync } from 'node:fs';
import { join } from 'node:path';

const log = process.argv[2];
let stopped = () => undefined;

process.on('disconnect', () => process.exit());
process.on('SIGTERM', () => undefined);
process.on('message', async (message) => {
  if (message.type === 'stop') return stopped();
  const { job, folder, checkpoint } = message;
  const { text = '', ms = 0, exit, fail = process.env.TEST_FAIL, times = Infinity, block = 0 } = job.payload;
  const from = existsSync(checkpoint) ? Number(readFileSync(checkpoint, 'utf8')) : 0;
  appendFileSync(log, `begin ${job.id} ${process.pid} ${from}\n`);
  process.stdout.write(`rendering ${job.label}\n`);
  const before = readFileSync(log, 'utf8').split(`begin ${job.id} `).length - 2;
  if (exit !== undefined) {
    process.stderr.write('about to end\n');
    process.kill(process.pid, 'SIGKILL');
    return;
  }
  if (fail !== undefined && before < times)
    return process.send({ type: 'failed', kind: fail, code: `test/${fail}`, message: `It fails by ${fail}.` });
  for (const end = Date.now() + block; Date.now() < end;);
  const stop = new Promise((done) => (stopped = () => done('stop')));
  const steps = Math.ceil(ms / 20);
  for (let step = from; step < steps; step++) {
    process.send({ type: 'progress', samples: step, of: steps });
    if ((await Promise.race([stop, new Promise((done) => setTimeout(done, 20))])) === 'stop') {
      writeFileSync(checkpoint, String(step));
      return process.send({ type: 'stopped' });
    }
  }
  writeFileSync(join(folder, 'image.txt'), text);
  appendFileSync(log, `end ${job.id} ${process.pid}\n`);
  process.send({ type: 'done', files: ['image.txt'], info: { samples: steps } });
});
