import { describe, expect, it } from 'vitest';

describe('on a server', () => {
  it('can be imported, and defining the element does nothing', async () => {
    expect(typeof HTMLElement).toBe('undefined');
    const { defineGlanzViewer } = await import('../src/index');
    expect(() => defineGlanzViewer()).not.toThrow();
    await expect(import('../src/define')).resolves.toBeDefined();
  });
});
