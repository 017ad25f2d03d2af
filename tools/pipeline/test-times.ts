// A setup file of Vitest. Where GLANZ_TEST_TIMES names a file, the processor time of each test is appended to it: a line
// of JSON with `file`, `test` and `cpu`, in seconds over all threads of the process, those of a software GPU among them.
// Unlike time on a clock it does not depend on what else the machine does. The rest of a file (imports, hooks, in the
// first file of a process also its start) has an empty `test`. Child processes are not counted.
import { appendFileSync } from 'node:fs';
import { afterAll, afterEach, beforeEach, expect } from 'vitest';

const target = process.env['GLANZ_TEST_TIMES'];

if (target) {
  const seconds = () => {
    const { user, system } = process.cpuUsage();
    return (user + system) / 1e6;
  };
  // Files may share a process, and each runs this file again.
  const shared = globalThis as { glanzTestTimes?: { noted: number } };
  const noted = (shared.glanzTestTimes ??= { noted: 0 });
  const note = (cpu: number, test = '') => {
    noted.noted += cpu;
    appendFileSync(target, `${JSON.stringify({ file: expect.getState().testPath, test, cpu })}\n`);
  };
  let start = 0;
  beforeEach(() => {
    start = seconds();
  });
  afterEach(() => note(seconds() - start, expect.getState().currentTestName));
  afterAll(() => note(seconds() - noted.noted));
}
