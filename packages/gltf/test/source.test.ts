import { mkdtemp, mkdir, rm, symlink, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { afterAll, beforeAll, describe, expect, test } from 'vitest';
import { loadGltf } from '../src/index';
import { GltfError, loadGltfFile } from '../src/node';
import { glb, spoiled, triangle } from './build';

const sound = spoiled(() => undefined);

/** The triangle as a .gltf that names its buffer. */
function separate(uri: string): { document: Uint8Array<ArrayBuffer>; binary: Uint8Array<ArrayBuffer> } {
  const { json, binary } = triangle();
  json['buffers'][0].uri = uri;
  return { document: new TextEncoder().encode(JSON.stringify(json)), binary };
}

const error = async (load: Promise<unknown>): Promise<GltfError> => {
  const caught: unknown = await load.then(
    () => undefined,
    (e: unknown) => e,
  );
  expect(caught).toBeInstanceOf(GltfError);
  expect((caught as GltfError).message).not.toMatch(/\n/);
  return caught as GltfError;
};

describe('bytes', () => {
  test('an ArrayBuffer, a view into a larger one, a data: uri within', async () => {
    const larger = new Uint8Array(sound.length + 10);
    larger.set(sound, 7);
    const inline = separate(
      `data:application/octet-stream;base64,${btoa(String.fromCharCode(...triangle().binary))}`,
    ).document;
    for (const input of [sound.buffer, larger.subarray(7, 7 + sound.length), inline])
      expect((await loadGltf(input)).instances.length).toBe(1);
  });

  test('files beside bytes need a baseUrl', async () => {
    const { document, binary } = separate('a.bin');
    expect((await error(loadGltf(document))).code).toBe('gltf/missing-resource');
    const asked: string[] = [];
    const fetch = async (url: URL | RequestInfo) => {
      asked.push(String(url));
      return new Response(binary);
    };
    await loadGltf(document, { baseUrl: 'https://example.test/models/', fetch });
    expect(asked).toEqual(['https://example.test/models/a.bin']);
  });
});

describe('addresses', () => {
  test('the document, then what it names, relative to it; names are decoded once', async () => {
    const { document, binary } = separate('my%20data%23.bin');
    const asked: string[] = [];
    // Browsers refuse their fetch as a method of another object.
    const fetch = async function (this: unknown, url: URL | RequestInfo) {
      expect(this).toBeUndefined();
      asked.push(String(url));
      return new Response(asked.length === 1 ? document : binary);
    };
    const scene = await loadGltf('https://example.test/a/model.gltf?v=2', { fetch: fetch as typeof globalThis.fetch });
    expect(asked).toEqual(['https://example.test/a/model.gltf?v=2', 'https://example.test/a/my%20data%23.bin']);
    expect(scene.name).toBe('model.gltf');
  });

  test('the global fetch reads blob: and data: addresses', async () => {
    const url = URL.createObjectURL(new Blob([sound]));
    expect((await loadGltf(url)).instances.length).toBe(1);
    URL.revokeObjectURL(url);
    const { document } = separate('a.bin');
    expect((await error(loadGltf(`data:model/gltf+json;base64,${btoa(String.fromCharCode(...document))}`))).code).toBe(
      'gltf/missing-resource',
    );
  });

  test('a file missing on the server, an unreachable server, an invalid URL', async () => {
    expect(
      (
        await error(
          loadGltf('https://example.test/x.glb', {
            fetch: async () => new Response(null, { status: 404, statusText: 'Not Found' }),
          }),
        )
      ).message,
    ).toMatch(/x\.glb.*404 Not Found/);
    expect(
      (await error(loadGltf('https://example.test/x.glb', { fetch: () => Promise.reject(new TypeError('no route')) })))
        .message,
    ).toMatch(/no route/);
    expect((await error(loadGltf('models/x.glb'))).message).toMatch(/"models\/x\.glb" is not a valid URL on its own/);
  });

  test.each(['https://evil.test/x', '//evil.test/x', '/etc/passwd', 'file:///etc/passwd', '\\\\evil\\x', 'a:b'])(
    'a document may not name %s',
    async (uri) => {
      const asked: string[] = [];
      const fetch = async (url: URL | RequestInfo) => {
        asked.push(String(url));
        return new Response(separate(uri).document);
      };
      expect((await error(loadGltf('https://example.test/m/x.gltf', { fetch }))).code).toBe('gltf/missing-resource');
      expect(asked.length).toBe(1);
    },
  );

  test.each(['../../secret', '%2e%2e/%2e%2e/secret', 'a/../../secret'])(
    'nor leave the folder of its own by %s',
    async (uri) => {
      const asked: string[] = [];
      const fetch = async (url: URL | RequestInfo) => {
        asked.push(new URL(String(url)).href);
        return new Response(separate(uri).document);
      };
      await error(loadGltf('https://example.test/m/n/x.gltf', { fetch }));
      expect(asked).toEqual(['https://example.test/m/n/x.gltf']);
    },
  );
});

describe('files', () => {
  const { document, binary } = separate('data/a.bin');

  test('the only document among them, wherever it is; Blobs and bytes', async () => {
    const files = new Map<string, Uint8Array<ArrayBuffer> | Blob>([
      ['model/m.gltf', new Blob([document])],
      ['model/data/a.bin', binary],
      ['notes.txt', binary],
    ]);
    expect((await loadGltf({ files })).instances.length).toBe(1);
    expect((await loadGltf({ files, entry: './model/m.gltf' })).instances.length).toBe(1);
  });

  test('none, several, a wrong choice, a missing one', async () => {
    expect((await error(loadGltf({ files: new Map() }))).message).toMatch(/no \.gltf or \.glb/);
    expect(
      (
        await error(
          loadGltf({
            files: new Map([
              ['a.glb', sound],
              ['b.glb', sound],
            ]),
          }),
        )
      ).message,
    ).toMatch(/a\.glb, b\.glb/);
    expect((await error(loadGltf({ files: new Map([['a.glb', sound]]), entry: 'c.glb' }))).message).toMatch(/"c\.glb"/);
    expect((await error(loadGltf({ files: new Map([['m.gltf', document]]) }))).message).toMatch(
      /m\.gltf names the file "data\/a\.bin"/,
    );
  });
});

describe('in Node', () => {
  let folder: string;
  beforeAll(async () => {
    folder = await mkdtemp(join(tmpdir(), 'gltf-'));
    await mkdir(join(folder, 'in'));
    const { document, binary } = separate('a%20b.bin');
    await Promise.all([
      writeFile(join(folder, 'in/sound.glb'), sound),
      writeFile(join(folder, 'in/m.gltf'), document),
      writeFile(join(folder, 'in/a b.bin'), binary),
      writeFile(join(folder, 'secret.bin'), binary),
    ]);
    await writeFile(join(folder, 'in/out.gltf'), separate('../secret.bin').document);
    await symlink(join(folder, 'secret.bin'), join(folder, 'in/link.bin'));
    await writeFile(join(folder, 'in/link.gltf'), separate('link.bin').document);
  });
  afterAll(() => rm(folder, { recursive: true }));

  test('files with what they name beside them', async () => {
    for (const name of ['sound.glb', 'm.gltf'])
      expect((await loadGltfFile(join(folder, 'in', name))).instances.length).toBe(1);
    expect((await loadGltfFile(new URL(`file://${folder}/in/sound.glb`))).name).toBe('sound.glb');
  });

  test.each(['out.gltf', 'link.gltf'])('nothing outside the folder is read: %s', async (name) => {
    expect((await error(loadGltfFile(join(folder, 'in', name)))).code).toBe('gltf/missing-resource');
  });

  test('a file that does not exist, a folder', async () => {
    expect((await error(loadGltfFile(join(folder, 'none.glb')))).message).toMatch(
      /none\.glb cannot be read: there is no such file/,
    );
    expect((await error(loadGltfFile(folder))).code).toBe('gltf/missing-resource');
  });
});

test("progress is reported; abort rejects with the signal's reason", async () => {
  const stages: string[] = [];
  await loadGltf(sound, { onProgress: ({ stage, done }) => stages.push(`${stage} ${done}`) });
  expect(stages).toEqual(['read 1', 'decode 1']);
  const reason = new Error('enough');
  await expect(loadGltf(sound, { signal: AbortSignal.abort(reason) })).rejects.toBe(reason);
  const controller = new AbortController();
  const waiting = loadGltf('https://example.test/x.glb', {
    signal: controller.signal,
    fetch: (_, init) =>
      new Promise((_resolve, reject) =>
        init!.signal!.addEventListener('abort', () => reject(new Error('fetch gave up'))),
      ),
  });
  controller.abort(reason);
  await expect(waiting).rejects.toBe(reason);
});

test('a document without triangles is an error, unless the host allows it', async () => {
  const empty = glb({ asset: { version: '2.0' } });
  expect((await error(loadGltf(empty))).code).toBe('gltf/no-triangles');
  expect((await loadGltf(empty, { allowEmpty: true })).instances).toEqual([]);
});

test('a name with a lone surrogate is a missing file', async () => {
  const { json } = triangle();
  json['buffers'][0].uri = '\ud800.bin';
  await expect(
    loadGltf(new TextEncoder().encode(JSON.stringify(json)), {
      baseUrl: 'https://example.org/',
      fetch: () => Promise.reject(new Error('none')),
    }),
  ).rejects.toMatchObject({ code: 'gltf/missing-resource' });
});

test('a download is reported as it comes, left when it is more than allowed', async () => {
  const whole = spoiled(() => undefined);
  const respond = (headers: Record<string, string>, endless = false) => {
    let at = 0,
      cancelled = false;
    const body = new ReadableStream<Uint8Array>({
      pull(controller) {
        if (endless) controller.enqueue(new Uint8Array(1024));
        else if (at >= whole.length) controller.close();
        else controller.enqueue(whole.subarray(at, (at += 100)));
      },
      cancel: () => {
        cancelled = true;
      },
    });
    return { fetch: () => Promise.resolve(new Response(body, { headers })), wasCancelled: () => cancelled };
  };
  const heard: number[] = [];
  const good = respond({ 'content-length': String(whole.length) });
  await loadGltf('https://example.org/a.glb', {
    fetch: good.fetch,
    onProgress: ({ stage, done }) => {
      if (stage === 'read') heard.push(done);
    },
  });
  expect(heard.length).toBeGreaterThan(3);
  expect(heard).toEqual(heard.toSorted((a, b) => a - b));
  expect(heard.at(-1)).toBe(1);
  const endless = respond({}, true);
  await expect(
    loadGltf('https://example.org/a.glb', { fetch: endless.fetch, limits: { fileBytes: 100_000 } }),
  ).rejects.toMatchObject({ code: 'gltf/too-large' });
  expect(endless.wasCancelled()).toBe(true);
  await expect(
    loadGltf('https://example.org/a.glb', { fetch: respond({ 'content-length': '5000000000' }).fetch }),
  ).rejects.toMatchObject({ code: 'gltf/too-large' });
});
