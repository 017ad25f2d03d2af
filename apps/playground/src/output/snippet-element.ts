import type { Scene } from '@glanz/scene';
import type { OrbitView, State } from '../state/state';
import {
  addressOf,
  digits,
  environmentSource,
  environmentView,
  isNamed,
  isPlainStudio,
  literal,
  quoted,
} from './snippet-text';
import { editCalls, moveCalls } from './snippet-viewer';

/** A model with its view, for the element. */
export interface ElementView {
  /** Of the file or sample. */
  readonly name: string;
  /** For those who do not see the model. */
  readonly title: string;
  /** Where the camera is. */
  readonly orbit: OrbitView;
  /** Vertical field of view, degrees. */
  readonly fov: number;
}

type Attribute = readonly [name: string, value: string | number | true];

/** The attributes of `<glanz-viewer>` that say what the state says. */
function attributesOf(scene: Scene, state: State, { name, title, orbit, fov }: ElementView): Attribute[] {
  const { target, distance, yaw, pitch } = orbit;
  const { intensity, rotation } = environmentView(state);
  const clip = state.clip === null ? undefined : scene.animations?.[state.clip];
  const source = state.environment === 'file' ? '/environment.hdr' : isPlainStudio(state) ? 'neutral' : undefined;
  // With a skybox the environment is seen; without one the page is.
  const image =
    state.background === 'environment' && state.environment === 'file' ? 'skybox-image' : 'environment-image';
  const given: (readonly [string, Attribute[1] | undefined])[] = [
    ['src', addressOf(name)],
    ['alt', title],
    ['camera-controls', true],
    ['camera-orbit', `${digits(yaw)}rad ${digits(Math.PI / 2 - pitch)}rad ${digits(distance)}m`],
    ['camera-target', target.map((value) => `${digits(value)}m`).join(' ')],
    ['field-of-view', `${digits(fov)}deg`],
    [image, source],
    ['environment-intensity', intensity],
    ['environment-rotation', rotation === undefined ? undefined : `${digits(rotation)}rad`],
    ['shadow-intensity', state.floor ? 1 : undefined],
    ['exposure-ev', state.exposure === 0 ? undefined : state.exposure],
    ['tone-mapping', state.toneMap],
    ['variant-name', state.variant ?? undefined],
    ['animation-name', clip?.name],
    ['samples', state.samples],
    ['noise', state.noise === 0 ? undefined : state.noise],
    ['max-depth', state.maxDepth],
  ];
  return given.flatMap(([key, value]): Attribute[] =>
    value === undefined ? [] : [[key, typeof value === 'number' ? (digits(value) as number) : value]],
  );
}

/** Statements for what attributes do not say, and their imports. @param element An expression. */
function more(scene: Scene, state: State, element: string, edits: boolean): { imports: string[]; lines: string[] } {
  const needsCode = ['studio', 'constant', 'none'].includes(state.environment) && !isPlainStudio(state);
  const environment = needsCode ? environmentSource(state) : undefined;
  return {
    imports: environment?.imports ?? [],
    lines: [
      ...(environment ? [`${element}.viewer?.setEnvironment(${environment.value});`] : []),
      ...(edits ? editCalls(scene, state, `${element}.viewer?`) : []),
      ...moveCalls(scene, state, `${element}.viewer?`),
      ...(state.clip === null ? [] : [`${element.replace('?', '!')}.currentTime = ${digits(state.time)};`]),
    ],
  };
}

const escaped = (text: string) => text.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');

/** A piece of a page that shows the model with `<glanz-viewer>`, for a bundler such as Vite. */
export function htmlSnippet(scene: Scene, state: State, view: ElementView): string {
  const { imports, lines } = more(scene, state, 'element', true);
  const script = [
    "import '@glanz/element/define';",
    ...imports,
    ...(lines.length > 0
      ? [
          '',
          "const element = document.querySelector('glanz-viewer');",
          "element.addEventListener('load', () => {",
          ...lines.map((line) => `  ${line.replaceAll('\n', '\n  ')}`),
          '});',
        ]
      : []),
  ];
  return [
    '<glanz-viewer',
    ...attributesOf(scene, state, view).map(([key, value]) =>
      value === true ? `  ${key}` : `  ${key}="${escaped(String(value))}"`,
    ),
    '  style="width: 100%; height: 60vh"',
    '></glanz-viewer>',
    '<script type="module">',
    ...script.map((line) => (line ? `  ${line.replaceAll('\n', '\n  ')}` : '')),
    '</script>',
    '',
  ].join('\n');
}

const camel = (name: string) => name.replace(/-([a-z])/g, (_, letter: string) => letter.toUpperCase());

/** A React component that shows the model with `@glanz/react`. */
export function reactSnippet(scene: Scene, state: State, view: ElementView): string {
  const nameless =
    Object.keys(state.materials).some((index) => !isNamed(scene.materials, Number(index))) ||
    state.hidden.some((index) => !isNamed(scene.instances, index));
  const { imports, lines } = more(scene, state, 'ref.current?', nameless);
  const props = attributesOf(scene, state, view).map(([key, value]) =>
    value === true
      ? `      ${camel(key)}`
      : `      ${camel(key)}={${typeof value === 'string' ? quoted(value) : value}}`,
  );
  const look = nameless
    ? []
    : [
        ...(Object.keys(state.materials).length > 0
          ? [
              `const materials = ${literal(Object.fromEntries(Object.entries(state.materials).map(([index, values]) => [scene.materials[Number(index)]?.name, values])))} as const;`,
            ]
          : []),
        ...(state.hidden.length > 0
          ? [
              `const parts = ${literal(Object.fromEntries(state.hidden.map((index) => [scene.instances[index]?.name, false])))};`,
            ]
          : []),
      ];
  const declared = look.map(
    (line) => `      ${line.startsWith('const materials') ? 'materials={materials}' : 'parts={parts}'}`,
  );
  return [
    'import { GlanzViewer' + (lines.length > 0 ? ', type GlanzViewerElement' : '') + " } from '@glanz/react';",
    ...imports,
    ...(lines.length > 0 ? ["import { useRef } from 'react';"] : []),
    '',
    ...look,
    "const style = { width: '100%', height: '60vh' };",
    '',
    'export default function Model() {',
    ...(lines.length > 0
      ? [
          '  const ref = useRef<GlanzViewerElement>(null);',
          '  const onLoad = () => {',
          ...lines.map((line) => `    ${line.replaceAll('\n', '\n    ')}`),
          '  };',
        ]
      : []),
    '  return (',
    '    <GlanzViewer',
    ...(lines.length > 0 ? ['      ref={ref}', '      onLoad={onLoad}'] : []),
    ...props,
    ...declared,
    '      style={style}',
    '    />',
    '  );',
    '}',
    '',
  ].join('\n');
}
