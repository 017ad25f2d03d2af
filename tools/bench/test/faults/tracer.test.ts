import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { FaultRecorder, instrumentDevice, loseDevice } from '@glanz/gpu/faults';
import { requestDevice, type PathTracer } from '@glanz/renderer';
import { createGpu } from '@glanz/renderer/node';
import { expect, it } from 'vitest';
import { Journal } from '../../src/faults/journal';
import { survived } from '../../src/faults/outcome';
import { tracerCampaign } from '../../src/faults/tracer';
import { createTracer, look } from '../../src/faults/tracer-steps';

const open = async () => requestDevice({ gpu: (await createGpu({ software: 'only' })).gpu });

it('a fixed part of the campaign: no memory, refused calls and refused mappings, at each 8th call, end in the right image or a typed error', async () => {
  const steps = [
    'create',
    'read albedo',
    'setMaterial that begins to emit',
    'setVisibility of a new mesh',
    'resize',
    'saveFilm',
  ];
  const journal = new Journal();
  await tracerCampaign({ open, steps, faults: ['out-of-memory', 'validation', 'map'], every: 8, journal });
  const { outcomes } = journal;
  expect(outcomes.filter((outcome) => !survived(outcome))).toEqual([]);
  expect(outcomes.length).toBeGreaterThan(15);
});

it('ten tracers, some of them refused memory and the last lost with its device: none is reachable, and no GPU memory stays', async () => {
  setFlagsFromString('--expose-gc');
  const collect = runInNewContext('gc') as () => void;
  const recorder = new FaultRecorder();
  const device = instrumentDevice(await open(), recorder);
  const references: WeakRef<object>[] = [];
  // A function of its own, so that no variable of this one keeps a tracer.
  const round = async (i: number): Promise<void> => {
    recorder.phase = 'round';
    recorder.clear(
      i % 3 === 1
        ? {
            point: `createBuffer "glanz ${['nodes', 'paths', 'film total'][(i - 1) / 3]}" #1 in round`,
            fault: 'out-of-memory',
          }
        : undefined,
    );
    let tracer: PathTracer | undefined;
    try {
      tracer = await createTracer(device);
      references.push(
        new WeakRef(tracer),
        new WeakRef(tracer.scene),
        ...tracer.scene.meshes.map(({ positions }) => new WeakRef(positions.buffer)),
      );
      await look(tracer);
      if (i === 9) loseDevice(device, 'unknown');
      await tracer.setVisibility('extra', true);
    } catch (error) {
      expect((error as { code?: string }).code).toBe(i === 9 ? 'renderer/device-lost' : 'renderer/out-of-memory');
    }
    tracer?.destroy();
  };
  for (let i = 0; i < 10; i++) await round(i);
  expect([...recorder.live.values()]).toEqual([]);
  expect(references.length).toBeGreaterThan(30);
  // Promises of the last round settle in later turns.
  for (let turn = 0; turn < 30 && references.some((reference) => reference.deref()); turn++) {
    await new Promise((resolve) => setTimeout(resolve, 10));
    collect();
  }
  expect(references.filter((reference) => reference.deref()).length).toBe(0);
});
