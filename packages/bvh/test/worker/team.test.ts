import { describe, expect, it } from 'vitest';
import { release, Team, teamMemory, reportCopied } from '../../src/worker/team';

const mesh = { positions: new Float32Array(9 * 100) };
const both = () => {
  const { memory } = teamMemory(mesh, 100);
  return [new Team(0, memory), new Team(1, memory)] as const;
};

describe('Team', () => {
  it('gives each number of a counter to one of both', () => {
    const [a, b] = both();
    expect([a.take(0), b.take(0), b.take(0), a.take(0)]).toEqual([0, 1, 2, 3]);
    expect(b.take(1)).toBe(0);
  });

  it('gives both the same memory, block by block', () => {
    const [a, b] = both();
    const first = a.uint32(3),
      second = a.int32(2),
      third = a.float32(5);
    expect([first.byteOffset % 64, second.byteOffset % 64, third.byteOffset % 64]).toEqual([0, 0, 0]);
    first.set([7, 8, 9]);
    second.set([-1, -2]);
    third.set([0.5], 4);
    expect([...b.uint32(3)]).toEqual([7, 8, 9]);
    expect([...b.int32(2)]).toEqual([-1, -2]);
    expect(b.float32(5)[4]).toBe(0.5);
  });

  // One thread plays both, so the second must not have to wait.
  it('does not wait for what is published already', () => {
    const [a, b] = both();
    b.publish();
    a.published();
    reportCopied(a.memory, 300);
    for (const team of [a, b]) team.copied(300);
    expect([a.peerGaveUp, b.peerGaveUp]).toEqual([false, false]);
  });

  it('throws where the other one has given up before, instead of waiting for ever', () => {
    for (const wait of [
      (team: Team) => team.meet(),
      (team: Team) => team.published(),
      (team: Team) => team.copied(1),
    ]) {
      const [a, b] = both();
      a.giveUp();
      expect(() => wait(b)).toThrow(expect.objectContaining({ code: 'bvh/worker' }) as Error);
      expect(b.peerGaveUp).toBe(true);
    }
  });

  it('throws at both where the mesh does not come', () => {
    for (const team of both()) {
      release(team.memory);
      expect(() => team.copied(1)).toThrow(expect.objectContaining({ code: 'bvh/worker' }) as Error);
    }
  });
});
