import { createScene, defaultMaterial, type Scene } from '@glanz/scene';
import { FormatError } from './error';
import { MeshBuilder } from './mesh-builder';
import { orientation } from './orientation';

/** Options for {@link readStl}. */
export interface StlOptions {
  /** What messages and the mesh are called. Default: the name in the file, or "STL". */
  readonly name?: string;
  /** The up axis of the file. STL does not define one; most files come from CAD programs. Default `z`. */
  readonly up?: 'y' | 'z';
  /** Metres a unit of the file; default 1. Parts in millimetres: 0.001. */
  readonly unit?: number;
}

const HEAD = 84;
const FACET = 50;

/**
 * Reads an STL file, binary or text, as a scene of one flat-shaded mesh in the default material. Corners at the same
 * place become one vertex; the facets' own normals are not read, the order of their corners counts.
 *
 * @throws {FormatError} `formats/truncated`, `formats/malformed`, `formats/no-triangles`.
 * @example
 * const scene = readStl(bytes, { unit: 0.001 });
 */
export function readStl(bytes: Uint8Array, { name, up = 'z', unit = 1 }: StlOptions = {}): Scene {
  const label = name ?? 'STL';
  const builder = new MeshBuilder();
  // "solid" begins texts, and the headers of many binary files: the length decides.
  const binary =
    bytes.length >= HEAD &&
    bytes.length === HEAD + FACET * new DataView(bytes.buffer, bytes.byteOffset).getUint32(80, true);
  const text = !binary && startsWith(bytes, 'solid');
  const title = text ? readText(bytes, builder, label) : readBinary(bytes, builder, label);
  const mesh = builder.build(name ?? (title || 'STL'));
  if (!mesh)
    throw new FormatError('formats/no-triangles', `${label} has no triangles: there is nothing to show.`, {
      location: { file: label },
    });
  const scene = createScene(mesh.name);
  scene.meshes.push(mesh);
  scene.materials.push(defaultMaterial());
  scene.instances.push({ name: mesh.name, mesh: 0, material: 0, transform: orientation(up, unit) });
  if (builder.dropped > 0)
    scene.warnings.push({
      code: 'formats/not-finite',
      message: `${label}: ${builder.dropped} triangles have corners that are not finite and are left out.`,
    });
  return scene;
}

const startsWith = (bytes: Uint8Array, text: string) => [...text].every((c, i) => bytes[i] === c.charCodeAt(0));

function readBinary(bytes: Uint8Array, builder: MeshBuilder, name: string): string {
  if (bytes.length < HEAD)
    throw new FormatError('formats/truncated', `${name} has ${bytes.length} bytes, fewer than an STL file's head.`, {
      location: { file: name },
    });
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const count = view.getUint32(80, true);
  if (HEAD + FACET * count > bytes.length)
    throw new FormatError(
      'formats/truncated',
      `${name} has ${bytes.length} bytes, but ${count} triangles need ${HEAD + FACET * count}: it is truncated, or not an STL file.`,
      { location: { file: name, byteOffset: 80 } },
    );
  for (let i = 0, at = HEAD + 12; i < count; i++, at += FACET) {
    const corner = (k: number) =>
      [
        view.getFloat32(at + 12 * k, true),
        view.getFloat32(at + 12 * k + 4, true),
        view.getFloat32(at + 12 * k + 8, true),
      ] as const;
    builder.triangle(corner(0), corner(1), corner(2));
  }
  return '';
}

function readText(bytes: Uint8Array, builder: MeshBuilder, name: string): string {
  const text = new TextDecoder().decode(bytes);
  const title = /^solid[ \t]*([^\r\n]*)/.exec(text)?.[1]?.trim() ?? '';
  const corners: (readonly [number, number, number])[] = [];
  const pattern = /\b(vertex|endfacet)\b[ \t]*([^\r\n]*)/gi;
  for (let found = pattern.exec(text); found; found = pattern.exec(text)) {
    if ((found[1] as string).toLowerCase() === 'vertex') {
      const [x = NaN, y = NaN, z = NaN] = (found[2] as string).trim().split(/\s+/).map(Number);
      corners.push([x, y, z]);
      continue;
    }
    if (corners.length !== 3)
      throw new FormatError('formats/malformed', `${name}: a facet has ${corners.length} corners instead of 3.`, {
        location: { file: name, byteOffset: found.index },
      });
    builder.triangle(
      corners[0] as readonly [number, number, number],
      corners[1] as readonly [number, number, number],
      corners[2] as readonly [number, number, number],
    );
    corners.length = 0;
  }
  return title;
}
