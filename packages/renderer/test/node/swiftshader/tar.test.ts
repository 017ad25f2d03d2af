import { execFileSync } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { describe, expect, it } from 'vitest';
import { readTar } from '../../../src/node/swiftshader/tar';

/** An archive by the system's own tar. */
function archive(files: Record<string, Uint8Array>): Uint8Array {
  const folder = mkdtempSync(join(tmpdir(), 'glanz-tar-'));
  try {
    for (const [name, data] of Object.entries(files)) writeFileSync(join(folder, name), data);
    return execFileSync('tar', ['--format=ustar', '-cf', '-', '-C', folder, '.'], { maxBuffer: 1 << 24 });
  } finally {
    rmSync(folder, { recursive: true });
  }
}

describe('readTar', () => {
  it('reads what tar wrote, whatever the sizes', () => {
    const files = {
      empty: new Uint8Array(0),
      short: Uint8Array.of(1, 2, 3),
      block: new Uint8Array(512).fill(7),
      long: Uint8Array.from({ length: 5000 }, (_, i) => i),
    };
    const entries = readTar(archive(files));
    expect(Object.fromEntries(entries.map((entry) => [entry.name, Array.from(entry.data)]))).toEqual(
      Object.fromEntries(Object.entries(files).map(([name, data]) => [name, Array.from(data)])),
    );
  });

  it('refuses an archive that is cut short', () => {
    const whole = archive({ long: new Uint8Array(5000).fill(1) });
    const header = Buffer.from(whole).indexOf('long');
    expect(() => readTar(whole.subarray(0, Math.floor(header / 512) * 512 + 512 + 1000))).toThrow(/cut short/);
  });
});
